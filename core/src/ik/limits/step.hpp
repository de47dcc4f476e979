// One damped least-squares step within limits. Not installed.
//
// Active-set projection: a step that would push a joint out of its limit is taken along the limit instead
// (a hinge's angle stays, a cone's swing slides along the rim), and the rest is solved anew without it; after
// Baerlocher and Boulic, "An inverse kinematics architecture enforcing an arbitrary number of strict priority
// levels", The Visual Computer 20(6), 2004. What is still over after the step is clamped, so the trial pose
// is always within.
#pragma once

#include <algorithm>

#include "ik/limits/freedom.hpp"
#include "ik/limits/pose.hpp"

namespace tendril::ik::detail {

enum class Descent {
    Damped,    ///< J' (J J' + damping)^-1 e
    Filtered,  ///< the same, but only where J J' has small eigenvalues
    Transpose  ///< along J' e, as far as is best
};

/// From scratch.pose to scratch.trial. `damping` in reach squared.
void limited_step(Problem& problem, Descent descent, float damping) noexcept;

/// The step, solved anew until it takes no joint out of its limit.
Wanted projected_step(Problem& problem, Descent descent, float damping, const Wanted& wanted,
                      Normal& normal) noexcept;
/// Turns every joint by it, but none by more than a radian (further the matrix says nothing), into
/// scratch.trial.
void rotate_joints(Problem& problem, const Wanted& by) noexcept;

}  // namespace tendril::ik::detail
