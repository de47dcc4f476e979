#include "app/labs/rope/panel.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <string_view>
#include <tendril/signal/measure.hpp>

#include "app/document/runtime.hpp"
#include "app/fields/field_rows.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/kit/race.hpp"
#include "app/labs/rope/body_commands.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/labs/rope/rope_time.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/plot.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

// Sections of the left panel: scene, tool, objects, simulation, view.

namespace {

void scene_rows(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const RopeSceneEntry& scene : rope_scenes())
        buttons.push_back({scene.name, scene.title, scene.help});
    // The last preset shares the row of Empty and Reset; the four before it have short titles and share one.
    for (std::size_t i = buttons.size() - 5; i < buttons.size() - 1; ++i) buttons[i].of = 4;
    preset_rows(rope_lab, buttons, "Removes every rope and collider", emit);
}

void tool_rows(const RopePart& part, Emit& emit) {
    const auto tools = rope_tools.values();
    for (const RopeTool tool : tools) {
        if (row_option(rope_tools.title(tool), static_cast<int>(tools.size()), part.tool == tool,
                       rope_tools.help(tool)))
            emit("rope.tool", {{"name", rope_tools.name(tool)}});
    }
    end_row();
}

/// A character whose capsules collide.
void character_rows(const Walker& walker, Emit& emit) {
    const std::string now = walker.figure ? walker.figure->file : "";
    std::string file = now;
    const auto change = [&](const std::string& path, const std::string& clip, glm::vec3 at) {
        ArgumentList given{{"clip", clip}, {"at", at}};
        if (!path.empty()) given.push_back({"path", path});
        emit.continuously("rope.character", given);
    };
    if (path_field("character", file, "or drop one", "rope.character", emit) && file != now && !file.empty())
        emit("rope.character", {{"path", file}, {"at", walker.at}});
    explain("A character with its clips: .gltf, .glb, .vrm, .vrma, .fbx or .bvh. Enter reads it.");
    if (row_button("Stick figure", 2, !walker.figure || !now.empty(), "The built-in figure walks in"))
        emit("rope.character", {{"at", walker.at}});
    if (row_button("Remove", 2, walker.figure != nullptr, "Removes the character and its colliders"))
        emit("rope.character.remove");
    end_row();
    if (!walker.figure) return;
    constexpr const char* standing = "none (rest pose)";
    const std::string shown = walker.clip.empty() ? standing : walker.clip;
    if (begin_list("clip", &shown)) {
        if (list_row(standing, walker.clip.empty())) change(now, "", walker.at);
        for (const humanoid::Clip& clip : walker.figure->character.clips)
            if (list_row(clip.name, clip.name == walker.clip)) change(now, clip.name, walker.at);
        end_list();
    }
    explain("The clip that plays in a loop. Type part of a name to find one.");
    glm::vec3 at = walker.at;
    if (point_field("at", at, 0.01f)) change(now, walker.clip, at);
    explain("The position of the character.");
}

FieldRows settings_rows(const RopePart& part, Emit& emit) {
    FieldRows rows(part.world->settings(), "rope.settings", emit);
    return rows.compared_with(part.usual);
}

void solver_rows(const RopePart& part, MoreRows& more, Emit& emit) {
    const rope::Settings& now = part.world->settings();
    const FieldRows settings = settings_rows(part, emit).under(more);
    settings.row("solver");
    settings.row("iterations");
    const bool changed = now.substep != part.usual.substep;
    more.add("substeps", {"rope.settings", {"substep"}}, changed, [&now, &emit] {
        float per_second = static_cast<float>(1.0 / now.substep);
        if (number_field("substeps", per_second, 2.0f, 10.0f, 10000.0f, "%.0f /s"))
            emit.continuously("rope.settings", {{"substep", 1.0f / std::max(per_second, 1e-9f)}});
        explain(
            "How many equal steps a simulated second is divided into. More steps follow fast motion better "
            "and cost more.");
    });
    if (now.solver != rope::Solver::Relaxation) settings.row("compliance");
    const bool races = !part.rivals.empty();
    if (row_button(races ? "End the race" : "Race the solvers", 1, true,
                   races ? "Continues with this solver only"
                         : "Runs the scene by each solver, side by side with one camera: drags and commands "
                           "change all of them"))
        emit("rope.race", {{"on", !races}});
    end_row();
}

