// The Rope lab's last ten seconds: plots and past poses.
#pragma once

#include "app/labs/kit/past_view.hpp"

namespace tendril::app {

/// Shows past poses of the same particles only: also from before a cut or a tear, but not of another scene.
PastView rope_past();
/// Plots the selected particles or their body, or else all ropes. Empty while nothing is plotted.
std::optional<PastCurve> rope_past_curve(const Workspace& workspace);
/// Ropes and strands from end to end, and a cloth by five of its rows and columns. At most a few hundred
/// lines, each over several links if necessary.
PoseLines rope_lines(const SharedPart& part);

}  // namespace tendril::app
