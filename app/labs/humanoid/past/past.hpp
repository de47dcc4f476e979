// The Humanoid lab's last ten seconds: plots, lines and incidents.
#pragma once

#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/kit/past_view.hpp"

namespace tendril::app {

PastView humanoid_past();
/// Plots the active node, or the left elbow; or the active effector, or the one farthest from its target.
/// Empty while nothing is plotted.
std::optional<PastCurve> humanoid_past_curve(const Workspace& workspace);
/// Frees the cached poses once nothing of the past is on display.
void forget_past_poses(const Workspace& workspace);
/// A line for each bone of the body, as displayed at that moment.
PoseLines humanoid_lines(const Workspace& workspace, const SharedPart& part);
/// Draws the body before the incident on display, over the current one.
void draw_humanoid_incident(const View& view, const ShownPose& shown, DrawList& list);

}  // namespace tendril::app