void time_rows(const Workspace& workspace, MoreRows& more, Emit& emit) {
    const RopePart& part = rope_part(workspace);
    float percent = 100.0f * workspace.clock.speed;
    if (number_field("speed", percent, 0.5f, 5.0f, 200.0f, "%.0f %%"))
        emit.continuously("time.speed", {{"factor", percent / 100.0f}});
    explain("How fast time passes in the lab. Under 100 % is slow motion.");
    if (row_button("Restart", 1, part.start != nullptr, restart_cure().help.c_str())) emit("rope.restart");
    end_row();
    constexpr float uneven = 0.5f;  // on the dial: 4 to 65 ms
    const auto rates = signal::usual_rates();
    for (const signal::FrameRate& rate : rates) {
        const auto hz = static_cast<float>(rate.hz);
        const float dial = rate.jittered ? uneven : 0.0f;
        const std::string title = rate.jittered ? "uneven" : fixed_text(rate.hz, 0) + " Hz";
        if (row_option(title.c_str(), static_cast<int>(rates.size()),
                       part.jitter.rate == hz && part.jitter.dial == dial, "The length of a frame"))
            emit("rope.jitter", {{"rate", hz}, {"dial", dial}});
    }
    end_row();
    settings_rows(part, emit).under(more).row("longest_frame");
    FieldRows(part.jitter, "rope.jitter", emit).under(more).rows("rate", "dial");
}

}  // namespace

void RopeLab::panel(const Workspace& workspace, Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    const auto section = [&](const char* title, bool at_first, const auto& rows) {
        folding_section(workspace, title, emit, at_first, rows);
    };
    section("Presets", true, [&](MoreRows&) { scene_rows(emit); });
    section("Click action", true, [&](MoreRows&) { tool_rows(part, emit); });
    section("Add", false, [&](MoreRows&) {
        adding_rows(workspace, emit);
        character_rows(part.walker, emit);
    });
    section("World", true, [&](MoreRows& more) {
        const FieldRows rows = settings_rows(part, emit), folded = settings_rows(part, emit).under(more);
        folded.row("wind");
        const bool windy = part.world->settings().wind != glm::vec3(0.0f);
        (windy ? rows : folded).rows("gusts", "still_air");
        folded.rows("damping", "friction", "gravity", "gravity_scale", "external");
    });
    section("Solver", false, [&](MoreRows& more) { solver_rows(part, more, emit); });
    section("Time", false, [&](MoreRows& more) { time_rows(workspace, more, emit); });
    section("Show", false, [&](MoreRows& more) {
        FieldRows(part.view, "rope.view", emit).under(more).all();
        past_rows(workspace, rope_past(), emit);
    });
    section("Export", false, [&](MoreRows&) {
        if (row_button("Copy as C++", 1, true,
                       "Copies ropes and colliders as a C++ program that uses the library"))
            emit("rope.copy");
        end_row();
        picture_rows(emit);
    });
}

void RopeLab::inspector(const Workspace& workspace, Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    Verdict said = paced_verdict(rope_verdict(part), workspace);
    const std::string torn = part.tears.empty() ? "" : torn_text(part.tears);
    const bool now = said.text.starts_with("Torn");
    if (now && !torn.empty()) said.why = torn + ": drag the timeline back to see it.";
    show_verdict(said, palette(workspace.settings.theme), emit, {.notes = 3}, [&] {
        if (!now && !torn.empty()) cure_line(torn, restart_of_torn(part), emit, true);
    });
    selection_rows(workspace, emit);
    number_rows(workspace, palette(workspace.settings.theme), emit);
}

