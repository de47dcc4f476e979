#include "app/labs/rig/time_panel.hpp"
#include "app/labs/kit/folding.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>

#include "app/document/units.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/past.hpp"
#include "app/labs/rig/rates.hpp"
#include "app/labs/rig/walk.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

/// The controls that the rows are of; shown is the first of them. Those selected that can walk, the active
/// one before others; else one that walks; else the first that can.
std::vector<std::size_t> walkers(const RigPart& part) {
    const auto& elements = part.rig.definition().elements;
    const auto can = [&](std::size_t at) {
        return elements[at].control && can_walk(elements[at].control->kind);
    };
    std::vector<std::size_t> all;
    for (const std::size_t each : part.selected.elements.all())
        if (can(each)) all.push_back(each);
    if (const auto active = std::ranges::find(all, part.selected.elements.active()); active != all.end())
        std::iter_swap(all.begin(), active);
    if (!all.empty()) return all;
    if (!part.walks.empty())
        if (const auto at = part.rig.element(part.walks.front().control)) return {*at};
    for (std::size_t i = 0; i < elements.size(); ++i)
        if (can(i)) return {i};
    return {};
}

/// Those that follow the same path, and can turn along it where `turning`.
std::vector<std::size_t> alike(const RigPart& part, const std::vector<std::size_t>& controls,
                               const RigWalk& walk, bool turning) {
    std::vector<bool> same(part.state.controls.size());
    for (const RigWalk& each : part.walks)
        if (each.motion.path == walk.motion.path) same[*part.rig.element(each.control)] = true;
    std::vector<std::size_t> found;
    for (const std::size_t at : controls)
        if (same[at] &&
            (!turning || part.rig.definition().elements[at].control->kind == rig::ControlKind::Transform))
            found.push_back(at);
    return found;
}

/// What is set is set on all that follow the same path.
void walk_fields(const RigPart& part, const std::vector<std::size_t>& controls, const RigWalk& walk,
                 Emit& emit) {
    const bool turns =
        part.rig.definition().elements[controls.front()].control->kind == rig::ControlKind::Transform;
    const std::string path = motion_paths.name(walk.motion.path);
    const auto set = [&](const char* argument, ArgumentValue value, bool turning = false) {
        emit.continuously("rig.motion", {which(part, alike(part, controls, walk, turning)),
                                         {"path", path},
                                         {argument, std::move(value)}});
    };
    float radius = walk.motion.radius, period = walk.motion.period;
    if (number_field("radius", radius, 0.01f, 0.0f, 10.0f, "%.2f m")) set("radius", radius);
    explain("How far the path goes to each side of its middle.");
    if (number_field("period", period, 0.02f, min_period, 60.0f, "%.2f s")) set("period", period);
    explain("How long one round takes.");
    if (!turns) return;
    bool turn = walk.turn;
    if (ImGui::Checkbox("Looks along the path", &turn)) set("turn", turn, true);
    explain("The control turns with the path. Off, it keeps the rotation that it has.");
}

std::string clip_text(const RigPart& part) {
    const std::string frames = std::to_string(part.clip->frames()) + " frames";
    if (!part.clip_left) return frames + ", not solved backward yet.";
    const ClipSolve& solve = *part.clip_left;
    if (solve.running) return std::to_string(solve.done()) + " of " + frames + " solved.";
    const auto left =
        std::ranges::count_if(solve.left, [](const FrameLeft& each) { return !each.expressed(); });
    if (left == 0) return "The rig expresses all of the " + frames + ".";
    const FrameLeft& worst = solve.left[*worst_frame(solve)];
    return std::to_string(left) + " of " + frames +
           " cannot be expressed. Worst: " + part.clip->bones[worst.bone] + ", " +
           left_text(static_cast<double>(worst.mm), static_cast<double>(worst.degrees),
                     static_cast<double>(worst.scale)) +
           (worst.stopped ? "; stopped before the end." : ".");
}

