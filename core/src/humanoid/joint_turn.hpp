// Rotations of one joint: rotation vectors, a hinge's angle, the limit. Not installed.
#pragma once

#include "humanoid/body_work.hpp"

namespace tendril::humanoid::detail {

/// From a rotation vector to a quaternion and back; logarithm() takes the short way.
glm::dquat exponential(const glm::dvec3& turn) noexcept;
glm::dvec3 logarithm(const glm::dquat& q) noexcept;

glm::quat narrow(const glm::dquat& q) noexcept;

/// The angle of a hinge: the twist of `turn` about its axis, radians.
double hinge_angle(const glm::dvec3& axis, const glm::dquat& turn) noexcept;

/// Clamps the link's turn to its limit; true if it was beyond. A hinge keeps its turn about other axes.
bool clamp_turn(Link& link) noexcept;
/// Widens the limit to contain the clip's pose.
void widen(Link& link) noexcept;

}  // namespace tendril::humanoid::detail
