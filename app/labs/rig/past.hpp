// What the Rig lab shows of its last ten seconds.
#pragma once

#include "app/labs/kit/past_view.hpp"

namespace tendril::app {

PastView rig_past();
/// Of the active element, or of the first bone below another one: an elbow. Nothing while nothing is plotted.
std::optional<PastCurve> rig_past_curve(const Workspace& workspace);
/// A line for each end of a bone.
PoseLines rig_lines(const SharedPart& part);

}  // namespace tendril::app
