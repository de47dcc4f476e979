// A solve from start to end: reachability, preparation, iterations, pole, report. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/report.hpp"

namespace tendril::ik::detail {

/// Solves a validated problem: moves the joints, updates the state and reports. Ignores options.weight.
template <class Watch>
Report run(Method method, Problem& problem, Watch watch) noexcept;

/// The same, with options.weight.
template <class Watch>
Report run_weighted(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
