// Shared helpers of the surface builders.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "app/view/draw_list.hpp"

namespace tendril::app {

/// Limit of coordinates, metres: fourth powers are still finite.
inline constexpr float farthest_built = 1e9f;

inline bool can_be_built(glm::vec3 point) {
    return std::abs(point.x) <= farthest_built && std::abs(point.y) <= farthest_built &&
           std::abs(point.z) <= farthest_built;
}

inline glm::vec3 unit_or(glm::vec3 vector, glm::vec3 fallback) {
    const float length = glm::length(vector);
    return length > 1e-30f && std::isfinite(length) ? vector / length : fallback;
}

/// Casts the shadow of an invisible capsule.
inline void cast(DrawList& list, glm::vec3 a, glm::vec3 b, float radius) {
    list.bone(a, b, radius, radius, glm::vec4(0.0f)).shadow = true;
}

}  // namespace tendril::app
