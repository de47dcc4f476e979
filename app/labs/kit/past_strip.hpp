// The strip of the last ten seconds below the scene, with a mark for each incident.
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

/// The moments that the rewind holds, and the present.
struct PastTicks {
    std::uint64_t first = 0, last = 0;

    /// The index of a tick, counted from `first`.
    int place(std::uint64_t tick) const { return static_cast<int>(std::clamp(tick, first, last) - first); }
};
PastTicks past_ticks(const Workspace& workspace);
/// The strip always has this length, however little is recorded.
inline constexpr int past_strip_ticks = static_cast<int>(Rewind::max_ticks) + 1;
/// At an earlier moment: "An edit here discards the 2.3 s after it. Undo brings them back."; else empty.
std::string discards_text(const Workspace& workspace);
/// Goes to the moment at an index. Call it after the item that the user drags.
void go_to_past(const Workspace& workspace, int place, Emit& emit);

/// The extent of the strip's line, in pixels of the window.
struct StripLine {
    float left = 0.0f, right = 0.0f;
};
/// Includes the buttons to its left.
StripLine past_strip(const Workspace& workspace, Emit& emit);

// The parts of past_strip(), for a lab that shows another strip beside it.

/// Records the last ten seconds as a video of the scene view. A small button below the replay button, so that
/// the strip keeps its length.
void record_button(const Workspace& workspace, Emit& emit);
/// Replays the last ten seconds, or stops the replay.
void replay_button(const Workspace& workspace, Emit& emit);
/// Switches between this strip (while `shown`) and the lab's other one, called `other` ("clip"). True in the
/// frame of the click.
bool other_strip_button(bool shown, const std::string& other);
/// The strip without buttons.
StripLine past_time_strip(const Workspace& workspace, Emit& emit);
/// The mark of an incident at tick `at` of another strip.
TimeMark incident_mark(const Incident& incident, int at, const Palette& palette);
/// Shows the tooltip while the mouse is on that mark.
void tell_incident(const Incident& incident);

/// "Joint 2 flipped: a bone at it turned 128 degrees in one tick"
std::string incident_title(const Incident& incident);
glm::vec3 incident_colour(const Incident& incident, const Palette& palette);

}  // namespace tendril::app
