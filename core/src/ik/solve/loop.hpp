// A solve from start to end: reachability, preparations, the iterations, the pole, the report. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/report.hpp"

namespace tendril::ik::detail {

/// All input has been checked. Moves the joints, updates the state, and says how it ended. Takes
/// options.weight for 1.
template <class Watch>
Report run(Method method, Problem& problem, Watch watch) noexcept;

/// The same with options.weight.
template <class Watch>
Report run_weighted(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
