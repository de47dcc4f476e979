// FABRIK's two passes within limits, after Aristidou, Chrysanthou and Lasenby (2016): wherever a bone is
// placed, the rotation between it and the bone that was placed before it is clamped to the limit of their
// joint, so forward reaching hands on to the root how the bones must be twisted. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Forward and backward reaching, from scratch.pose to scratch.trial. Every joint of that is within its
/// limit.
template <class Watch>
void limited_reaching(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
