#include "app/labs/rig/time_panel.hpp"
#include "app/labs/kit/folding.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>

#include "app/document/units.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/rates.hpp"
#include "app/labs/rig/walk.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

/// The control that the rows are of: the selected one, else one that walks, else the first that can.
const rig::Element* walker(const RigPart& part) {
    const auto can = [](const rig::Element& element) {
        return element.control && can_walk(element.control->kind);
    };
    const auto& elements = part.rig.definition().elements;
    if (const auto at = part.rig.element(part.selected.element); at && can(elements[*at]))
        return &elements[*at];
    if (!part.walks.empty())
        if (const auto at = part.rig.element(part.walks.front().control)) return &elements[*at];
    const auto first = std::ranges::find_if(elements, can);
    return first == elements.end() ? nullptr : &*first;
}

void walk_fields(const RigWalk& walk, bool turns, Emit& emit) {
    const std::string path = motion_paths.name(walk.motion.path);
    const auto set = [&](const char* argument, float value) {
        emit.continuously("rig.motion", {{"name", walk.control}, {"path", path}, {argument, value}});
    };
    float radius = walk.motion.radius, period = walk.motion.period;
    if (number_field("radius", radius, 0.01f, 0.0f, 10.0f, "%.2f m")) set("radius", radius);
    explain("How far the path goes to each side of its middle.");
    if (number_field("period", period, 0.02f, shortest_period, 60.0f, "%.2f s")) set("period", period);
    explain("How long one round takes.");
    if (!turns) return;
    bool turn = walk.turn;
    if (ImGui::Checkbox("Looks along the path", &turn))
        emit("rig.motion", {{"name", walk.control}, {"path", path}, {"turn", turn}});
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
    if (most.scale >= smallest_shown_scale) reading("", "scale %s", fixed_text(most.scale, 3).c_str());
    if (most.mm > 0.0 || most.degrees > 0.0 || most.scale > 0.0)
        note("Most: " + most.bone + ", " + most.between + ", " + fixed_text(most.seconds, 2) +
             " s into the take.");
}

}  // namespace

void walk_rows(const Workspace& workspace, Emit& emit) {
    const RigPart& part = rig_part(workspace);
    const rig::Element* const control = walker(part);
    if (!control) return;
    if (!folding_section(workspace, "Walk", emit)) return;
    const auto walk = std::ranges::find(part.walks, control->name, &RigWalk::control);
    const bool walks = walk != part.walks.end();
    int path = static_cast<int>(walks ? walk->motion.path : Motion::Path::Still);
    const auto titles = motion_paths.titles();
    if (choice_field(control->name.c_str(), path, titles.data(), static_cast<int>(titles.size())))
        emit("rig.motion",
             {{"name", control->name}, {"path", motion_paths.name(static_cast<Motion::Path>(path))}});
    explain(
        "The control follows a path, flat on the ground, from where it is. Dragging it ends that, and begins "
        "a take");
    if (!walks) return;
    walk_fields(*walk, control->control->kind == rig::ControlKind::Transform, emit);
    if (!workspace.clock.playing) note("Paused: press Space to let it walk.");
}

void time_rows(const Workspace& workspace, Emit& emit) {
    const RigPart& part = rig_part(workspace);
    if (folding_section(workspace, "Clip", emit)) clip_rows(part, emit);
    if (folding_section(workspace, "Frame rates", emit)) rate_rows(part, emit);
    if (folding_section(workspace, "What counts as a flip", emit, false))
        flip_rows(part.flips, rig_flip_words, emit);
}

}  // namespace tendril::app
