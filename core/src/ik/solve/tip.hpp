// Tip orientation without limits: places the last bone as requested and solves the rest of the chain for the
// start of that bone, by any method. With limits the last joint is limited too, so ik/limits solves for
// position and orientation at once. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/report.hpp"

namespace tendril::ik::detail {

/// Requires options.tip_orientation and no limits. Reports the status of the chain without its last bone, and
/// the tip's residual. Here a two-bone solver takes three bones, or two, of which one is left to solve.
template <class Watch>
Report run_with_tip_orientation(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
