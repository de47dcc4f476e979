// One damped least-squares step within limits. Not installed.
//
// Each joint is a ball joint that turns about any axis in the world, less the axes that its limit forbids:
// a hinge keeps one, a joint at a bound loses the one that leads out of the limit if the step pushes that way
// (an active limit). So no angles are needed, and a joint well inside its limit costs what a ball joint
// costs. J J' has three rows however many joints there are, or six with a tip orientation; J is never built.
//
// Active-set projection: a step that would push a joint out of its limit is taken along the limit instead
// (a hinge's angle stays, a cone's swing slides along the rim), and the rest is solved anew without it; after
// Baerlocher and Boulic, "An inverse kinematics architecture enforcing an arbitrary number of strict priority
// levels", The Visual Computer 20(6), 2004. What is still over after the step is clamped, so the trial pose
// is always within.
//
// Lengths are in reaches, so that no size of chain overflows. Everything here is O(n).
#pragma once

#include "ik/limits/workspace.hpp"
#include "ik/math.hpp"
#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// What is asked, in reaches: the tip's way to go, and with an orientation the rotation to go, scaled as
/// error_of has it. A step that the joints follow has the same form.
struct Wanted {
    glm::vec3 move{0.0f}, rotation{0.0f};
    float scale = 0.0f;  ///< reaches a radian; 0 without an orientation
};
Wanted wanted_of(const Problem& problem) noexcept;

/// Fills scratch.freedoms from the pose, and the numbers of those at a bound; no limit is active yet. Where
/// they are those of the pose already, that costs next to nothing.
Normal linearize(Problem& problem, const Wanted& wanted) noexcept;
/// As the last call left them, but that no limit is active.
Normal release_limits(LimitedScratch& scratch) noexcept;

/// Makes the bounds active that the rotations by `by` push against, and takes them out of the matrix; whether
/// there were any.
bool activate(Problem& problem, const Wanted& by, Normal& normal) noexcept;

/// How a ball joint at the place of this one turns if all follow `by`, about an axis in the world, radians.
static inline glm::vec3 free_rotation_by(const JointFreedom& freedom, const Wanted& by) noexcept {
    const glm::vec3 rotation = cross(freedom.arm, by.move);
    return by.scale == 0.0f ? rotation : plus(rotation, times(by.rotation, by.scale));
}
/// What its limit leaves a joint of a rotation.
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
/// How the joint itself does: J' by.
static inline glm::vec3 rotation_by(const JointFreedom& freedom, const Wanted& by) noexcept {
    return allowed_part(freedom, free_rotation_by(freedom, by));
}

enum class Descent {
    Damped,    ///< J' (J J' + damping)^-1 e
    Filtered,  ///< the same, but only where J J' has small eigenvalues
    Transpose  ///< along J' e, as far as is best
};

/// The step, solved anew until it takes no joint out of its limit. `damping` in reach squared.
Wanted projected_step(Problem& problem, Descent descent, float damping, const Wanted& wanted,
                      Normal& normal) noexcept;

/// By how much the error falls in a step, in reaches, if the tip moves as the matrix says.
float predicted_gain(const Normal& normal, const Wanted& wanted, const Wanted& by) noexcept;

/// Turns every joint by it, but none by more than a radian (further the matrix says nothing), from
/// scratch.pose into scratch.trial.
void rotate_joints(Problem& problem, const Wanted& by) noexcept;

/// All of that: from scratch.pose to scratch.trial.
void limited_step(Problem& problem, Descent descent, float damping) noexcept;

}  // namespace tendril::ik::detail
