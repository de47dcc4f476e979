// The methods other than the default within limits: each elementary step is followed by bringing what it
// moved within the limits. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/solver.hpp"

namespace tendril::ik::detail {

template <class Watch>
void limited_iteration(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
