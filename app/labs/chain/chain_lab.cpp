#include "app/labs/chain/chain_lab.hpp"

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/engine_trace.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/past.hpp"

namespace tendril::app {
namespace {

/// "Joint 0 (head)", "Joint 3"
std::string name_of(const ChainPart& part, std::size_t index) {
    const std::string end = end_name(part, index);
    return "Joint " + std::to_string(index) + (end.empty() ? "" : " (" + end + ")");
}

/// The mouse's effect on a joint in mode Reach.
std::string joint_hint(const ChainPart& part, std::size_t index) {
    const std::string joint = name_of(part, index);
    if (part.study.open()) return joint + ": click selects it.";
    return joint + ": click selects it, drag moves it; " +
           (index == 0 ? "the tip keeps reaching for the target." : "root and target stay.");
}

/// Joints cannot be dragged while a study is open, since they show its step, nor along a curve.
Handle joint_handle(const ChainPart& part, std::size_t index, glm::vec3 at) {
    return {"segment." + std::to_string(index),
            segment_pick(index),
            {at},
            part.study.open() || part.mode == ChainMode::Curve ? Drag::Nothing : Drag::Position};
}

Bounds bounds_around(const std::vector<glm::vec3>& points, float smallest = 0.5f) {
    glm::vec3 low = points.front(), high = low;
    for (const glm::vec3& each : points) low = glm::min(low, each), high = glm::max(high, each);
    return bounds_of(low, high, smallest);
}

}  // namespace

std::shared_ptr<Part> ChainLab::blank() const {
    return std::make_shared<ChainPart>(first_chain());
}

CameraPose ChainLab::first_view() const {
    return {.target = {3.5f, 0.7f, 0.0f},
            .yaw = glm::radians(-20.0f),
            .pitch = glm::radians(20.0f),
            .distance = 12.5f};
}

void ChainLab::add_commands(CommandTable& table) const {
    add_chain_commands(table);
}

bool ChainLab::moving(const Workspace& workspace) const {
    // A moving target would replace the solve under the microscope.
    const ChainPart& part = chain_part(workspace);
    return part.motion.path != Motion::Path::Still && part.study.kind != Study::Kind::Microscope;
}

void ChainLab::step(Workspace& workspace) const {
    ChainRuntime& runtime = workspace.runtimes.of<ChainRuntime>(chain_lab);
    const int due = workspace.clock.whole_ticks();
    const auto stopped = guarded_step<ChainPart>(workspace, chain_lab, [&](ChainPart& part) {
        for (int tick = 0; tick < due; ++tick) {
            part.study.gesture_begins = true;
            part.motion.ticks = (part.motion.ticks + 1) % ticks_per_round(part.motion);
            reach_for(part, motion_point(part.motion, part.motion.ticks), runtime);
            if (part.mode == ChainMode::Curve) follow_curve(part);
            check_range(part);
        }
        keep_step(part, runtime);
    });
    if (!stopped) return;
    workspace.document.edit<ChainPart>(chain_lab).motion.path = Motion::Path::Still;
    workspace.toast(*stopped, ToastKind::Refusal);
}

/// True if the microscope or the race plays.
bool ChainLab::working(const Workspace& workspace) const {
    return chain_part(workspace).study.pace > 0.0f;
}

void ChainLab::work(Workspace& workspace) const {
    const std::size_t last = shown_chain(workspace).last();
    const bool modified = workspace.modified();  // playback does not mark the scene as modified
    auto& part = workspace.document.edit<ChainPart>(chain_lab);
    part.study.play(tick_seconds * static_cast<double>(workspace.clock.speed), last);
    if (!modified) workspace.saved = workspace.document;
}

std::uint64_t ChainLab::tick_work(const Workspace& workspace) const {
    const ChainPart& part = chain_part(workspace);
    return part.chain.size() * static_cast<std::uint64_t>(iterations_of(part, part.mode));
}

std::vector<Handle> ChainLab::handles(const Workspace& workspace) const {
    const ChainPart& part = chain_part(workspace);
    std::vector<Handle> handles;
    if (part.mode == ChainMode::Curve)
        for (std::size_t i = 0; i < part.curve.points.size(); ++i)
            handles.push_back(*handle(workspace, control_pick(i)));
    else
        handles.push_back(*handle(workspace, target_pick));
    if (part.mode == ChainMode::Reach && part.reach.options.pole)
        handles.push_back(*handle(workspace, pole_pick));
    const std::vector<glm::vec3> joints = shown_joints(shown_chain(workspace));
    for (std::size_t i = 0; i < joints.size(); ++i) handles.push_back(joint_handle(part, i, joints[i]));
    return handles;
}

std::optional<Handle> ChainLab::handle(const Workspace& workspace, PickId pick) const {
    const ChainPart& part = chain_part(workspace);
    const bool curved = part.mode == ChainMode::Curve;  // its target is the last control point
    if (pick == target_pick && !curved) return Handle{"target", target_pick, {part.target}};
    if (const auto control = picked_control(pick); control && curved && *control < part.curve.points.size())
        return Handle{"control." + std::to_string(*control), pick, {part.curve.points[*control]}};
    if (const auto at = curved ? picked_on_curve(part, pick) : std::nullopt)
        return Handle{
            "curve", pick, {ik::curve_point(part.curve.points, part.curve.options.kind, *at)}, Drag::Nothing};
    if (pick == pole_pick && part.reach.options.pole)
        return Handle{"pole", pole_pick, {*part.reach.options.pole}};
    if (const auto end = picked_limit(pick)) return limit_handle(part, *end);
    if (pick < segment_pick(0) || picked_segment(pick) >= part.chain.size()) return std::nullopt;
    const std::size_t index = picked_segment(pick);
    const ShownChain shown = shown_chain(workspace);
    return joint_handle(part, index, shown.trace ? shown_joints(shown)[index] : part.chain.position(index));
}

std::string ChainLab::hint(const Workspace& workspace, PickId pick) const {
    const ChainPart& part = chain_part(workspace);
    if (pick == no_pick) return {};
    if (pick == target_pick) {
        return std::string("Target: drag to reach for it (") + chain_modes.title(part.mode) +
               "). Hold X, Y or Z for one axis, "
               "Shift for the ground plane.";
    }
    if (pick == pole_pick)
        return "Pole target: the elbow or knee points at it. Drag to swivel the chain about the root-tip "
               "line.";
    if (const auto control = picked_control(pick))
        return "Control point " + std::to_string(*control) +
               ": drag it to bend the curve; click selects it, Delete removes it.";
    if (picked_limit(pick)) return "Limit: drag to set it, in whole degrees; click selects its joint.";
    if (pick >= first_curve_pick) return "Curve: click adds a control point.";
    const std::size_t index = picked_segment(pick);
    if (part.mode == ChainMode::Reach) return joint_hint(part, index);
    if (part.mode == ChainMode::Curve) return name_of(part, index) + ": click selects it.";
    return name_of(part, index) + ": click selects it, drag pulls it.";
}

std::string ChainLab::invitation(const Workspace& workspace) const {
    const ChainPart& part = chain_part(workspace);
    if (part.chain.empty()) return "Add a joint, or take a preset.";
    return traced_pose(part) ? "Drag along the strip below: each frame of the trace."
                             : "Drag the orange ball.";
}

Bounds ChainLab::bounds(const Workspace& workspace, bool selection_only) const {
    const ChainPart& part = chain_part(workspace);
    if (selection_only && part.chosen_point) {
        const bool target = part.chosen_point == ChainPoint::Target;
        return {target ? part.target : part.reach.options.pole.value_or(part.target), 0.5f};
    }
    std::vector<glm::vec3> all;
    if (selection_only && !part.along.selection.empty()) {
        for (const std::size_t i : part.along.selection.all()) all.push_back(part.curve.points[i]);
        return bounds_around(all);
    }
    if (selection_only && !part.selection.empty()) {
        for (const std::size_t i : part.selection.all()) {
            const glm::vec3 around(1.5f * part.chain.length(i) / glm::sqrt(3.0f));
            all.insert(all.end(), {part.chain.position(i) - around, part.chain.position(i) + around});
        }
        return bounds_around(all);
    }
    if (const TracedPose* const pose = traced_pose(part)) return bounds_around(traced_points(*pose));
    all = positions(part.chain);
    all.push_back(part.target);
    if (part.mode == ChainMode::Curve)
        all.insert(all.end(), part.curve.points.begin(), part.curve.points.end());
    all.insert(all.end(), part.study.start.begin(), part.study.start.end());
    if (part.mode == ChainMode::Reach && part.reach.options.pole) all.push_back(*part.reach.options.pole);
    // A chain of a few centimetres fills the view as a long one does.
    const float reach = part.chain.reach();
    return bounds_around(all, reach > 0.0f ? std::clamp(0.5f * reach, 0.001f, 0.5f) : 0.5f);
}

std::vector<PaneTitle> ChainLab::panes(const Workspace& workspace) const {
    return race_panes(shown_chain(workspace), palette(workspace.settings.theme));
}

namespace {

/// The wider of a racer's texts: at its end, or in the race's last iteration.
std::string widest_outcome(const Racer& racer, std::size_t last) {
    const std::string end = outcome_text(racer, racer_at(racer, last)),
                      running = progress_text({.iteration = static_cast<int>(last), .joints = {}});
    return end.size() > running.size() ? end : running;
}

}  // namespace

std::vector<LegendRow> ChainLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    const ShownChain shown = shown_chain(workspace);
    const ChainPart& part = shown.part;
    std::vector<LegendRow> rows;
    if (shown.race) {
        // Side by side, each pane has a title.
        for (const Racer& racer : shown.race->racers) {
            if (part.study.side_by_side && shown.race->racers.size() > 1) break;
            const RacerAt at = racer_at(racer, shown.step());
            rows.push_back({.name = solver_title(racer.method),
                            .colour = solver_colour(colours, racer.method),
                            .numbers = {outcome_text(racer, at), error_reading(at)},
                            .widest = {widest_outcome(racer, shown.last()), "error 888.8 mm"}});
        }
        if (shown.race->racers.size() > 1 && !part.study.side_by_side)
            rows.push_back({"same place, drawn side by side", colours.neutral});
        rows.push_back({"root", colours.head});
        rows.push_back({"start", colours.ghost});
        rows.push_back({"target", colours.target});
        return rows;
    }
    const bool curved = part.mode == ChainMode::Curve, rooted = curved || part.mode == ChainMode::Reach;
    rows = {{rooted ? "root" : "head", colours.head},
            {rooted ? "tip" : "tail", colours.tail},
            {curved ? "curve's end" : "target", colours.target},
            {"selection", colours.selection, true}};
    if (curved) rows.push_back({"curve", curve_colour(colours)});
    if (shown.trace) rows.push_back({"this step", colours.accent, true});
    if (shown.trace) rows.push_back({"start, earlier iterations", colours.ghost});
    if (const TracedPose* const pose = traced_pose(part))
        rows.push_back({"Tendril's solve", solver_colour(colours, pose->trace->view.method)});
    if (workspace.ui.incident) rows.push_back({"before it happened", colours.ghost});
    if (!part.study.open()) add_ghost_legend(workspace, chain_past(), rows);
    if (part.mode != ChainMode::Reach) return rows;
    if (part.reach.options.pole) rows.push_back({"pole", pole_colour(colours)});
    if (is_limited(part.reach)) rows.push_back({"limit", colours.ghost, true});
    if (is_limited(part.reach)) rows.push_back({"active limit", colours.limit, true});
    return rows;
}

