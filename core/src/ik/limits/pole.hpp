// Facing the pole within limits: the whole chain turns about the line from root to tip, as pole.hpp has it,
// but only as far as the root's joint lets it; the other joints are not bent by that. PoleTurn::EachJoint
// would bend them all, so with limits it means the same. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Before the first iteration: how far the chain may turn in this solve.
void set_pole_allowance(Problem& problem) noexcept;

/// After the last. The tip stays, to rounding.
template <class Watch>
void face_pole_within_limits(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
