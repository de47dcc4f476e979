// What the Rig lab shows of its last ten seconds.
#pragma once

#include <vector>

#include "app/document/incident.hpp"
#include "app/labs/kit/past_view.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

PastView rig_past();
/// Of the active element, or of the first bone below another one: an elbow. Nothing while nothing is plotted.
std::optional<PastCurve> rig_past_curve(const Workspace& workspace);
/// A line for each end of a bone.
PoseLines rig_lines(const SharedPart& part);

// What a person may ask about that came of a tick or a change: bones that flipped, units that report
// something, controls at their limits.

/// Of two states of one rig, as the Rig lab reviews them. Flips, of each unit's the bone that turned the
/// furthest, are counted between two solves, where nothing but controls was set in between.
std::vector<Incident> rig_incidents(const RigPart& before, const RigPart& after);

}  // namespace tendril::app
