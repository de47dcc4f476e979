// Other start poses, for when a descent within limits has stalled. Not installed.
//
// - Bent: if no joint rotation brings the tip nearer to first order, as in a straight chain collinear with
//   its target, methods that follow the Jacobian never leave it. Such a chain is bent, deterministically, to
//   a side that its joints allow.
// - Sampled: a random pose within the limits, the same sequence for the same chain (multistart). Measured
//   alternatives gain nothing: starts near the best pose, the best of several samples, and accepting only
//   clear improvements (99.97 percent arrive with all of them, 99.99 without).
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// True if the pose is singular for this request: J' e is almost zero, before any limit is active. O(n).
bool is_singular(Problem& problem) noexcept;

/// Bends the chain into an arc, as bend_collinear_chain does: the best of four ways, the first of which is
/// towards the pole, if any. A hinge bends about its own axis, and a joint without range stays. No joint
/// leaves its limit.
template <class Watch>
void bend_within_limits(Problem& problem, Watch watch) noexcept;

/// Writes a random pose within the limits to scratch.trial; deterministic in `number`.
void sample(const Problem& problem, int number) noexcept;

}  // namespace tendril::ik::detail
