// GLM's points and directions, and the memory layout that the library's binary assumes. A program that
// configures GLM differently would misread the library's memory, so it does not compile.
#pragma once

#include <glm/vec3.hpp>

namespace tendril {

static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && alignof(glm::vec3) == alignof(float) &&
                  sizeof(glm::dvec3) == 3 * sizeof(double) && alignof(glm::dvec3) == alignof(double),
              "tendril: GLM's vectors must be packed (no GLM_FORCE_DEFAULT_ALIGNED_GENTYPES)");

}  // namespace tendril
