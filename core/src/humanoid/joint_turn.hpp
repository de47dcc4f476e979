// Rotations of one joint: rotation vectors, a hinge's angle, the limit, and the part of a step that it
// allows. Not installed.
#pragma once

#include "humanoid/body_work.hpp"
#include "math/rotation.hpp"

namespace tendril::humanoid::detail {

/// Converts a rotation vector to a quaternion. logarithm() does the reverse, by the short way.
glm::dquat exponential(const glm::dvec3& turn) noexcept;
glm::dvec3 logarithm(const glm::dquat& q) noexcept;

using math::narrow;

/// The angle of a hinge: the twist of `turn` about its axis, radians.
double hinge_angle(const glm::dvec3& axis, const glm::dquat& turn) noexcept;

/// Clamps the link's turn to its limit. True if it was beyond the limit by more than `slack`, radians (for a
/// hinge: at all). A hinge keeps its turn about other axes.
bool clamp_turn(Link& link, float slack = ik::detail::at_bound) noexcept;
/// Widens the limit to contain the clip's pose.
void widen(Link& link) noexcept;

/// The part of a joint's turn in one step that its limit allows. Vectors are in the character's space.
struct TurnFreedom {
    glm::dvec3 hinge{0.0};  ///< axis, if the joint is a hinge
    int blocked = 0;
    std::array<glm::dvec3, 3> outward{};  ///< orthonormal directions that the limit blocks

    /// Starts a new step with nothing blocked. `before` is the rotation of the parent link.
    void begin(const Link& link, const glm::dquat& before) noexcept;
    /// The part of a turn that the joint can make: about its hinge if it has one, in no blocked direction.
    glm::dvec3 allowed(const Link& link, const glm::dvec3& turn) const noexcept;
    /// False if nothing changed.
    bool block(const glm::dvec3& direction) noexcept;
    /// Blocks the directions in which `step` would take the link from `turn` out of its limit. False if
    /// nothing changed.
    bool block_limit(const Link& link, const glm::dquat& turn, const glm::dquat& before,
                     const glm::dvec3& step) noexcept;
};

}  // namespace tendril::humanoid::detail
