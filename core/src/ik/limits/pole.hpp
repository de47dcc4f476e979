// Facing the pole within limits: the whole chain turns about the line from root to tip, as in pole.hpp, but
// only as far as the root's joint allows; the other joints do not bend. PoleTurn::EachJoint would bend them
// all, so with limits it is the same as WholeChain. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// After the last iteration: turns the chain. The tip stays, to rounding.
template <class Watch>
void face_pole_within_limits(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
