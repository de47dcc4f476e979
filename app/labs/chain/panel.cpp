#include "app/labs/chain/panel.hpp"

#include <imgui.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <optional>
#include <string_view>
#include <tendril/ik/options.hpp>

#include "app/fields/field_rows.hpp"
#include "app/io/text.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/engine_trace.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/past.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/timeline.hpp"
#include "app/widgets/tooltip.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

/// The length of the next segment to add or insert: state of the panel, not of the document. At first, the
/// last bone's length.
float length_of_next(const Chain& chain) {
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const ImGuiID kept_as = ImGui::GetID("next length");
    float length = kept.GetFloat(kept_as, chain.size() > 1 ? chain.length(chain.size() - 1) : 1.0f);
    if (number_field("new bone", length, 0.01f, 0.0f, 1000.0f, "%.3f m")) kept.SetFloat(kept_as, length);
    explain("The length of the bone that Add or Insert makes next.");
    return length;
}

std::string tooltip_of(const Preset& preset) {
    return count_text(static_cast<std::size_t>(preset.count), "joint") + preset.what;
}

}  // namespace

void preset_button(const Preset& preset, int of, Emit& emit) {
    if (!row_button(preset.title.c_str(), of, true, tooltip_of(preset).c_str())) return;
    emit("chain.preset", {{"name", preset.name}});
    emit("camera.frame", {{"what", "all"}});
}

