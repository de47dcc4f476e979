// What the Humanoid lab shows of its last ten seconds.
#pragma once

#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/kit/past_view.hpp"

namespace tendril::app {

PastView humanoid_past();
/// Of the active node, or of the left elbow; of the active effector, or of the one that is farthest from its
/// target. Nothing while nothing is plotted.
std::optional<PastCurve> humanoid_past_curve(const Workspace& workspace);
/// Once nothing of the past is shown any more.
void forget_past_poses(const Workspace& workspace);
/// A line for each bone of the body, as it was shown then.
PoseLines humanoid_lines(const Workspace& workspace, const SharedPart& part);
/// The body as it was before the incident that is shown, over what came of it.
void draw_humanoid_incident(const View& view, const ShownPose& shown, DrawList& list);

}  // namespace tendril::app
