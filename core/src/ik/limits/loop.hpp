// A solve with joint limits, by any method. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/report.hpp"

namespace tendril::ik::detail {

/// Requires one valid limit per bone in options.limits. Moves the joints and the state's rotations.
/// Afterwards every joint is within its limit, and the tip no further from the target than at the start.
template <class Watch>
Report run_limited(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
