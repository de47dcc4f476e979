// The Humanoid lab's last ten seconds: plots, lines and incidents.
#pragma once

#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/kit/past.hpp"

namespace tendril::app {

/// Frees the cached poses once nothing of the past is on display.
void forget_past_poses(const Workspace& workspace);
/// Draws the body before the incident on display, over the current one.
void draw_humanoid_incident(const View& view, const ShownPose& shown, DrawList& list);

}  // namespace tendril::app
