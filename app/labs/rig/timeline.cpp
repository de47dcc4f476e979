// The strip below the scene: the take, where it is, what happened in it and which frames of the clip the rig
// cannot express; or the last ten seconds, in which a drag takes time though the simulation is paused.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "app/document/units.hpp"
#include "app/labs/kit/past_strip.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/past.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/settings.hpp"
#include "app/widgets/icons.hpp"

namespace tendril::app {
namespace {

constexpr std::uint64_t shortest = 600, longest = 2ull * max_take_ticks, lead = 60;  ///< ticks

/// From a little before the take, or from the clip where that is near, to what is farthest to the right.
struct Window {
    std::uint64_t first = 0, last = 0;
};
Window window_of(const RigPart& part) {
    const RigTake& take = part.take;
    Window window{take.began - std::min(take.began, lead), take.began + take.last};
    if (take.began < shortest) window.first = 0;
    if (part.clip) {
        const std::uint64_t from = part.clip->began, to = from + part.clip->frames() - 1;
        if (from < window.first && window.last - from <= longest) window.first = from;
        if (to > window.last && from >= window.first && to - window.first <= longest) window.last = to;
    }
    window.last = std::max({window.last, take.now(), window.first + shortest});
    return window;
}
/// As it is of the last moment that is remembered too: while that is shown again the strip keeps still.
Window shown_window(const Workspace& workspace) {
    Window window = window_of(rig_part(workspace));
    if (workspace.rewind.empty()) return window;
    const Window newest = window_of(dynamic_cast<const RigPart&>(*workspace.rewind.at(0).part));
    const Window both{std::min(window.first, newest.first), std::max(window.last, newest.last)};
    return both.last - both.first <= longest ? both : window;
}

/// From 0 at a tenth of a millimetre to 1 at a metre.
float share_of(const FrameLeft& left) {
    return static_cast<float>(std::clamp((std::log10(std::max(amount(left), 1e-4)) + 4.0) / 4.0, 0.0, 1.0));
}

/// What is expressed stands back; what is not goes from yellow to red.
TimeBar bar_of(const FrameLeft& left, const Palette& colours) {
    if (left.expressed()) return {glm::mix(colours.panel, colours.axis_y, 0.55f), 0.1f};
    const float share = share_of(left);
    return {glm::mix(rgb(0xE6C229), rgb(0xD5442E), share), 0.3f + 0.7f * share};
}

std::vector<TimeBar> clip_bars(const RigPart& part, const Palette& colours) {
    std::vector<TimeBar> bars;
    for (std::size_t i = 0; i < part.clip->frames(); ++i)
        bars.push_back(part.clip_left && i < part.clip_left->done()
                           ? bar_of(part.clip_left->left[i], colours)
                           : TimeBar{glm::mix(colours.panel, colours.text_dim, 0.4f), 0.1f});
    return bars;
}

/// "2.35 s: the rig cannot express left 6: 12.3 mm, 8.1 degrees are left"
std::string told(const RigPart& part, std::uint64_t tick) {
    std::string text = fixed_text(static_cast<double>(tick) * tick_seconds, 2) + " s";
    if (tick < part.take.began)
        text +=
            ", before the take, which began where the rig was last edited: of what was then, only the last "
            "ten seconds are known";
    if (!part.clip || tick < part.clip->began || tick - part.clip->began >= part.clip->frames()) return text;
    const std::size_t frame = tick - part.clip->began;
    text += "\nClip, frame " + std::to_string(frame) + ": ";
    if (!part.clip_left || frame >= part.clip_left->done()) return text + "not solved backward yet";
    const FrameLeft& left = part.clip_left->left[frame];
    if (left.expressed()) return text + "the rig can express it";
    return text + "the rig cannot express " + part.clip->bones[left.bone] + ": " +
           left_text(static_cast<double>(left.mm), static_cast<double>(left.degrees),
                     static_cast<double>(left.scale)) +
           " are left" + (left.stopped ? ", stopped before the end" : "");
}

/// Its incidents, where in the take they were; `numbers`: which they are among all. Not those from before the
/// strip begins.
std::vector<TimeMark> take_marks(const Workspace& workspace, const Window& window,
                                 std::vector<std::size_t>& numbers) {
    std::vector<TimeMark> marks;
    const auto& incidents = workspace.rewind.incidents();
    for (std::size_t i = 0; i < incidents.size(); ++i) {
        const auto after = std::dynamic_pointer_cast<const RigPart>(workspace.around(incidents[i]).after);
        if (!after || after->take.now() < window.first || after->take.now() > window.last) continue;
        marks.push_back(incident_mark(incidents[i], static_cast<int>(after->take.now() - window.first),
                                      palette(workspace.settings.theme)));
        numbers.push_back(i);
    }
    return marks;
}

/// To the tick before or after this one, of the take.
void step_button(const RigPart& part, bool back, Emit& emit) {
    const bool possible = back ? part.take.tick > 0 : part.take.tick < max_take_ticks;
    if (icon_button(back ? "back" : "forward", back ? Icon::ChevronLeft : Icon::ChevronRight,
                    back ? "Pauses, and goes back by a tick of the take" : "Pauses, and goes on by a tick",
                    possible))
        emit("rig.time", {{"tick", back ? part.take.now() - 1 : part.take.now() + 1}});
    ImGui::SameLine();
}

void take_strip(const Workspace& workspace, Emit& emit) {
    const RigPart& part = rig_part(workspace);
    const Window window = shown_window(workspace);
    std::vector<std::size_t> numbers;
    const auto at = [&](std::uint64_t tick) { return static_cast<int>(tick - window.first); };
    TimeStrip strip{.ticks = at(window.last),
                    .seconds = tick_seconds,
                    .first_seconds = static_cast<double>(window.first) * tick_seconds,
                    .start = at(part.take.began),
                    .known = at(part.take.began + part.take.last),
                    .bars_from = 0,
                    .bars = {},
                    .marks = take_marks(workspace, window, numbers)};
    if (part.clip && part.clip->began >= window.first && part.clip->began <= window.last) {
        strip.bars_from = at(part.clip->began);
        strip.bars = clip_bars(part, palette(workspace.settings.theme));
    }
    int tick = at(part.take.now());
    const TimeStripUse use = time_strip("take", tick, strip);
    if (use.mark_clicked)
        emit("time.incident", {{"number", numbers[static_cast<std::size_t>(use.on_mark)]}});
    else if (use.moved)
        emit.continuously("rig.time", {{"tick", window.first + static_cast<std::uint64_t>(tick)}});
    if (use.on_mark >= 0)
        tell_incident(workspace.rewind.incidents()[numbers[static_cast<std::size_t>(use.on_mark)]]);
    else if (use.hovered >= 0)
        tell_strip(told(part, window.first + static_cast<std::uint64_t>(use.hovered)).c_str());
}

}  // namespace

float RigLab::timeline_height(const Workspace& workspace) const {
    if (rig_part(workspace).state.controls.empty()) return 0.0f;
    return strip_height + past_plot_height(workspace.settings, rig_past());
}

void RigLab::timeline(const Workspace& workspace, Emit& emit) const {
    const bool past = rig_strip_setting().chosen(workspace.settings) == 1;
    const RigPart& part = rig_part(workspace);
    record_button(workspace, emit);
    replay_button(workspace, emit);
    if (const LabSetting strip = rig_strip_setting(); other_strip_button(past, "take"))
        emit(strip.command, {{strip.argument, past ? "take" : "past"}});
    std::optional<StripLine> past_line;
    if (past) {
        past_line = past_time_strip(workspace, emit);
    } else {
        step_button(part, true, emit);
        step_button(part, false, emit);
        take_strip(workspace, emit);
    }
    past_plot(workspace, rig_past(), rig_past_curve(workspace), past_line, emit);
}

}  // namespace tendril::app