// Sections of the right panel: the selection, and simulation statistics.

namespace {

/// The physical properties of the body.
void body_rows(const NamedWorld& world, const rope::Body& body, const Palette& colours, Emit& emit) {
    const PanelSection ids(world.name(body).c_str());
    const BodySettings settings = settings_of(world, body);
    const std::vector<Field> table = body_fields(settings);
    const FieldRows rows({table, &settings}, field_texts<BodySettings>(), "rope.set", emit,
                         {{"rope", world.name(body)}});
    for (const Field& field : table) {
        const std::string_view name = field.name;
        RowOptions options;
        if (name == "friction") options.otherwise = world.settings().friction;
        if (name == "length" && !(settings.length > 0.0f))
            options.why_not = "All its particles are in one place: there is no length to scale.";
        if (name == "bending" && world.settings().solver != rope::Solver::Direct)
            options.why_not = "Direct solver only.";
        if (name == "colour")
            for (const BodyColour each : body_colours.values())
                options.swatches.push_back(body_colour(each, body.kind, colours));
        rows.row(name, options);
        const std::string force = name == "tear" ? tearing_text(world, body) : "";
        if (force.empty()) continue;
        reading("", "%s", force.c_str());
        explain(
            "The force that stretches it to this strain. A rope that cannot stretch tears only where pins "
            "pull it apart.");
    }
    const ArgumentList which{{"rope", world.name(body)}};
    if (row_button("Subdivide", 3, true, "Halves each segment; shape, motion and material stay"))
        emit("rope.subdivide", which);
    if (row_button("Merge", 3, body.row > 2, "Merges segments in pairs; shape, motion and material stay"))
        emit("rope.merge", which);
    if (row_button("Reverse", 3, body.kind == rope::Body::Kind::Rope && body.count > 1,
                   "Swaps its ends; pins, ties and motion do not change"))
        emit("rope.reverse", which);
    end_row();
    collision_rows(world, body, emit);
}

void particle_rows(const RopePart& part, const rope::Body& body, std::size_t index, const Palette& colours,
                   Emit& emit) {
    const NamedWorld& world = *part.world;
    const std::size_t particle = body.first + index;
    const bool held = is_held(part, particle), pinned = world.pinned(particle) && !held;
    const ArgumentList which{{"rope", world.name(body)}, {"particle", index}};
    const auto change = [&](const char* command, const char* name, auto value) {
        emit.continuously(command, {which[0], which[1], {name, value}});
    };
    reading("particle", "%zu of %zu%s", index, body.count, pinned ? ", pinned" : held ? ", held" : "");
    float mass = static_cast<float>(world.state().mass[particle]);
    const char* const format = mass < 0.001f ? "%.6f kg" : "%.3f kg";  // a cloth's particles are light
    if (number_field("mass", mass, 0.002f, 1e-9f, 1e6f, format)) change("rope.weight", "mass", mass);
    explain("Its mass. A particle much heavier than its neighbours is drawn as a ball, such as a lantern.");
    reading("speed", "%.3f m/s", static_cast<double>(glm::length(world.velocity(particle))));
    reading("tension", "%s", tension_text(world, *part.selection).c_str());
    explain("The pull of the links at this particle. Without limit: pins are too far apart for them.");
    if (row_button(pinned ? "Unpin" : "Pin", 3, true,
                   pinned ? "Unpins the particle" : "Pins the particle in place"))
        emit(pinned ? "rope.unpin" : "rope.pin", which);
    const bool rope = body.kind == rope::Body::Kind::Rope;
    if (row_button("Cut", 3, rope && body.count > 1, "Cuts the segment after this particle"))
        emit("rope.cut", {{"rope", world.name(body)}, {"segment", std::min(index, body.count - 2)}});
    if (row_button("Remove", 3, true, "Removes the whole body"))
        emit("rope.remove", {{"name", world.name(body)}});
    end_row();
    if (row_button("Select all", 3, body.count > 1, "Selects all of it: its arrows then move it"))
        emit("rope.select", {{"rope", world.name(body)}});
    end_row();
    // Below the buttons: a pinned particle has three rows, and Pin must stay under the mouse.
    glm::vec3 at = world.position(particle);
    if (pinned) {
        if (point_field("at", at, 0.01f)) change("rope.pin", "at", at);
        explain("The position of the pin.");
    } else {
        const auto text = [](float value) { return fixed_text(static_cast<double>(value), 3); };
        reading("at", "%s  %s  %s", text(at.x).c_str(), text(at.y).c_str(), text(at.z).c_str());
    }
    body_rows(world, body, colours, emit);
}

/// Rows for several selected particles.
void several_rows(const RopePart& part, const rope::Body& body, const std::vector<std::size_t>& all,
                  const Palette& colours, Emit& emit) {
    const NamedWorld& world = *part.world;
    const auto pinned = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](std::size_t i) { return world.pinned(body.first + i); }));
    reading("body", "%s", world.name(body).c_str());
    reading("particles", "%zu of %zu", all.size(), body.count);
    reading("pinned", "%zu", pinned);
    if (all.size() == body.count && !is_attached(world, body)) {
        const glm::vec3 was = grip_of(world, body);
        glm::vec3 at = was;
        if (point_field("at", at, 0.01f))
            emit.continuously("rope.move", {{"rope", world.name(body)}, {"by", at - was}});
        explain("The middle of its pins or, without any, of its particles. Moves all of it, with its pins.");
    }
    const auto which = [&] {
        return ArgumentList{{"rope", world.name(body)}, {"particles", SharedJson(Json(all))}};
    };
    if (row_button("Pin", 3, pinned < all.size(), "Pins all of them in place")) emit("rope.pin", which());
    if (row_button("Unpin", 3, pinned > 0, "Unpins all of them")) emit("rope.unpin", which());
    if (row_button("Remove", 3, true, "Removes the whole body"))
        emit("rope.remove", {{"name", world.name(body)}});
    end_row();
    body_rows(world, body, colours, emit);
}