namespace {

/// The most important first: Reach and Curve, then the four trailing modes.
constexpr std::array modes_in_panel{ChainMode::Reach,    ChainMode::Curve, ChainMode::Forward,
                                    ChainMode::Backward, ChainMode::Fixed, ChainMode::WithIndex};

void mode_rows(const ChainPart& part, const Palette& colours, MoreRows& more, Emit& emit) {
    // The two modes that solve share a row.
    const float left = ImGui::GetCursorPosX(), half = 0.5f * ImGui::GetContentRegionAvail().x;
    for (const ChainMode mode : modes_in_panel) {
        const bool first = mode == modes_in_panel[0], second = mode == modes_in_panel[1];
        if (second) ImGui::SameLine(left + half);
        if (option_button(chain_modes.title(mode), part.mode == mode, chain_modes.help(mode)))
            emit("chain.mode", {{"mode", chain_modes.name(mode)}});
        draw_mode(mode, colours, first ? half + ImGui::GetStyle().ItemSpacing.x : 0.0f,
                  first || second ? 0.62f : 1.0f);
    }
    study_rows(part, emit);  // above the rows that depend on the mode: opening a study changes it to Reach

    const auto with = [&](const char* name, ArgumentValue value) {
        emit.continuously("chain.mode", {{"mode", chain_modes.name(part.mode)}, {name, std::move(value)}});
    };
    if (part.mode == ChainMode::WithIndex && !part.chain.empty()) {
        int index = static_cast<int>(part.index);
        if (integer_slider("index", index, 0, static_cast<int>(part.chain.size()) - 1)) with("index", index);
        explain("The joint that goes to the target; the joints on both sides of it trail.");
    }
    if (part.mode == ChainMode::Fixed) {
        int iterations = iterations_of(part, part.mode);
        if (integer_field("iterations", iterations, 1, max_iterations)) with("iterations", iterations);
        explain("The maximum number of passes per solve. More get closer to the target and cost more.");
        const bool changed = part.tolerance != ChainPart().tolerance;
        more.add("tolerance", {"chain.mode", {"tolerance"}}, changed, [&part, &emit] {
            float tolerance = part.tolerance;
            if (number_field("tolerance", tolerance, 0.0005f, 0.0f, 10.0f, "%.4f m"))
                emit.continuously("chain.mode",
                                  {{"mode", chain_modes.name(part.mode)}, {"tolerance", tolerance}});
            explain("How far from the target the solver may stop. Less takes more iterations.");
        });
    }
}

/// Turns the camera square on to the plane, with the normal towards the eye.
void look_at_plane(const ChainPlane& plane, Emit& emit) {
    const glm::vec3 normal = glm::normalize(plane.normal);
    emit("camera.set", {{"yaw_deg", glm::degrees(math::arctangent(normal.x, normal.z))},
                        {"pitch_deg", 90.0 - glm::degrees(math::arccosine(static_cast<double>(normal.y)))},
                        {"orthographic", true}});
}

void plane_switch(const ChainPart& part, Emit& emit) {
    bool on = part.reach.plane.has_value();
    if (ImGui::Checkbox("In a plane", &on))
        emit("chain.plane", on ? ArgumentList{{"normal", glm::vec3(0, 0, 1)}} : ArgumentList{{"off", true}});
    explain("Keeps the chain in a plane through its root, in all modes but Curve: the XY plane at first.");
}

void plane_rows(const ChainPart& part, MoreRows& more, Emit& emit) {
    if (part.mode != ChainMode::Reach) plane_switch(part, emit);  // in Reach beside the pole target's
    if (!part.reach.plane) return;
    const ChainPlane& plane = *part.reach.plane;
    if (row_button("2D view", 1, true, "Looks straight at the plane, without perspective: drags stay in it"))
        look_at_plane(plane, emit);
    end_row();
    for (const Preset& preset : presets())
        if (preset.planar()) preset_button(preset, preset.of, emit);
    end_row();
    more.add("normal", {"chain.plane", {"normal"}}, plane.normal != ChainPlane().normal, [&plane, &emit] {
        glm::vec3 normal = plane.normal;
        if (point_field("normal", normal, 0.01f) && glm::length(normal) > 1e-6f)
            emit.continuously("chain.plane", {{"normal", normal}});
        explain("Perpendicular to the plane. Its length does not matter.");
    });
    if (part.mode != ChainMode::Reach) return;
    const auto titles = bend_sides.titles();
    int side = static_cast<int>(plane.bend);
    if (choice_field("bends", side, titles.data(), static_cast<int>(titles.size())))
        emit("chain.bend", {{"side", bend_sides.name(static_cast<ik::Side>(side))}});
    explain("The side of the line from root to tip that the chain bends to, as the 2D view shows it.");
}

void segment_rows(const ChainPart& part, Emit& emit) {
    const float length = length_of_next(part.chain);
    // In mode reach the new chain reaches again, in the same step.
    const auto change = [&](const char* command, const ArgumentList& arguments) {
        emit.continuously(command, arguments);
        if (part.mode == ChainMode::Reach && part.motion.path == Motion::Path::Still)
            emit.continuously("chain.target", {{"to", part.target}});
    };
    if (row_button("Add", 3, true, "Adds a joint at the end, with a bone of that length"))
        change("chain.add", {{"length", length}});
    const auto selected = part.selection.active();
    const bool several = part.selection.several();
    if (row_button("Insert", 3, selected.has_value(), "Inserts a joint before the selected one"))
        change("chain.insert", {{"index", *selected}, {"length", length}});
    if (row_button("Remove", 3, selected.has_value(),
                   several ? "Removes the selected joints" : "Removes the selected joint"))
        emit("chain.remove_selected");
    if (selected) {
        const std::string name = several ? count_text(part.selection.all().size(), "bone")
                                         : "bone of joint " + std::to_string(*selected);
        length_field(name.c_str(), part, emit);
    } else {
        note(part.chain.empty() ? "Add a joint, or take a preset." : "Click a joint to select it.");
    }
}

void target_rows(const ChainPart& part, bool playing, Emit& emit) {
    glm::vec3 target = part.target;
    if (point_field("target", target, 0.01f)) emit.continuously("chain.target", {{"to", target}});
    explain("The target's position. It can be dragged in the scene too.");

    const FieldRows path(part.motion, "chain.motion", emit);
    path.row("path");
    if (part.motion.path == Motion::Path::Still) return;
    if (!playing) note("The simulation is paused. Space runs it.");
    path.rows("radius", "period");
}

void preset_rows(Emit& emit) {
    std::vector<PresetButton> buttons;
    for (const Preset& preset : presets()) {
        // These are shown below their mode or switch.
        if (preset.of == 0 || preset.planar()) continue;
        buttons.push_back({preset.name, preset.title, tooltip_of(preset), preset.of});
    }
    if (app::preset_rows(chain_lab, buttons, "Removes every joint", emit))
        emit("camera.frame", {{"what", "all"}});  // presets differ in size
}

}  // namespace

void ChainLab::panel(const Workspace& workspace, Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    const auto section = [&](const char* title, bool at_first, const auto& rows) {
        folding_section(workspace, title, emit, at_first, rows);
    };
    section("Presets", true, [&](MoreRows&) { preset_rows(emit); });
    if (const TracedPose* const pose = traced_pose(part))
        section("Trace", true, [&](MoreRows& more) { trace_rows(*pose, more, emit); });
    section("Mode and solver", true, [&](MoreRows& more) {
        mode_rows(part, palette(workspace.settings.theme), more, emit);
        if (part.mode == ChainMode::Reach) solver_rows(part, more, emit);
        if (part.mode == ChainMode::Curve)
            curve_rows(part, more, emit);
        else
            plane_rows(part, more, emit);
    });
    section("Joints", false, [&](MoreRows&) { segment_rows(part, emit); });
    section("Target", false, [&](MoreRows&) { target_rows(part, workspace.clock.playing, emit); });
    section("Analyse", false, [&](MoreRows& more) {
        past_rows(workspace, chain_past(), emit);
        if (part.mode == ChainMode::Reach) FieldRows(part.flips, "chain.flips", emit).under(more).all();
    });
    section("Export", false, [&](MoreRows&) { export_rows(emit); });
}

