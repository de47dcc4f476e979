// FABRIK: one iteration is a pull from the tip, then one from the root. Not installed.
#pragma once

#include "ik/problem.hpp"

namespace tendril::ik::detail {

template <class Watch>
void fabrik_iteration(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