/// All fields of its kind except the position, which is set by moving the collider, as in a drag.
void shape_rows(const rope::Collider& collider, const std::string& name, Emit& emit) {
    const FieldsOf of = shape_fields(collider);
    const FieldRows rows(of, field_texts<rope::Shape>(), "rope.collider.set", emit, {{"name", name}});
    for (const Field& field : of.table)
        if (field.name != std::string_view("centre") && field.name != std::string_view("point"))
            rows.row(field.name);
}

void collider_rows(const RopePart& part, const rope::Collider& collider, Emit& emit) {
    const std::string& name = part.world->name(collider);
    reading("collider", "%s", name.c_str());
    reading("kind", "%s", rope::kind(collider.shape));
    glm::vec3 at = rope::centre(part.world->shape(collider));
    if (point_field("at", at, 0.01f)) emit.continuously("rope.collider.move", {{"name", name}, {"to", at}});
    explain("The collider's position. It can be dragged in the picture too.");
    double force = 0.0;
    for (const ColliderForce& each : part.forces.value_or(std::vector<ColliderForce>()))
        if (each.collider == collider.id) force = glm::length(each.newtons);
    reading("force", "%s", part.forces ? force_text(static_cast<float>(force)).c_str() : "not simulated yet");
    explain("The force of ropes, cloth and hair on it: contact, friction and hanging load.");
    shape_rows(collider, name, emit);
    const auto found = std::ranges::find(part.swings, name, &Swing::collider);
    const bool swings = found != part.swings.end();
    glm::vec3 by = swings ? found->swing : glm::vec3(0.0f);
    if (point_field("swings by", by, 0.01f))
        emit.continuously("rope.collider.swing", {{"name", name}, {"by", by}});
    explain("How far the collider swings to each side. 0, 0, 0: it does not swing.");
    if (swings) FieldRows(*found, "rope.collider.swing", emit, {{"name", name}}).row("period");
    const FieldRows drive(collider.drive, "rope.collider.drive", emit, {{"name", name}});
    drive.rows("velocity", "spin");
    if (collider.drive.spin != 0.0f) drive.row("axis");
    if (row_button("Remove", 3, true, "Removes the collider")) emit("rope.collider.remove", {{"name", name}});
    end_row();
}

