// A time strip with a draggable head.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace tendril::app {

/// The steps of a solve: `ends[i]` is the last step of iteration i; `ends[0]` is the last step before the
/// first iteration. `step` is 0 to ends.back(). True in a frame in which the user moved the head.
bool step_timeline(const char* id, int& step, const std::vector<int>& ends);

/// A bar for one tick of a strip: its colour, and its height, 0 to 1.
struct TimeBar {
    glm::vec3 colour{0.5f};
    float height = 0.0f;
};
/// An event on a strip.
struct TimeMark {
    int at = 0;  ///< ticks from the left end
    glm::vec3 colour{0.5f};
    bool large = false;  ///< important
};
/// A stretch of time with bars and marks. All positions are in ticks from the left end.
struct TimeStrip {
    int ticks = 1;
    double seconds = 0.0;        ///< seconds per tick
    double first_seconds = 0.0;  ///< time at the left end
    int start = 0;               ///< the head's minimum
    int known = 0;               ///< end of the recorded time
    int bars_from = 0;
    std::vector<TimeBar> bars;  ///< one per tick, from bars_from
    std::vector<TimeMark> marks{};
};
struct TimeStripUse {
    bool moved = false;               ///< the user moved the head in this frame
    int hovered = -1;                 ///< the tick under the mouse; -1 if none
    int on_mark = -1;                 ///< the mark under the mouse, large ones preferred; -1 if none
    bool mark_clicked = false;        ///< in this frame; the head does not move
    float left = 0.0f, right = 0.0f;  ///< ends of its line, in window pixels
};
TimeStripUse time_strip(const char* id, int& tick, const TimeStrip& strip);

}  // namespace tendril::app