bool ChainLab::analyses(const Workspace& workspace) const {
    return chain_part(workspace).study.open();
}

float ChainLab::timeline_height(const Workspace& workspace) const {
    const bool magnified = chain_part(workspace).study.kind == Study::Kind::Microscope;
    return magnified ? strip_height : Lab::timeline_height(workspace);
}

namespace {

/// Plays, steps and scrubs the microscope or the race; `ends` are the last steps of the iterations.
void study_strip(const ShownChain& chain, const std::vector<int>& ends, Emit& emit) {
    const bool plays = chain.part.study.pace > 0.0f, race = chain.race != nullptr;
    const std::size_t step = chain.step();
    if (icon_button("play", plays ? Icon::Pause : Icon::Play,
                    plays  ? "Pauses"
                    : race ? "Plays the race, iteration by iteration"
                           : "Plays the steps",
                    chain.last() > 0, plays)) {
        if (race)
            emit("race.play", {{"on", !plays}});
        else
            emit(plays ? "microscope.pause" : "microscope.play");
    }
    ImGui::SameLine();
    if (icon_button("back", Icon::ChevronLeft, race ? "One iteration back" : "One step back", step > 0))
        emit("study.step", {{"by", -1}});
    ImGui::SameLine();
    if (icon_button("on", Icon::ChevronRight, race ? "One iteration forward" : "One step forward",
                    step < chain.last()))
        emit("study.step", {{"by", 1}});
    ImGui::SameLine();
    int shown = static_cast<int>(step);
    if (step_timeline("solve", shown, ends)) {
        if (race)
            emit.continuously("race.show", {{"iteration", shown}});
        else
            emit.continuously("microscope.seek", {{"step", shown}});
    }
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
        tooltip(race ? "The iterations of the race. Drag to see every chain after one of them."
                     : "The steps of the solve. Drag to see the chain after one of them.");
}

}  // namespace

void ChainLab::timeline(const Workspace& workspace, Emit& emit) const {
    const ShownChain chain = shown_chain(workspace);
    if (chain.trace) return study_strip(chain, iteration_ends(*chain.trace), emit);
    if (!chain.race) return Lab::timeline(workspace, emit);
    // The moments of the last ten seconds, or the iterations of the race: state of the panel.
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    bool& past = *kept.GetBoolRef(ImGui::GetID("past"));
    if (other_strip_button(past, "race")) past = !past;
    if (past) return Lab::timeline(workspace, emit);
    std::vector<int> ends(chain.last() + 1);
    std::iota(ends.begin(), ends.end(), 0);
    study_strip(chain, ends, emit);
    past_plot(workspace, chain_past(), std::nullopt, emit);
}

std::string distance_text(float metres) {
    const auto value = static_cast<double>(metres);
    return value >= 0.01 ? fixed_text(value, 2) + " m" : si_text(value, "m");
}

namespace {

Verdict reach_verdict(const ChainPart& part) {
    if (part.chain.segments().size() < 2) return {"One joint", Verdict::Kind::Open};
    if (!part.result) {
        const float apart = glm::distance(part.chain.position(part.chain.size() - 1), part.target);
        if (apart > part.tolerance) return {"Drag the target", Verdict::Kind::Open};
        return {"Tip on the target", Verdict::Kind::Good};
    }
    const ik::Report& report = part.result->report;
    const std::string off = distance_text(report.residual);
    switch (report.status) {
        case ik::Status::Converged:
            return {"Reached", Verdict::Kind::Good};
        case ik::Status::Stretched:
            return {"Out of reach: " + off + " short", Verdict::Kind::Bad};
        case ik::Status::TooClose:
            return {"Too close: " + off + " off", Verdict::Kind::Bad};
        case ik::Status::Limited:
            return {"Limited: " + off + " short", Verdict::Kind::Bad};
        case ik::Status::Stalled:
            return {"Stalled: " + off + " short", Verdict::Kind::Bad};
        case ik::Status::IterationLimit:
            return {"Did not converge: " + off + " off", Verdict::Kind::Bad};
        case ik::Status::InvalidInput:
            break;
    }
    return {"Refused", Verdict::Kind::Bad};
}

/// Explains a stalled solve: why more iterations would not help.
std::string stalled_text(const ChainPart& part) {
    const ReachSettings& reach = part.reach;
    const bool limited = is_limited(reach);
    if (!limited && in_line_with_target(part)) {
        const float span = glm::distance(part.chain.position(0), part.chain.position(part.chain.size() - 1));
        return std::string(span > 0.999f * part.chain.reach() ? "Straight, and the target is on its line"
                                                              : "Folded onto the line to the target") +
               ": bend it" + (reach.options.pole ? "." : ", or add a pole target.");
    }
    const bool restarts = ik::honours(part.result->method, field_of<&ik::Options::restarts>(), limited);
    return std::string("No closer from here. Try another solver") + (restarts ? ", or more restarts." : ".");
}

}  // namespace

