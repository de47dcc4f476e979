// Commands on the rig as a whole and on time: presets, selection, solving, walks, takes, clips, frame rates.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tendril/rig/backward.hpp>

#include "app/document/argument.hpp"
#include "app/document/refused.hpp"
#include "app/io/character/export.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/names.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/code.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_commands.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/take.hpp"
#include "app/labs/rig/values.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {
namespace {

void select_elements(const RigPart& part, Selection& elements, const Arguments& given, bool add) {
    if (!gives_one(given, "element", "elements"))
        return elements.take(element_list(part, given, "elements"), add);
    const std::string name = given.text("element");
    if (name.empty()) return;
    const std::size_t at = element_named(part, name);
    add ? elements.toggle(at) : elements.only(at);
}

void select(RigPart& part, const Arguments& given) {
    const bool add = given.has("add") && given.boolean("add");
    const bool gives_elements = given.has("element") || given.has("elements");
    RigSelection selected = add ? part.selected : RigSelection();
    if (gives_elements) select_elements(part, selected.elements, given, add);
    if (given.has("unit")) selected.unit = given.text("unit");
    if (!selected.unit.empty()) unit_named(part, selected.unit);
    const bool chosen = selected.unit != part.selected.unit || selected.elements.empty();
    const bool stays = !gives_elements && (given.has("unit") || selected.unit_last);
    selected.unit_last = !selected.unit.empty() && (chosen || stays);
    part.selected = std::move(selected);
}

/// Reading changes no value, but it stores computed pending poses, which is visible. So it edits the part
/// itself.
void read(Workspace& workspace, const Arguments& given) {
    const std::vector<std::size_t> elements = elements_given(rig_part(workspace), given);
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    const std::uint64_t before = part.state->elements.recomputations();
    for (const std::size_t each : elements) {
        part.state.edit().elements.get(part.rig.id(each), rig::Space::Global);
        part.state.edit().elements.get(part.rig.id(each), rig::Space::Local);
    }
    const auto count = static_cast<std::size_t>(part.state->elements.recomputations() - before);
    const std::string what = elements.size() == 1 ? part.rig.definition().elements[elements.front()].name
                                                  : count_text(elements.size(), "element");
    workspace.toast("Reading " + what + ": " +
                    (count == 0 ? "nothing was pending" : count_text(count, "transform") + " worked out"));
}

void copy(Workspace& workspace, const Arguments&) {
    workspace.ui.copied = rig_code(rig_part(workspace));
    workspace.toast("The rig is on the clipboard as C++");
}

void take_preset(Workspace& workspace, const Arguments& given) {
    const RigPreset& preset = rig_preset(given.text("name"));
    // Opening an unchanged preset again changes nothing: a recording starts with a scene file, which does not
    // say whether its rig came from a preset.
    change_part<RigPart>(workspace, rig_lab,
                         [&](RigPart& part, const RigPart&) { part = RigPart(preset.definition); });
    (workspace.lab == rig_lab ? workspace.camera : workspace.cameras[rig_lab]) = preset.view;
}

BackwardLeft solve_backward(RigPart& part, rig::Workspace& scratch) {
    constexpr std::uint64_t max_work = 40'000'000;  // a second or so
    const rig::BackwardReport report =
        rig::solve_backward(part.rig, part.state.edit(), scratch, {.max_work = max_work});
    if (report.stopped && report.iterations == 0)
        throw std::invalid_argument(
            "the rig is so large, and has so many controls, that a backward solve would take too long");
    BackwardLeft left{{}, report.elements, report.stopped};
    if (report.worst) left.bone = part.rig.definition().elements[*report.worst].name;
    return left;
}

/// Solves without passing time. Units with memory have not seen the changes yet, so the next tick solves too.
void solve(Workspace& workspace, const Arguments& given) {
    auto& runtime = workspace.runtimes.of<RigRuntime>(rig_lab);
    const bool backward = given.has("direction") && given.text("direction") == "backward";
    change_part<RigPart>(workspace, rig_lab, [&](RigPart& part, const RigPart& before) {
        if (backward) {
            part.backward = solve_backward(part, runtime.workspace(part.rig));
            part.moving = true;
            if (!part.last_solved) part.last_solved = before.state.share();
            if (part.state != before.state) begin_take(part);
        } else {
            solve_now(part, runtime, workspace.clock.measured);
        }
        keep_recording(workspace, part, before);
    });
}

}  // namespace

Command rig_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                    void (*change)(RigPart&, const Arguments&)) {
    return part_command<RigPart>(
        rig_lab, name, title, std::move(arguments), help, Effect::Edit,
        [change](Workspace& workspace, RigPart& part, const RigPart& before, const Arguments& given) {
            change(part, given);
            keep_recording(workspace, part, before);
        });
}

