// FABRIK: one iteration is a pull from the tip, then one from the root. The accelerated one adds a step that
// fits the span from root to tip (spread.hpp). Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

template <class Watch>
void fabrik_iteration(Problem& problem, Watch watch) noexcept;

template <class Watch>
void fast_fabrik_iteration(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