std::string status_text(const ChainPart& part) {
    switch (part.result->report.status) {
        case ik::Status::Converged:
            return part.result->report.off_plane > 1e-3f * part.chain.reach()
                       ? "The tip is as near as it can be in the plane."
                       : "The tip is on the target.";
        case ik::Status::Stretched:
            return "The chain is straight and points at the target.";
        case ik::Status::TooClose:
            return "The longest bone keeps the tip away.";
        case ik::Status::Limited:
            return part.result->active_limit
                       ? capitalised(active_limit_text(*part.result->active_limit)) + "."
                       : "The joint limits keep the tip away.";
        case ik::Status::Stalled:
            return stalled_text(part);
        case ik::Status::IterationLimit:
            return "The solver ran out of iterations.";
        case ik::Status::InvalidInput:
            break;
    }
    return "Nothing was moved: a number is not valid.";
}

Verdict chain_verdict(const ChainPart& part) {
    if (const TracedPose* const pose = traced_pose(part)) return trace_verdict(*pose);
    if (part.chain.empty()) return {"No joints", Verdict::Kind::Open};
    if (part.mode == ChainMode::Reach) return reach_verdict(part);
    if (part.mode == ChainMode::Curve) return curve_verdict(part);
    const std::size_t joint = led_joint(part);
    const std::string end = joint == 0                       ? "Head"
                            : joint + 1 == part.chain.size() ? "Tail"
                                                             : "Joint " + std::to_string(joint);
    const float off = glm::distance(part.chain.position(joint), part.target);
    if (off <= std::max(part.tolerance, 1e-6f * part.chain.reach()))
        return {end + " on the target", Verdict::Kind::Good};
    return {end + ": " + distance_text(off) + " to go", Verdict::Kind::Open};
}

void report_rows(const ShownChain& shown, const std::vector<glm::vec3>& joints, const Palette& palette,
                 Emit& emit) {
    const ChainPart& part = shown.part;
    if (part.mode == ChainMode::Curve && !part.chain.empty()) return curve_report_rows(part, palette, emit);
    if (!shows_end(shown)) {
        verdict("In progress", palette.text);
        reading("tip to target", "%s",
                si_text(static_cast<double>(shown_residual(part, joints)), "m").c_str());
        note("This is one step of the solve. The last step shows the report.");
        return;
    }
    if (const TracedPose* const pose = traced_pose(part))
        return show_verdict(chain_verdict(part), palette, emit, {.verdict = 2, .notes = 3, .paragraphs = 3},
                            [pose] {
                                note(pose->trace->name + ", frame " + std::to_string(pose->frame) +
                                     "; the last is " + std::to_string(pose->trace->all - 1) + '.');
                            });
    const VerdictLines reserved = part.mode == ChainMode::Reach
                                      ? VerdictLines{.verdict = 1, .notes = 3, .paragraphs = 2}
                                      // the status in two lines, and what ran
                                      : VerdictLines{.verdict = 1, .notes = 2};
    show_verdict(chain_verdict(part), palette, emit, reserved, [&part, &emit] {
        if (part.mode != ChainMode::Reach) return note(chain_modes.help(part.mode));
        if (part.chain.segments().size() < 2) return note("A chain needs two joints to reach.");
        if (!part.result) return note("The tip reaches for the target when it is dragged.");
        note(status_text(part));
        cure_line(ran_text(part.result->method, part.result->report), reach_cure(part), emit);
    });
    if (part.mode != ChainMode::Reach || !part.result) return;
    reading("iterations", "%d", part.result->report.iterations);
    reading("tip to target", "%s", si_text(static_cast<double>(shown_residual(part, joints)), "m").c_str());
}