Argument element_argument(const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [](const Workspace& w) {
        return names(rig_part(w).rig.definition().elements,
                     [](const rig::Element& each) { return each.name; });
    });
}

Argument control_argument(const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [](const Workspace& w) {
        std::vector<std::string> list;
        for (const rig::Element& each : rig_part(w).rig.definition().elements)
            if (each.kind == rig::ElementKind::Control) list.push_back(each.name);
        return list;
    });
}

Argument unit_argument(const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [](const Workspace& w) {
        return names(rig_part(w).rig.unit_names(), [](const std::string& each) { return each; });
    });
}

std::vector<std::size_t> element_list(const RigPart& part, const Arguments& given, const char* name) {
    std::vector<std::size_t> elements;
    for (const std::string& each : name_list(given, name)) {
        const auto at = part.rig.element(each);
        if (!at) throw Refused(std::string(name) + ": there is no element " + json_summary(each));
        elements.push_back(*at);
    }
    return elements;
}

std::vector<std::size_t> elements_given(const RigPart& part, const Arguments& given) {
    if (gives_one(given, "name", "names")) return {element_named(part, given.text("name"))};
    std::vector<std::size_t> elements = element_list(part, given, "names");
    if (elements.empty()) throw Refused("names: [] contains no elements");
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    return elements;
}

Argument json_argument(const char* name, bool required, const char* help) {
    return {.name = name, .type = ArgumentType::Any, .required = required, .help = help};
}

void add_solve_commands(CommandTable& table) {
    table.add(rig_command("rig.clear", "Remove everything from the rig", {},
                          "Removes every element, curve and unit",
                          [](RigPart& part, const Arguments&) { part = RigPart(); }));
    table.add(rig_command("rig.reset", "Reset the Rig lab", {}, "Resets this lab to its first state",
                          [](RigPart& part, const Arguments&) { part = first_rig(); }));
    table.add(part_command<RigPart>(
        rig_lab, "rig.select", "Select elements or a unit",
        {element_argument("element", false, "none if omitted"),
         name_list_argument("elements", "element", "; the last one is shown"),
         unit_argument("unit", false, "none if omitted"),
         switch_argument(
             "add",
             "true: adds to the selection, or with element toggles it; the unit stays selected if omitted")},
        "Selects elements, a unit, or both", select, Effect::Look));
    table.add("rig.read", "Read the pose of elements",
              {element_argument("name", false, "of the element"), name_list_argument("names", "name")},
              "Reads the poses of elements, and says how many transforms were worked out", Effect::Look,
              read);
    table.add("rig.copy", "Copy the rig as C++", {},
              "Copies the rig to the clipboard as a C++ program that uses the library", Effect::Look, copy);
    table.add("rig.preset", "Open a rig preset",
              {choice_argument("name", true, "which scene",
                               names(rig_presets(), [](const auto& each) { return each.name; }))},
              "Opens a preset", Effect::Edit, take_preset);
    table.add("rig.solve", "Solve the rig",
              {choice_argument("direction", false, "default: forward", {"forward", "backward"})},
              "Runs the units, or sets the controls to match the bones; no time passes", Effect::Edit, solve);
}

// Time: walks, going to a tick, clips, frame rates.

