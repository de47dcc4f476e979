// Euler angles in the order XYZ, as Maya and Blender have it: first about X, then about Y, then about Z, all
// three axes those of the space around (rotation = Rz * Ry * Rx). Radians.
//
// Method: E. Bernardes and S. Viollet, "Quaternion to Euler angles conversion: a direct, general and
// computationally efficient method", PLoS ONE 17(11), 2022: sum and difference of the outer angles come out
// of one arctangent each, so that near the poles, where only one of the two means anything, that one is still
// exact.
#pragma once

#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rig {

/// x and z in (-pi, pi], y in [-pi/2, pi/2]. Where y is within 1.4e-9 of a pole, X and Z turn about the same
/// line: z is 0 there and x is all of it. `rotation` is unit.
glm::dvec3 to_euler(const glm::dquat& rotation) noexcept;

/// Unit. from_euler(to_euler(q)) is q or its negative to 1e-15, at the poles to 1e-9.
glm::dquat from_euler(const glm::dvec3& angles) noexcept;

}  // namespace tendril::rig
