// Euler angles in the order XYZ, as in Maya and Blender: first about X, then Y, then Z, about the fixed axes
// of the surrounding space (rotation = Rz * Ry * Rx). Radians.
//
// Method: E. Bernardes and S. Viollet, "Quaternion to Euler angles conversion: a direct, general and
// computationally efficient method", PLoS ONE 17(11), 2022. Sum and difference of the outer angles come from
// one arctangent each, so near the poles, where only one of the two is defined, that one is still exact.
#pragma once

#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::rig {

/// x and z in (-pi, pi], y in [-pi/2, pi/2]. If y is within 1.4e-9 of a pole, X and Z turn about the same
/// line: z is 0 and x holds the whole angle. `rotation` is unit.
glm::dvec3 to_euler(const glm::dquat& rotation) noexcept;

/// A unit quaternion. from_euler(to_euler(q)) is q or its negative to 1e-15, at the poles to 1e-9.
glm::dquat from_euler(const glm::dvec3& angles) noexcept;

}  // namespace tendril::rig