void clip_rows(const RigPart& part, Emit& emit) {
    const bool running = part.clip_left && part.clip_left->running;
    const bool something = part.take.last > 0 || !part.walks.empty();
    if (row_button("Record", 3, something,
                   something ? "The bones as the take has them become a clip" : "Play first"))
        emit("rig.clip.record");
    if (running) {
        if (row_button("Cancel", 3, true, "What is solved stays")) emit("rig.clip.cancel");
    } else if (row_button("Solve", 3, part.clip != nullptr,
                          "Backward: looks for the controls that give each frame; the timeline shows what is "
                          "left")) {
        emit("rig.clip.solve");
    }
    if (row_button("Clear", 3, part.clip != nullptr, "Removes the clip")) emit("rig.clip.clear");
    end_row();
    if (running)
        ImGui::ProgressBar(
            static_cast<float>(part.clip_left->done()) / static_cast<float>(part.clip->frames()),
            {-1.0f, 0.0f}, "");
    if (part.clip) note(clip_text(part));
}

void rate_rows(const RigPart& part, Emit& emit) {
    const bool something = part.take.last > 0 || !part.walks.empty();
    const bool running = part.rates && part.rates->running;
    if (running) {
        if (row_button("Cancel##rates", 1, true, "Stops the comparison")) emit("rig.rates.cancel");
    } else if (row_button(
                   "Compare frame rates", 1, something,
                   something ? "Runs the take at 15, 30, 60, 144 Hz and at uneven frames" : "Play first")) {
        emit("rig.rates");
    }
    end_row();
    if (!part.rates) return;
    const RateDifference& most = *part.rates;
    if (running) ImGui::ProgressBar(rates_done(most), {-1.0f, 0.0f}, "");
    reading("apart", "%s mm, %s\u00b0", fixed_text(most.mm, most.mm < 10.0 ? 3 : 1).c_str(),
            fixed_text(most.degrees, most.degrees < 10.0 ? 3 : 1).c_str());
    explain("The most that any bone differs between two frame rates");
    if (most.scale >= min_shown_scale) reading("", "scale %s", fixed_text(most.scale, 3).c_str());
    if (most.mm > 0.0 || most.degrees > 0.0 || most.scale > 0.0)
        note("Most: " + most.bone + ", " + most.between + ", " + fixed_text(most.seconds, 2) +
             " s into the take.");
}

constexpr PastHelp past_help{
    "What of the last ten seconds is plotted below the scene, of the selected element: how it is turned "
    "within its parent, from its initial pose",
    "Where the bones were, at every half second"};

}  // namespace

void walk_rows(const Workspace& workspace, Emit& emit) {
    const RigPart& part = rig_part(workspace);
    const std::vector<std::size_t> controls = walkers(part);
    if (controls.empty()) return;
    if (!folding_section(workspace, "Walk", emit)) return;
    const std::string& name = part.rig.definition().elements[controls.front()].name;
    const auto walk = std::ranges::find(part.walks, name, &RigWalk::control);
    const bool walks = walk != part.walks.end();
    int path = static_cast<int>(walks ? walk->motion.path : Motion::Path::Still);
    const auto titles = motion_paths.titles();
    const std::string others =
        controls.size() > 1 ? " and " + std::to_string(controls.size() - 1) + " more" : "";
    if (choice_field((name + others).c_str(), path, titles.data(), static_cast<int>(titles.size())))
        emit("rig.motion",
             {which(part, controls), {"path", motion_paths.name(static_cast<Motion::Path>(path))}});
    explain(
        "The control follows a path, flat on the ground, from where it is. Dragging it ends that, and begins "
        "a take");
    if (!walks) return;
    walk_fields(part, controls, *walk, emit);
    if (!workspace.clock.playing) note("Paused: press Space to let it walk.");
}

void time_rows(const Workspace& workspace, Emit& emit) {
    const RigPart& part = rig_part(workspace);
    if (folding_section(workspace, "Clip", emit)) clip_rows(part, emit);
    if (folding_section(workspace, "Frame rates", emit)) rate_rows(part, emit);
    if (folding_section(workspace, "Last ten seconds", emit))
        past_view_rows(workspace, rig_past(), past_help, emit);
    if (folding_section(workspace, "What counts as a flip", emit, false))
        flip_rows(part.flips, rig_flip_words, emit);
}

}  // namespace tendril::app