namespace {

constexpr double max_clip = static_cast<double>(max_clip_frames) * tick_seconds;

glm::vec3 place_of(const rig::Value& value) {
    const auto* pose = std::get_if<rig::Transform>(&value);
    return glm::vec3(pose ? pose->translation : std::get<glm::dvec3>(value));
}

/// The tick on path `to` with the same phase as `ticks` on path `from`.
std::uint32_t phase_of(const Motion& from, std::uint32_t ticks, const Motion& to) {
    const std::uint64_t round = ticks_per_round(from), at = (std::uint64_t{from.ticks} + ticks) % round;
    return static_cast<std::uint32_t>(at * ticks_per_round(to) / round);
}

/// Unless a centre is given, the path starts at the control, so the control does not jump. A control already
/// on the same path keeps its centre. `old`: null if it does not walk.
RigWalk walk_given(const RigPart& part, std::size_t at, const RigWalk* old, const Arguments& given) {
    const rig::Element& element = part.rig.definition().elements[at];
    if (!element.control) throw std::invalid_argument("\"" + element.name + "\" is not a control");
    if (!can_walk(element.control->kind))
        throw std::invalid_argument("only a transform or position control can follow a path; \"" +
                                    element.name + "\" is a " + control_title(element.control->kind));
    RigWalk walk = old != nullptr ? *old : RigWalk{element.name, {.radius = 0.5f}, false};
    walk.motion.path = motion_paths.value(given.text("path"));
    if (given.has("radius")) walk.motion.radius = given.number("radius");
    if (given.has("period")) walk.motion.period = given.number("period");
    if (given.has("turn")) walk.turn = given.boolean("turn");
    if (walk.turn && element.control->kind != rig::ControlKind::Transform)
        throw std::invalid_argument("only a transform control can turn along its path");
    const bool goes_on = old != nullptr && walk.motion.path == old->motion.path;
    walk.motion.ticks = goes_on ? phase_of(old->motion, part.take.tick, walk.motion) : 0;
    if (given.has("centre")) {
        walk.motion.centre = given.point("centre");
    } else if (!goes_on) {
        walk.motion.centre = glm::vec3(0.0f);
        walk.motion.centre = place_of(part.state->controls[at]) - glm::vec3(walk_point(walk.motion, 0.0));
    }
    check_path(walk.motion.centre, glm::vec3(walk.motion.radius), "the control's path");
    return walk;
}

void set_motions(RigPart& part, const Arguments& given) {
    const std::vector<std::size_t> controls = elements_given(part, given);
    std::vector<const RigWalk*> old(part.state->controls.size());
    for (const RigWalk& each : part.walks) old[element_named(part, each.control)] = &each;
    std::vector<RigWalk> walks;
    for (const std::size_t at : controls) walks.push_back(walk_given(part, at, old[at], given));
    std::erase_if(part.walks, [&](const RigWalk& each) {
        return std::ranges::binary_search(controls, element_named(part, each.control));
    });
    part.moving = true;
    part.rates.reset();
    begin_take(part);
    for (RigWalk& each : walks)
        if (each.motion.path != Motion::Path::Still) part.walks.push_back(std::move(each));
}

void go(Workspace& workspace, const Arguments& given) {
    if (given.has("tick") == given.has("seconds"))
        throw std::invalid_argument("give either a tick or seconds");
    const RigTake& take = rig_part(workspace).take;
    const double wanted =
        given.has("tick") ? given.integer("tick") : std::round(given.real("seconds") / tick_seconds);
    const double tick = wanted - static_cast<double>(take.began);
    const auto said = [](double ticks) { return std::to_string(static_cast<std::int64_t>(ticks)); };
    if (tick < 0.0)
        throw std::invalid_argument("the take begins at tick " + std::to_string(take.began) +
                                    ", after tick " + said(wanted));
    if (tick > max_take_ticks)
        throw std::invalid_argument("a take can be at most " + std::to_string(max_take_ticks) +
                                    " ticks long, so it ends before tick " + said(wanted));
    const bool modified = workspace.modified();
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    go_to(part, static_cast<std::uint32_t>(tick), rig_runtime(workspace));
    workspace.clock.playing = workspace.clock.replaying = false;
    workspace.ui.incident.reset();
    if (!modified) workspace.saved = workspace.document;  // playing does not modify the scene
}

/// The ticks played so far or, if a control walks, at least ten seconds.
std::uint32_t ticks_worth_looking_at(const RigPart& part) {
    if (part.take.last > 0) return part.take.last;
    if (part.walks.empty()) throw std::invalid_argument("nothing has been played yet: play, or give seconds");
    return 600;
}

/// Starts a new take, and plays.
void start_recording(Workspace& workspace, const Arguments&) {
    change_part<RigPart>(workspace, rig_lab, [&](RigPart& part, const RigPart&) {
        check_records(part);
        begin_take(part);
        part.take.recording = true;
    });
    workspace.clock.playing = true;
    workspace.clock.replaying = false;
    workspace.ui.incident.reset();
}

void record(Workspace& workspace, const Arguments& given) {
    change_part<RigPart>(workspace, rig_lab, [&](RigPart& part, const RigPart&) {
        if (part.take.recording && part.take.last == 0)
            throw std::invalid_argument("nothing has been played since rig.clip.start");
        const std::size_t ticks =
            given.has("seconds") ? static_cast<std::size_t>(std::lround(given.real("seconds") / tick_seconds))
                                 : ticks_worth_looking_at(part);
        if (const std::string lacks = keep_clip(part, part, ticks, rig_runtime(workspace)); !lacks.empty())
            workspace.toast("The clip is recorded: " + lacks);
    });
}

void write_clip(Workspace& workspace, const Arguments& given) {
    const Character character = clip_character(rig_part(workspace));
    const humanoid::Clip& clip = character.clips.front();
    const std::filesystem::path path =
        given.has("path") ? std::filesystem::path(given.text("path")) : new_file(workspace, "clip", ".glb");
    const ExportReport report = export_clip({.character = character,
                                             .original = clip,
                                             .corrected = clip,
                                             .rate = clip.rate,
                                             .outputs = &workspace.writes()},
                                            path);
    workspace.toast(written_text(path) + ": " + count_text(report.frames, "frame") + " of " +
                    count_text(clip.channels.size(), "bone") + read_back_text(report) +
                    sheared_text(character));
}

/// Keeps the frames solved so far.
void cancel_clip(RigPart& part, const Arguments&) {
    if (!part.clip_left || !part.clip_left->running)
        throw std::invalid_argument("no backward solve of a clip is running");
    ClipSolve stopped = *part.clip_left;
    stopped.running = false;
    part.clip_left = std::make_shared<const ClipSolve>(std::move(stopped));
}

void compare_rates(Workspace& workspace, const Arguments& given) {
    change_part<RigPart>(workspace, rig_lab, [&](RigPart& part, const RigPart&) {
        const double ticks = given.has("seconds") ? std::round(given.real("seconds") / tick_seconds)
                                                  : std::min(600u, ticks_worth_looking_at(part));
        start_rates(part, static_cast<std::uint32_t>(ticks));
    });
}

/// Finishes at once for callers that do not wait for ticks.
void finish_rates(Workspace& workspace) {
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    for (RatesWork work; part.rates && part.rates->running;) work.advance(part);
}

void cancel_rates(RigPart& part, const Arguments&) {
    if (!part.rates || !part.rates->running) throw std::invalid_argument("no frame rates are being compared");
    part.rates.reset();
}

void add_clip_commands(CommandTable& table) {
    table.add("rig.clip.start", "Start recording a clip", {},
              "Starts a new take, and plays; rig.clip.record stops, and keeps it as a clip", Effect::Edit,
              start_recording);
    table.add("rig.clip.record", "Record the take as a clip",
              {number_argument("seconds", "from the take's start; default: what was played", tick_seconds,
                               max_clip)},
              "Records the bones in the take as a clip, one pose per frame, 60 per second", Effect::Edit,
              record);
    table.add(
        "rig.clip.export", "Export the clip",
        {text_argument("path", false,
                       "a .gltf, .glb or .bvh file; default, in a window: a new .glb beside the scene")},
        "Writes the rig's bones and the recorded clip", Effect::Look, write_clip);
    table.add(rig_command("rig.clip.clear", "Remove the clip", {},
                          "Ends a recording, or else removes the clip", [](RigPart& part, const Arguments&) {
                              if (std::exchange(part.take.recording, false)) return;
                              part.clip.reset();
                              part.clip_left.reset();
                          }));
    table.add(rig_command("rig.clip.solve", "Solve the clip backward", {},
                          "Solves the clip backward, frame by frame, and marks frames on the timeline that "
                          "the rig cannot express; a few frames per tick",
                          [](RigPart& part, const Arguments&) { start_clip_solve(part); }));
    table.add(rig_command("rig.clip.cancel", "Stop the backward solve", {},
                          "Stops the backward solve of the clip", cancel_clip));
}

}  // namespace

