// The strip below the scene: the clip, with what plays and steps it, or the last ten seconds.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/labs/humanoid/past/past.hpp"
#include "app/labs/kit/past_strip.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/timeline.hpp"

namespace tendril::app {
namespace {

/// Seconds since the clip began its first round.
double since_begin(const Playback& playback, double duration, double time) {
    return static_cast<double>(playback.rounds) * duration + time;
}

void step(const HumanoidPanel& panel, int ticks) {
    const Playback& playback = panel.part.playback;
    const double duration = panel.part.clip()->duration;
    const double now = since_begin(playback, duration, playback.time),
                 to = std::max(0.0, now + ticks * tick_seconds);
    panel.emit("humanoid.clip", {{"time", playback.loop ? to : std::min(to, duration)}, {"play", false}});
}

void buttons(const HumanoidPanel& panel) {
    const bool plays = panel.part.playback.playing && panel.workspace.clock.playing;
    if (icon_button("back", Icon::ChevronLeft, "Back by a frame")) step(panel, -1);
    ImGui::SameLine();
    if (icon_button("play", plays ? Icon::Pause : Icon::Play, plays ? "Pauses the clip" : "Plays the clip")) {
        panel.emit("humanoid.clip", {{"play", !plays}});
        if (!plays && !panel.workspace.clock.playing) panel.emit("time.play");
    }
    ImGui::SameLine();
    if (icon_button("forward", Icon::ChevronRight, "On by a frame")) step(panel, 1);
    ImGui::SameLine();
}

/// Where the lint has found something: low while it lasts, high where it is worst.
std::vector<TimeBar> lint_marks(const HumanoidPanel& panel, int ticks) {
    const humanoid::LintReport* const report = panel.runtime.lint.report(panel.part);
    if (!report || report->findings.empty()) return {};
    std::vector<TimeBar> bars(static_cast<std::size_t>(ticks) + 1);
    const auto tick_of = [&](std::size_t frame) {
        const double tick = static_cast<double>(frame) / report->rate / tick_seconds;
        return static_cast<std::size_t>(std::clamp(std::lround(tick), 0l, static_cast<long>(ticks)));
    };
    const auto mark = [&](std::size_t tick, float height) {
        bars[tick] = {panel.colours.limit, std::max(bars[tick].height, height)};
    };
    for (const humanoid::Finding& each : report->findings) {
        // What lasts for the whole clip says nothing about a moment of it.
        const bool whole = each.first == 0 && each.last + 1 >= report->frames;
        for (std::size_t i = tick_of(each.first); !whole && i <= tick_of(each.last); ++i) mark(i, 0.35f);
        mark(tick_of(each.frame), 1.0f);
    }
    return bars;
}

void clip_strip(const HumanoidPanel& panel) {
    const Playback& playback = panel.part.playback;
    const double duration = panel.part.clip()->duration;
    const int ticks = std::max(1, static_cast<int>(std::ceil(duration / tick_seconds - 1e-6)));
    int tick = std::clamp(static_cast<int>(std::lround(playback.time / tick_seconds)), 0, ticks);
    const TimeStrip strip{
        .ticks = ticks, .seconds = tick_seconds, .known = ticks, .bars = lint_marks(panel, ticks)};
    const TimeStripUse use = time_strip("clip", tick, strip);
    if (use.hovered >= 0 && !ImGui::IsItemActive())
        tell_strip("The clip. Drag shows it at that time; the marks are what Motion lint has found.");
    if (use.moved) {
        const double time = std::min(tick * tick_seconds, duration);
        panel.emit.continuously("humanoid.clip",
                                {{"time", since_begin(playback, duration, time)}, {"play", false}});
    }
}

/// Where the strip is that of the last ten seconds, its line.
std::optional<StripLine> strip(const HumanoidPanel& panel) {
    if (panel.part.clip() == nullptr) return past_strip(panel.workspace, panel.emit);
    bool& past = panel.runtime.panel.past;
    buttons(panel);
    if (other_strip_button(past, "clip")) past = !past;
    if (past) return past_strip(panel.workspace, panel.emit);
    clip_strip(panel);
    return std::nullopt;
}

}  // namespace

float HumanoidLab::timeline_height(const Workspace& workspace) const {
    return strip_height + past_plot_height(workspace.settings, humanoid_past());
}

void HumanoidLab::timeline(const Workspace& workspace, Emit& emit) const {
    const std::optional<StripLine> past = strip(humanoid_panel(workspace, emit));
    past_plot(workspace, humanoid_past(), humanoid_past_curve(workspace), past, emit);
    forget_past_poses(workspace);
}

}  // namespace tendril::app
