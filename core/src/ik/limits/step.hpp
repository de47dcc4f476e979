// One damped least-squares step within limits. Not installed.
//
// Active-set projection: a step that would push a joint out of its limit is taken along the limit instead
// (a hinge's angle stays, a cone's swing slides along the rim), and the rest is solved anew without it; after
// Baerlocher and Boulic, "An inverse kinematics architecture enforcing an arbitrary number of strict priority
// levels", The Visual Computer 20(6), 2004. What is still over after the step is clamped, so the trial pose
// is always within.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

enum class Descent {
    Damped,    ///< J' (J J' + damping)^-1 e
    Filtered,  ///< the same, but only where J J' has small eigenvalues
    Transpose  ///< along J' e, as far as is best
};

/// From workspace.pose to workspace.trial. `damping` in reach squared.
void limited_step(Problem& problem, Descent descent, float damping) noexcept;

inline constexpr float first_damping = 1e-3f;

/// A damped step that is only taken where it brings the tip nearer, or else one with more damping; whether
/// either did. `error` is that of the pose and stays so; `damping` falls with success and grows with failure
/// (Levenberg 1944, Marquardt 1963).
template <class Watch>
bool descend(Problem& problem, float& damping, float& error, Watch watch) noexcept;

}  // namespace tendril::ik::detail
