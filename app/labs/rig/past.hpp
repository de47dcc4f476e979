// The Rig lab's last ten seconds: plots, lines and incidents.
#pragma once

#include <vector>

#include "app/document/incident.hpp"
#include "app/labs/kit/past_view.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

PastView rig_past();
/// Plots the active element, or if none is selected the first bone whose parent is a bone, such as an elbow.
/// Empty while nothing is plotted.
std::optional<PastCurve> rig_past_curve(const Workspace& workspace);
/// A line to each end of a bone.
PoseLines rig_lines(const SharedPart& part);

// Incidents that a user may ask about after a tick or change: flips, unit warnings, controls at their limits.

/// `before` and `after` are consecutive states of one rig. Flips are reported only between two solves with
/// nothing but controls set in between, and only the bone that rotated furthest for each unit.
std::vector<Incident> rig_incidents(const RigPart& before, const RigPart& after);

}  // namespace tendril::app
