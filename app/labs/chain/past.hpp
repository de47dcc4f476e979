// The Chain lab's last ten seconds: plots, past poses and incidents.
#pragma once

#include <vector>

#include "app/document/incident.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/past_view.hpp"

namespace tendril::app {

PastView chain_past();
/// The curve of the selected joint, or of joint 1: an arm's elbow. Nothing if nothing is plotted.
std::optional<PastCurve> chain_past_curve(const Workspace& workspace);
/// One line for each bone; none for long chains.
PoseLines chain_lines(const SharedPart& part);

/// The incidents between two states of a chain, one solve apart. A flip: only the target or pole target
/// moved, and little (FlipRule), but a bone turned by more than the rule allows. Also changes in the solver's
/// report. Nothing outside mode Reach, and nothing while a study is open, since its solves start elsewhere.
///
/// A flip's joint is an end of the bone that turned the furthest, whichever moved further: an arm's elbow.
std::vector<Incident> chain_incidents(const ChainPart& before, const ChainPart& after);

}  // namespace tendril::app
