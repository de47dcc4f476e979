// A solve from start to end: reachability, preparations, the iterations, the pole, the report. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/solver.hpp"

namespace tendril::ik::detail {

/// All input has been checked. Moves the joints and says how it ended.
template <class Watch>
Report run(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