Curve curve(const char* name, glm::vec3 colour, const std::vector<RopeSample>& samples,
            float RopeSample::*value, float scale) {
    Curve drawn{name, colour, {}};
    drawn.points.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        drawn.points.push_back(
            {static_cast<float>(i) * static_cast<float>(tick_seconds), scale * (samples[i].*value)});
    return drawn;
}

/// Shown if any frame of the last ten seconds is uneven.
void frame_times(const std::vector<RopeSample>& samples, const Palette& palette) {
    constexpr float even = 1e3f * static_cast<float>(tick_seconds);
    const auto uneven = [](const RopeSample& sample) { return std::abs(sample.frame - even) > 1e-3f; };
    if (std::none_of(samples.begin(), samples.end(), uneven)) return;
    const Curve times[] = {curve("frame time", palette.selection, samples, &RopeSample::frame, 1.0f)};
    plot("frame time", times,
         {.x = "time",
          .x_unit = "s",
          .y = "frame time",
          .y_unit = "ms",
          .min_y = 0.0f,
          .high_y = 2.5f * even,  // 33 ms, the frames of 30 Hz, with some space
          .level = even},
         7.0f);
    explain("How long each frame is. The dashed line is an even frame, 16.7 ms.");
}

void length_plot(const std::vector<RopeSample>& samples, const Palette& palette) {
    colour_mark(palette.ghost);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("length error");
    ImGui::SameLine(0.0f, ImGui::GetFontSize());
    colour_mark(palette.limit);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("as solved");
    const Curve errors[] = {curve("length error", palette.ghost, samples, &RopeSample::error, 100.0f),
                            curve("as solved", palette.limit, samples, &RopeSample::stretch, 100.0f)};
    plot("length error", errors, {.x = "time", .x_unit = "s", .y = "", .y_unit = "%", .min_y = 1e-4f}, 9.0f);
}

/// The present numbers of each racer, and their curves; `timed`: including the cost.
void race_rows(const RopePart& part, bool timed, const Palette& palette, Emit& emit) {
    const PanelSection ids("Race");
    const auto racers = rope_racers(part);
    for (const RopeRacer& racer : racers) {
        colour_mark(rope_solver_colour(palette, racer.solver()));
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(rope_solvers.title(racer.solver()));
        ImGui::SameLine();
        text_flush_right(timed ? cost_text(racer.samples) : "");
        small_right(racer_text(last_sample(racer)));
    }
    const auto curves = [&](const char* name, const char* unit, float RopeSample::*value, float scale,
                            float min_y) {
        std::vector<Curve> drawn;
        for (const RopeRacer& racer : racers)
            drawn.push_back(curve(rope_solvers.title(racer.solver()),
                                  rope_solver_colour(palette, racer.solver()), racer.samples, value, scale));
        plot(name, drawn, {.x = "time", .x_unit = "s", .y = name, .y_unit = unit, .min_y = min_y}, 9.0f);
    };
    curves("length error", "%", &RopeSample::error, 100.0f, 1e-4f);
    curves("energy", "J", &RopeSample::energy, 1.0f, 0.0f);
    if (timed) curves("time per tick", "ms", &RopeSample::cost, 1e-3f, 1e-3f);
    if (!(part.world->settings().compliance > 0.0f))
        note("Without compliance, XPBD gives the same result as relaxation.");
    if (row_button("Start again", 2, true, "Restarts the race from the present state of the first view"))
        emit("rope.race");
    if (row_button("Copy as CSV", 2, true,
                   "Each solver's length error, energy and time per tick in the last ten seconds"))
        emit("rope.race.copy");
    end_row();
}

}  // namespace

