// The strip of the last ten seconds below the scene, with a mark for all that happened in them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "app/document/workspace.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"
#include "app/widgets/timeline.hpp"

namespace tendril::app {

/// The moments that are remembered, and the present: all that is shown of the past begins at the first.
struct PastTicks {
    std::uint64_t first = 0, last = 0;

    /// From the first on.
    int place(std::uint64_t tick) const { return static_cast<int>(std::clamp(tick, first, last) - first); }
};
PastTicks past_ticks(const Workspace& workspace);
/// As long as the strip is, whatever is remembered.
inline constexpr int past_strip_ticks = static_cast<int>(Rewind::max_ticks) + 1;
/// Goes to the moment at a place: for the last item, while it is dragged.
void go_to_past(const Workspace& workspace, int place, Emit& emit);

/// Where its line runs, pixels of the window.
struct StripLine {
    float left = 0.0f, right = 0.0f;
};
/// With the buttons before it.
StripLine past_strip(const Workspace& workspace, Emit& emit);

// What that is put together from, for a lab that has another strip beside it.

/// Makes a video of them, which shows nothing but the view of the scene: for a lab that has no more to show.
/// Small and below the replay button, where the strip keeps its length.
void record_button(const Workspace& workspace, Emit& emit);
/// Plays what is remembered again, or stops it.
void replay_button(const Workspace& workspace, Emit& emit);
/// Where there is another strip: shows this one or, while this is the one that is `shown`, the other, of the
/// `other` ("clip"). True in a frame in which a person asked for that.
bool other_strip_button(bool shown, const std::string& other);
/// Without any button.
StripLine past_time_strip(const Workspace& workspace, Emit& emit);
/// At tick `at` of another strip: the mark of an incident.
TimeMark incident_mark(const Incident& incident, int at, const Palette& palette);
/// While the mouse is on that mark.
void tell_incident(const Incident& incident);

/// "Joint 2 flipped: a bone at it turned 128 degrees in one tick"
std::string incident_title(const Incident& incident);
glm::vec3 incident_colour(const Incident& incident, const Palette& palette);

}  // namespace tendril::app
