#include "app/labs/rig/time_panel.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "app/fields/field_rows.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/draw.hpp"
#include "app/labs/rig/panel.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rig/take.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

/// The controls that the rows edit; the first one's walk is shown. The selected controls that can walk, the
/// active one first; without any, a control that walks; without that, the first that can.
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

/// The controls on the same path; with `turning`, only those that can turn along it.
std::vector<std::size_t> alike(const RigPart& part, const std::vector<std::size_t>& controls,
                               const RigWalk& walk, bool turning) {
    std::vector<bool> same(part.state->controls.size());
    for (const RigWalk& each : part.walks)
        if (each.motion.path == walk.motion.path) same[*part.rig.element(each.control)] = true;
    std::vector<std::size_t> found;
    for (const std::size_t at : controls)
        if (same[at] &&
            (!turning || part.rig.definition().elements[at].control->kind == rig::ControlKind::Transform))
            found.push_back(at);
    return found;
}

/// Edits all controls on the same path.
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
    explain("The control turns with the path. Off: it keeps its rotation.");
}

std::string clip_text(const RigPart& part) {
    const std::string frames = std::to_string(part.clip->frames()) + " frames";
    if (!part.clip_left)
        return fixed_text(static_cast<double>(part.clip->frames() - 1) * tick_seconds, 2) + " s, " + frames +
               '.';
    const ClipSolve& solve = *part.clip_left;
    if (solve.running) return std::to_string(solve.done()) + " of " + frames + " solved.";
    if (solve.done() < part.clip->frames())
        return "Stopped after " + std::to_string(solve.done()) + " of " + frames + '.';
    const auto left =
        std::ranges::count_if(solve.left, [](const FrameLeft& each) { return !each.expressed(); });
    if (left == 0) return "The rig can express all " + frames + ".";
    const FrameLeft& worst = solve.left[*worst_frame(solve)];
    return std::to_string(left) + " of " + frames +
           " cannot be expressed. Worst: " + part.clip->bones[worst.bone] + ", " +
           left_text(static_cast<double>(worst.mm), static_cast<double>(worst.degrees),
                     static_cast<double>(worst.scale)) +
           (worst.stopped ? "; stopped before the end." : ".");
}

void clip_rows(const RigPart& part, Emit& emit) {
    const bool running = part.clip_left && part.clip_left->running;
    const RigTake& take = part.take;
    if (!take.recording) {
        if (row_button("Record", 3, true, "Starts a new take, and keeps it as a clip at Stop"))
            emit("rig.clip.start");
    } else if (row_button("Stop", 3, take.last > 0,
                          "Keeps the bones' motion since Record. Changing the rig stops it too")) {
        emit("rig.clip.record");
    }
    if (running) {
        if (row_button("Cancel", 3, true, "Frames solved so far are kept")) emit("rig.clip.cancel");
    } else if (row_button(
                   "Solve", 3, part.clip != nullptr,
                   "Backward: finds the controls for each frame; the timeline shows the errors left")) {
        emit("rig.clip.solve");
    }
    if (row_button("Clear", 3, part.clip || take.recording,
                   take.recording ? "Ends the recording" : "Removes the clip"))
        emit("rig.clip.clear");
    end_row();
    if (running)
        ImGui::ProgressBar(
            static_cast<float>(part.clip_left->done()) / static_cast<float>(part.clip->frames()),
            {-1.0f, 0.0f}, "");
    if (const std::size_t room = clip_room(part); take.recording)
        note(seconds_text(take.last) + " recorded" +
             (take.last > room ? "; the clip will hold the last " + seconds_text(room) : "") + '.');
    else if (part.clip)
        note(clip_text(part));
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
    reading("apart", "%s, %s\u00b0",
            (most.mm < 10.0 ? fixed_text(most.mm, 3) + " mm" : length_text(1e-3 * most.mm)).c_str(),
            fixed_text(most.degrees, most.degrees < 10.0 ? 3 : 1).c_str());
    explain("The largest distance and angle between the poses of one bone at two frame rates.");
    if (most.scale >= min_shown_scale) reading("", "scale %s", fixed_text(most.scale, 3).c_str());
    if (most.mm > 0.0 || most.degrees > 0.0 || most.scale > 0.0)
        note("Most: " + most.bone + ", " + most.between + ", " + fixed_text(most.seconds, 2) +
             " s into the take.");
}

}  // namespace