namespace {

/// Why the solver and its rivals in a race ignore an option, for its row's tooltip; empty if one uses it.
std::string why_unused(const ChainPart& part, const Field& option) {
    const ReachSettings& reach = part.reach;
    const bool limited = is_limited(reach), racing = part.study.kind == Study::Kind::Race;
    const std::string_view name = option.name;
    const bool turns = name == "pole_turn" || name == "twist";
    if (reach.plane && turns) return "A chain in a plane does not use this.";
    const auto uses = [&](ik::Method method) {
        const bool runs =
            method == reach.method ||
            (racing && part.study.racers[static_cast<std::size_t>(method)] && takes(method, part.chain));
        return runs && ik::honours(method, option, limited);
    };
    if (std::ranges::any_of(ik::all_methods, uses)) return {};
    const bool otherwise = ik::honours(reach.method, option, !limited);
    const char* const when = !otherwise ? "" : limited ? " within limits" : " without joint limits";
    return std::string(solver_title(reach.method)) + " does not use this" + when + ".";
}

/// A row of the solver's settings, greyed where the method ignores it.
void solver_row(const ChainPart& part, const Field& field, MoreRows& more, Emit& emit,
                std::optional<double> otherwise = {}) {
    FieldRows(part.reach, "chain.solver", emit)
        .under(more)
        .row(field.name, {.otherwise = otherwise, .why_not = why_unused(part, field)});
}

void option_rows(const ChainPart& part, MoreRows& more, Emit& emit) {
    const ReachSettings& reach = part.reach;
    for (const Field& field : fields<ReachSettings>()) {
        const std::string_view name = field.name;
        if (name == "solver" || name.starts_with("pole"))
            continue;  // has its own row, or is below its switch
        std::optional<double> otherwise;
        if (name == "tolerance") otherwise = reach_tolerance(reach, part.chain.reach());
        if (name == "restarts") otherwise = default_restarts;
        solver_row(part, field, more, emit, otherwise);
    }
    more.add("", {"chain.solver", {"default_tolerance", "default_restarts"}}, false, [&reach, &emit] {
        if (row_button("Default tolerance", 1, reach.options.tolerance.has_value(),
                       "A thousandth of the reach"))
            emit("chain.solver", {{"default_tolerance", true}});
        if (row_button("Default restarts", 1, reach.options.restarts.has_value(),
                       "8, but none while the target is dragged"))
            emit("chain.solver", {{"default_restarts", true}});
        end_row();
    });
}

void pole_rows(const ChainPart& part, MoreRows& more, Emit& emit) {
    bool on = part.reach.options.pole.has_value();
    ImGui::BeginDisabled(part.chain.empty());
    if (ImGui::Checkbox("Pole target", &on))
        emit("chain.pole", on ? ArgumentList{{"to", first_pole(part)}} : ArgumentList{{"off", true}});
    ImGui::EndDisabled();
    explain(
        "Turns the chain about the line from root to tip until the elbow points at a ball that you place.");
    ImGui::SameLine();
    plane_switch(part, emit);
    if (!part.reach.options.pole || part.chain.empty()) return;
    more.add("pole", {"chain.pole", {"to"}}, false, [&part, &emit] {
        glm::vec3 pole = *part.reach.options.pole;
        if (point_field("pole", pole, 0.01f)) emit.continuously("chain.pole", {{"to", pole}});
        explain("The pole target's position. Drag the pink ball to move it.");
    });
    solver_row(part, *find_field(fields<ReachSettings>(), "pole_turn"), more, emit);
}

}  // namespace

void solver_rows(const ChainPart& part, MoreRows& more, Emit& emit) {
    std::array<const char*, ik::all_methods.size()> titles{};
    std::transform(ik::all_methods.begin(), ik::all_methods.end(), titles.begin(), solver_title);
    int method = static_cast<int>(part.reach.method);
    std::array<const char*, ik::all_methods.size()> why_not{};
    std::transform(ik::all_methods.begin(), ik::all_methods.end(), why_not.begin(),
                   [&](ik::Method each) { return takes(each, part.chain) ? nullptr : needs_two_bones; });
    if (choice_field("##solver", method, titles.data(), static_cast<int>(titles.size()), why_not.data())) {
        emit("chain.solver", {{"name", ik::name(ik::all_methods[static_cast<std::size_t>(method)])}});
    }
    explain(
        (std::string(solver_help(part.reach.method)) + " Race compares the solvers on this chain.").c_str());
    if (!takes(part.reach.method, part.chain)) note(why_not_taken(part.reach.method, part.chain) + ".");
    pole_rows(part, more, emit);
    option_rows(part, more, emit);
}

}  // namespace tendril::app
