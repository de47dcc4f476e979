// What the Rope lab shows of its last ten seconds.
#pragma once

#include "app/labs/kit/past_view.hpp"

namespace tendril::app {

/// Past poses are those of the same particles: from before a cut or a tear too, not of another scene.
PastView rope_past();
/// Of the selected particles or their body, or of all ropes. Nothing while nothing is plotted.
std::optional<PastCurve> rope_past_curve(const Workspace& workspace);
/// Ropes and strands from end to end, a cloth by five of its rows and five of its columns; some hundred lines
/// at most, each over as many links as that takes.
PoseLines rope_lines(const SharedPart& part);

}  // namespace tendril::app