void add_time_commands(CommandTable& table) {
    table.add(
        rig_command("rig.motion", "Move controls along a path",
                    {control_argument("name", false, "of a transform or position control"),
                     name_list_argument("names", "name"),
                     choice_argument("path", true, "the path, flat on the ground", motion_paths.names()),
                     point_argument("centre", false,
                                    "in the control's space; if omitted, the path starts at the control"),
                     number_argument("radius", "metres", 0, static_cast<double>(max_motion_radius)),
                     number_argument("period", "seconds per round", shortest_decimal(min_period),
                                     shortest_decimal(max_period)),
                     switch_argument("turn", "a transform control points its z axis along the path")},
                    "Moves controls along a path while the simulation runs", set_motions));
    table.add("rig.time", "Show a moment of the take",
              {number_argument("seconds", "as the clock shows them", 0, 1e9),
               integer_argument("tick", "of 1/60 s, instead of seconds", 0, 1e9)},
              "Pauses and goes to a moment of the take, earlier or later: shows exactly the pose that "
              "playing would",
              Effect::Look, go);
    table.add(
        {.name = "rig.rates",
         .title = "Compare frame rates",
         .arguments = {number_argument("seconds",
                                       "from the take's start; default: what was played, at most ten seconds",
                                       tick_seconds, max_rate_seconds)},
         .help = "Compares the take at 15, 30, 60, 144 Hz and at uneven frames: how far apart its bones get",
         .effect = Effect::Edit,
         .apply = compare_rates,
         .finish = finish_rates});
    table.add(rig_command("rig.rates.cancel", "Stop comparing frame rates", {},
                          "Stops the comparison of frame rates", cancel_rates));
    table.add(flip_command<RigPart>(rig_lab, "rig.flips"));
    add_clip_commands(table);
}

}  // namespace tendril::app