/// On in a race: without the legend its solvers cannot be told apart.
bool ChainLab::labels_pictures(const Workspace& workspace) const {
    return chain_part(workspace).study.kind == Study::Kind::Race;
}

std::function<void()> ChainLab::picture_plot(const Workspace& workspace, const Palette& palette) const {
    const ShownChain shown = shown_chain(workspace);
    if (!shown.race) return {};
    return [shown, &palette] { race_plot(shown, false, palette); };
}

std::vector<MouseHelp> ChainLab::mouse_help() const {
    return {{"Shift+click on a joint", "adds it to the selection, or takes it out"},
            {"Ctrl+drag on nothing", "draws a box that selects the joints in it; with Shift it adds them"},
            {"Click on a curve", "adds a control point there"},
            {"Drag an end of an arc", "sets that limit, in a plane"}};
}

std::vector<Shortcut> ChainLab::shortcuts() const {
    constexpr bool in_menu = true, hidden = false, typing = true, repeats = true;
    const auto step = [&](const char* chord, const char* by, int count, const char* title) {
        return Shortcut{*chord_from_name(chord), "study.step", {{by, count}}, title,
                        "Microscope and race",   hidden,       !typing,       repeats};
    };
    return {
        delete_shortcut("chain.remove_selected"),
        {*chord_from_name("b"), "view.segments", {}, "", "View", in_menu},
        step("right", "by", 1, "Microscope, race: step forward"),
        step("left", "by", -1, "Microscope, race: step back"),
        step("shift+right", "iterations", 1, "Microscope, race: iteration forward"),
        step("shift+left", "iterations", -1, "Microscope, race: iteration back"),
    };
}

std::vector<FileKind> ChainLab::files() const {
    return {{"traces", {".jsonl", ".csv", ".log"}, "chain.trace", {}, begins_like_trace}};
}

std::vector<LabSetting> ChainLab::settings() const {
    return {segment_style(), reach_sphere(), curve_frames()};
}

std::vector<CommandCall> ChainLab::opening() const {
    return {{"chain.preset", {{"name", "reaching_arm"}}},
            // In the view plane through root and pole target, so that a drag passes over the pole target.
            {"chain.motion", {{"path", "sweep"}, {"radius", 0.4f}, {"period", 9.0f}}},
            {"view.segments", {{"style", "bones"}}},
            {"view.reach_sphere", {{"show", "on"}}},
            {"camera.set",
             {{"target", glm::vec3(0.85f, 1.05f, 0.2f)},
              {"yaw_deg", -8.0f},
              {"pitch_deg", 15.0f},
              {"distance", 7.0f}}}};
}

std::vector<CommandCall> ChainLab::calm() const {
    return {{"chain.motion", {{"path", "still"}}}};
}

}  // namespace tendril::app
