// FABRIK: one iteration is forward reaching (from the tip), then backward reaching (from the root). The
// accelerated one adds a step that fits the span from root to tip (accelerate.hpp). Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

template <class Watch>
void fabrik_iteration(Problem& problem, Watch watch) noexcept;

template <class Watch>
void accelerated_fabrik_iteration(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
