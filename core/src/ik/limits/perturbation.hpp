// The collinear singularity within limits: where no angle that a joint has brings the tip nearer to first
// order, as in a chain that lies straight on a line with its target, the methods that follow the Jacobian
// would stay for ever. Such a chain is bent a little, always in the same way, to a side to which its joints
// may bend. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Whether the pose is singular towards what is asked: J' e is nothing, before any limit has been counted
/// against it. O(n).
bool is_singular(Problem& problem) noexcept;

/// Turns every joint a little: the first time (`number` 0) into an arc as bend_collinear_chain does, then
/// each in its own way, another one for each `number`; the best of four, where the arc's first is towards the
/// pole if there is one. A joint that has no freedom to one side turns to another; one that has none stays.
/// No joint leaves its limit.
template <class Watch>
void perturb_within_limits(Problem& problem, int number, Watch watch) noexcept;

}  // namespace tendril::ik::detail
