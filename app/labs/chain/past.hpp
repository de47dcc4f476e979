// What the Chain lab shows of its last ten seconds.
#pragma once

#include <vector>

#include "app/document/incident.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/past_view.hpp"

namespace tendril::app {

PastView chain_past();
/// Of the selected joint, or of the one after the root: an arm's elbow. Nothing while nothing is plotted.
std::optional<PastCurve> chain_past_curve(const Workspace& workspace);
/// A line for each bone; of a long chain none.
PoseLines chain_lines(const SharedPart& part);

// What a move of the target did to a chain that reaches: joints that jumped, and why.

/// Of two states of a chain, one solve apart: a flip, or what else its report has to say. A flip is counted
/// where only target or pole target moved, a bone turned by more than the rule allows, and the target moved
/// little (FlipRule). Nothing outside Reach, and nothing while a solve is analysed, which begins elsewhere.
///
/// The joint is that end of the bone that turned the furthest which moved further: of an arm, the elbow.
std::vector<Incident> chain_incidents(const ChainPart& before, const ChainPart& after);

}  // namespace tendril::app
