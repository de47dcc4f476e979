// One damped least-squares step within limits. Not installed.
//
// Each joint is a ball joint that rotates about any axis in the world, except those that its limit forbids: a
// hinge keeps one axis; a joint at a bound loses the axis that leads out of the limit, if the step pushes
// that way (an active limit). So no angles are needed, and a joint well inside its limit costs the same as a
// ball joint. Stiff joints are weighted: with W the diagonal of mobilities, a step is
// W J' (J W J' + damping)^-1 e, which minimises the sum of rotation^2 / mobility (D. Whitney, "Resolved
// motion rate control of manipulators and human prostheses", IEEE Trans. Man-Machine Systems 10(2), 1969). J
// W J' has three rows for any number of joints, or six with a tip orientation; J is never built.
//
// Active-set projection: a step that would push a joint out of its limit is projected onto the limit (a
// hinge's angle is fixed, a cone's swing slides along the rim), and the rest is solved again without it;
// after Baerlocher and Boulic, "An inverse kinematics architecture enforcing an arbitrary number of strict
// priority levels", The Visual Computer 20(6), 2004. Any excess left after the step is clamped, so the trial
// pose is always within the limits.
//
// Lengths are in units of the reach, so that no size of chain overflows. Everything here is O(n).
#pragma once

#include "ik/limits/workspace.hpp"
#include "ik/math.hpp"
#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// The requested change, in reaches: the tip's displacement and, with a tip orientation, its rotation, scaled
/// as in error_of. The solution of a step has the same form.
struct TipDelta {
    glm::vec3 move{0.0f}, rotation{0.0f};
    float scale = 0.0f;  ///< reaches per radian; 0 without an orientation
};
TipDelta requested_delta(const Problem& problem) noexcept;

/// Fills scratch.freedoms and the list of joints at a bound from the pose; no limit is active yet. Almost
/// free if they are up to date.
Normal linearize(Problem& problem, const TipDelta& wanted) noexcept;
/// Makes all limits inactive again, after linearize.
Normal release_limits(LimitedScratch& scratch) noexcept;

/// Activates the bounds that the rotations by `by` push against, and removes them from the matrix. Returns
/// whether there were any.
bool activate(Problem& problem, const TipDelta& by, Normal& normal) noexcept;

/// Rotation vector, in the world, of an unlimited ball joint in this step; radians.
static inline glm::vec3 free_rotation_by(const JointFreedom& freedom, const TipDelta& by) noexcept {
    const glm::vec3 rotation = cross(freedom.arm, by.move);
    return by.scale == 0.0f || !freedom.turns_tip ? rotation : plus(rotation, times(by.rotation, by.scale));
}
/// The part of a rotation that the limit allows.
static inline glm::vec3 allowed_part(const JointFreedom& freedom, const glm::vec3& whole) noexcept {
    if (freedom.ball && freedom.count == 0) return whole;
    if (freedom.ball && freedom.count == 3) return glm::vec3(0.0f);
    glm::vec3 some{0.0f};
    for (int i = 0; i < freedom.count; ++i) {
        const glm::vec3& axis = freedom.axes[static_cast<std::size_t>(i)];
        some = plus(some, times(axis, dot(axis, whole)));
    }
    return freedom.ball ? minus(whole, some) : some;
}
/// The joint's rotation in this step: W J' by, with W the joints' mobilities.
static inline glm::vec3 rotation_by(const JointFreedom& freedom, const TipDelta& by) noexcept {
    return times(allowed_part(freedom, free_rotation_by(freedom, by)), freedom.mobility);
}

enum class Descent {
    Damped,    ///< W J' (J W J' + damping)^-1 e
    Filtered,  ///< damped only where J W J' has small eigenvalues
    Transpose  ///< optimal step along W J' e
};

/// Solves repeatedly until the step takes no joint out of its limit. `damping` is in reach squared.
TipDelta projected_step(Problem& problem, Descent descent, float damping, const TipDelta& wanted,
                        Normal& normal) noexcept;

/// Decrease of the error in a step, in reaches, according to the linear model.
float predicted_gain(const Normal& normal, const TipDelta& wanted, const TipDelta& by) noexcept;

/// Applies the step to every joint, scaled so that none rotates by more than a radian (beyond that the linear
/// model is useless), from scratch.pose to scratch.trial.
void rotate_joints(Problem& problem, const TipDelta& by) noexcept;

/// Linearizes, solves and rotates: from scratch.pose to scratch.trial.
void limited_step(Problem& problem, Descent descent, float damping) noexcept;

}  // namespace tendril::ik::detail
