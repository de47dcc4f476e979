// Other poses to go on from, where a descent within limits has stalled. Not installed.
//
// - Bent a little: where no angle that a joint has brings the tip nearer to first order, as in a chain that
//   lies straight on a line with its target, methods that follow the Jacobian would stay for ever. Such a
//   chain is bent, always in the same way, to a side to which its joints may bend.
// - Sampled: a random pose within the limits, the same ones for the same chain (multistart). Measured: starts
//   near the best pose so far, the best of several samples, and taking only what is clearly nearer gain
//   nothing (99.97 percent arrive with all of them, 99.99 without).
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Whether the pose is singular towards what is asked: J' e is nothing, before any limit has been counted
/// against it. O(n).
bool is_singular(Problem& problem) noexcept;

/// Bends the chain into an arc, as bend_collinear_chain does: the best of four ways, of which the first is
/// towards the pole if there is one. A joint that has no freedom to one side turns to another; one that has
/// none stays. No joint leaves its limit.
template <class Watch>
void bend_within_limits(Problem& problem, Watch watch) noexcept;

/// A random pose within the limits into scratch.trial; the same for the same number.
void sample(const Problem& problem, int number) noexcept;

}  // namespace tendril::ik::detail
