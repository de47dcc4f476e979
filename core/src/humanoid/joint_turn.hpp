// The turns of one joint: rotation vectors, a hinge's angle, the limit. Not installed.
#pragma once

#include "humanoid/body_work.hpp"

namespace tendril::humanoid::detail {

/// The rotation of a rotation vector, and the other way round, the short way.
glm::dquat exponential(const glm::dvec3& turn) noexcept;
glm::dvec3 logarithm(const glm::dquat& q) noexcept;

glm::quat narrow(const glm::dquat& q) noexcept;

/// The angle of a hinge: of the part of `turn` that is about its axis.
double hinge_angle(const glm::dvec3& axis, const glm::dquat& turn) noexcept;

/// A joint's turn brought within its limit, and whether it was not; what a hinge turns otherwise stays.
bool clamp_turn(Link& link) noexcept;
/// Makes the limit reach as far as the clip does.
void widen(Link& link) noexcept;

}  // namespace tendril::humanoid::detail
