// What the Chain lab shows of its last ten seconds.
#pragma once

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/past_view.hpp"

namespace tendril::app {

PastView chain_past();
/// Of the selected joint, or of the one after the root: an arm's elbow. Nothing while nothing is plotted.
std::optional<PastCurve> chain_past_curve(const Workspace& workspace);
/// A line for each bone; of a long chain none.
PoseLines chain_lines(const SharedPart& part);

}  // namespace tendril::app
