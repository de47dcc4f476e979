// GLM's rotations, and the memory layout that the library's binary assumes; see vec3.hpp.
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>

namespace tendril {

static_assert(sizeof(glm::quat) == 4 * sizeof(float) && alignof(glm::quat) == alignof(float) &&
                  sizeof(glm::dquat) == 4 * sizeof(double) && alignof(glm::dquat) == alignof(double),
              "tendril: GLM's quaternions must be packed (no GLM_FORCE_DEFAULT_ALIGNED_GENTYPES)");
static_assert(offsetof(glm::quat, x) == 0 && offsetof(glm::quat, w) == 3 * sizeof(float) &&
                  offsetof(glm::dquat, x) == 0 && offsetof(glm::dquat, w) == 3 * sizeof(double),
              "tendril: GLM's quaternions must lie in memory as x, y, z, w (no GLM_FORCE_QUAT_DATA_WXYZ)");

}  // namespace tendril