void walk_rows(const Workspace& workspace, Emit& emit) {
    const RigPart& part = rig_part(workspace);
    const std::vector<std::size_t> controls = walkers(part);
    if (controls.empty()) return;
    const FoldingSection open(workspace, "Walk", emit);
    if (!open) return;
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
        "The control follows a horizontal path from its position. Dragging it ends the path and starts a "
        "take");
    if (!walks) return;
    walk_fields(part, controls, *walk, emit);
    if (!workspace.clock.playing) note("Paused: press Space to let it walk.");
}

void time_rows(const Workspace& workspace, Emit& emit) {
    const RigPart& part = rig_part(workspace);
    if (const FoldingSection open(workspace, "Clip", emit, false); open) clip_rows(part, emit);
    folding_section(workspace, "Analyse", emit, false, [&](MoreRows& more) {
        past_rows(workspace, rig_past(), emit);
        rate_rows(part, emit);
        FieldRows(part.flips, "rig.flips", emit).under(more).all();
    });
}

// The strip below the scene. Shows the take with its current tick, incidents, and clip frames that the rig
// cannot express; or the last ten seconds, in which a drag takes time even while the simulation is paused.

namespace {

constexpr std::uint64_t shortest = 600, longest = 2ull * max_take_ticks, lead = 60;  ///< ticks

/// The ticks shown: from shortly before the take, or from a nearby clip, to the end of the later one.
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
/// Also covers the newest moment in the history, so the strip does not move while an earlier one is shown.
Window shown_window(const Workspace& workspace) {
    Window window = window_of(rig_part(workspace));
    if (workspace.rewind.empty()) return window;
    const Window newest = window_of(dynamic_cast<const RigPart&>(*workspace.rewind.at(0).part));
    const Window both{std::min(window.first, newest.first), std::max(window.last, newest.last)};
    return both.last - both.first <= longest ? both : window;
}

/// 0 at a tenth of a millimetre, 1 at a metre, logarithmic.
float share_of(const FrameLeft& left) {
    return static_cast<float>(std::clamp((std::log10(std::max(amount(left), 1e-4)) + 4.0) / 4.0, 0.0, 1.0));
}

/// Frames that the rig can express are faint; the others go from yellow to red.
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

/// "2.35 s: the rig cannot express left 6: off by 12.3 mm, 8.1°"
std::string usage_text(const RigPart& part, std::uint64_t tick) {
    std::string text = fixed_text(static_cast<double>(tick) * tick_seconds, 2) + " s";
    if (tick < part.take.began)
        text +=
            ", before the take, which began when the rig was last edited: only the last ten seconds before "
            "it are kept";
    if (!part.clip || tick < part.clip->began || tick - part.clip->began >= part.clip->frames()) return text;
    const std::size_t frame = tick - part.clip->began;
    text += "\nClip, frame " + std::to_string(frame) + ": ";
    if (!part.clip_left || frame >= part.clip_left->done()) return text + "not solved backward yet";
    const FrameLeft& left = part.clip_left->left[frame];
    if (left.expressed()) return text + "the rig can express it";
    return text + "the rig cannot express " + part.clip->bones[left.bone] + ": off by " +
           left_text(static_cast<double>(left.mm), static_cast<double>(left.degrees),
                     static_cast<double>(left.scale)) +
           (left.stopped ? ", stopped before the end" : "");
}

/// Incidents within the window, by tick of the take. `numbers`: their indices among all incidents.
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

/// Goes to the previous or next tick of the take.
void step_button(const RigPart& part, bool back, Emit& emit) {
    const bool possible = back ? part.take.tick > 0 : part.take.tick < max_take_ticks;
    if (icon_button(back ? "back" : "forward", back ? Icon::ChevronLeft : Icon::ChevronRight,
                    back ? "Pauses and goes back one tick" : "Pauses and goes forward one tick", possible))
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
        tooltip(usage_text(part, window.first + static_cast<std::uint64_t>(use.hovered)));
}

}  // namespace

float RigLab::timeline_height(const Workspace& workspace) const {
    if (rig_part(workspace).state->controls.empty()) return 0.0f;
    return Lab::timeline_height(workspace);
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
    past_plot(workspace, rig_past(), past_line, emit);
}

}  // namespace tendril::app
