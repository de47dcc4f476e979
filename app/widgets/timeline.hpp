// A strip of time with a head that can be dragged.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace tendril::app {

/// The steps of a solve: `ends[i]` is the last step of iteration i (of what comes before the first for i =
/// 0). `step` is 0 to the last of them. True in a frame in which a person moved the head.
bool step_timeline(const char* id, int& step, const std::vector<int>& ends);

/// What one frame on a strip has to say: a bar so high (0 to 1), in a colour.
struct TimeBar {
    glm::vec3 colour{0.5f};
    float height = 0.0f;
};
/// Something that happened, at a place on a strip.
struct TimeMark {
    int at = 0;  ///< ticks from the left end
    glm::vec3 colour{0.5f};
    bool large = false;  ///< what one looks for
};
/// A stretch of time, with bars on it. All places are in ticks from the left end.
struct TimeStrip {
    int ticks = 1;
    double seconds = 0.0;        ///< of one tick
    double first_seconds = 0.0;  ///< at the left end
    int start = 0;               ///< before it the head does not go
    int known = 0;               ///< up to there there is something to see
    int bars_from = 0;
    std::vector<TimeBar> bars;  ///< one a tick
    std::vector<TimeMark> marks{};
};
struct TimeStripUse {
    bool moved = false;  ///< in this frame a person moved the head
    int hovered = -1;    ///< the tick that the mouse is on; -1 where it is not
    int on_mark = -1;    ///< the mark that the mouse is on, a large one before others; -1 where it is on none
    bool mark_clicked = false;        ///< in this frame; the head stays where it is
    float left = 0.0f, right = 0.0f;  ///< where its line runs, pixels of the window
};
TimeStripUse time_strip(const char* id, int& tick, const TimeStrip& strip);

/// A tooltip above the strip that was written last, which it would hide below the mouse.
void tell_strip(const char* text);

}  // namespace tendril::app