void selection_rows(const Workspace& workspace, Emit& emit) {
    const PanelSection ids("Selection");
    const RopePart& part = rope_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    if (part.selection) {
        if (const rope::Collider* collider = part.world->find_collider(part.selection->collider))
            return collider_rows(part, *collider, emit);
        if (const rope::Tie* tie = part.world->find_tie(part.selection->tie))
            return tie_rows(part, *tie, emit);
        const rope::Body* body = part.world->find(part.selection->body);
        if (body != nullptr && part.selection->particles.several())
            return several_rows(part, *body, part.selection->particles.all(), colours, emit);
        if (body != nullptr && part.selection->particle() < body->count)
            return particle_rows(part, *body, part.selection->particle(), colours, emit);
    }
    note("Nothing is selected. Click a rope or a collider.");
}

void number_rows(const Workspace& workspace, const Palette& palette, Emit& emit) {
    const RopePart& part = rope_part(workspace);
    const rope::State& state = part.world->state();
    const PanelSection numbers("Numbers");
    reading("particles", "%zu", state.position.size());
    const RopeSample last = part.samples.empty() ? sample_of(part, {}) : part.samples.back();
    reading("length error", "%s", share_text(last.error).c_str());
    explain("The largest length error of a segment, as shown: after contact.");
    reading("energy", "%.3f J%s", static_cast<double>(last.energy), part.quiet_ticks > 0 ? ", at rest" : "");
    const double lost = static_cast<double>(last_second(part.samples).contact_loss);
    MoreRows more;
    const auto add = [&](const char* name, const std::string& text, const char* help) {
        more.add(name, {}, false, [=] {
            reading(name, "%s", text.c_str());
            explain(help);
        });
    };
    add("as solved", share_text(last.stretch),
        "The length error that the solver left: for hair, before colliders displaced anything.");
    add("lost to contact", fixed_text(lost, 3) + " J",
        "Energy lost to contact and friction in the last second, by bodies near colliders at rest.");
    add("substeps dropped", std::to_string(state.dropped),
        "Substeps of the simulated time that were skipped: from frames over the longest frame, and where the "
        "work exceeds what a tick allows. A slow machine skips none: time passes slower.");
    const std::string cost = workspace.clock.measured ? cost_text(part.samples) : "";
    if (!cost.empty())
        more.add("time per tick, real time", {}, false, [&] {
            reading("time per tick", "%s", cost.c_str());
            explain("How long the ropes take to simulate a tick, 1/60 s: the mean of the last second.");
            reading("real time", "%.0f %%", 100.0 * pace_of(workspace.runtimes).kept);
            explain("Simulated time as a share of real time, over the last second.");
        });
    more_rows(workspace, "Numbers", more, emit);
    if (!part.rivals.empty()) return race_rows(part, workspace.clock.measured, palette, emit);
    if (part.samples.size() < 2 || state.bodies.empty()) return;
    const PanelSection past("Last ten seconds");
    MoreRows plots;
    const auto shows = [](const RopeSample& each) { return std::max(each.error, each.stretch) >= 1e-4f; };
    if (std::ranges::any_of(part.samples, shows))
        length_plot(part.samples, palette);
    else
        plots.add("length error, below 0.01 %", {}, false, [&] { length_plot(part.samples, palette); });
    const Curve energy[] = {curve("energy", palette.accent, part.samples, &RopeSample::energy, 1.0f)};
    plot("energy", energy, {.x = "time", .x_unit = "s", .y = "energy", .y_unit = "J", .min_y = 0.0f}, 9.0f);
    frame_times(part.samples, palette);
    more_rows(workspace, "Last ten seconds", plots, emit);
}

}  // namespace tendril::app
