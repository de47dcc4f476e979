// Points of floats, and the one step that chains and solvers share. Not installed.
//
// GLM's functions are not used because they are inline: a program compiled with other floating-point options
// could replace the library's copies with its own at link time. Plain arithmetic in this order gives the same
// bits everywhere.
//
// Overflow checks are not needed: input is at most 1e9, and a float that grows in steps of at most 1e9 stops
// growing at 2^54, where the spacing of floats is 2^31 and half of it exceeds the step. So no coordinate
// exceeds 2^54, no difference 2^55, and the sum of three squares stays under 1e34; a float holds 3e38.
#pragma once

#include <cfloat>
#include <cmath>
#include <glm/vec3.hpp>

namespace tendril::math {

/// Points closer than the square root of this (0.35 mm) coincide: there is no direction between them.
inline constexpr float coincidence = FLT_EPSILON;

static inline float squared_distance(const glm::vec3& a, const glm::vec3& b) noexcept {
    const float x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
    return x * x + y * y + z * z;
}

static inline float distance(const glm::vec3& a, const glm::vec3& b) noexcept {
    return std::sqrt(squared_distance(a, b));
}

static inline bool coincide(const glm::vec3& a, const glm::vec3& b) noexcept {
    return squared_distance(a, b) < coincidence;
}

/// `origin + direction * by`
static inline glm::vec3 moved(const glm::vec3& origin, const glm::vec3& direction, float by) noexcept {
    return {origin.x + direction.x * by, origin.y + direction.y * by, origin.z + direction.z * by};
}

/// Unit vector from `a` to `b`, or `fallback` if they coincide.
static inline glm::vec3 direction(const glm::vec3& a, const glm::vec3& b,
                                  const glm::vec3& fallback) noexcept {
    const float squared = squared_distance(a, b);
    if (squared < coincidence) return fallback;
    const float inverse = 1.0f / std::sqrt(squared);
    return {(b.x - a.x) * inverse, (b.y - a.y) * inverse, (b.z - a.z) * inverse};
}

/// Moves `old` to distance `length` from `anchor`, on the line from `anchor` through it, or along `fallback`
/// if the two coincide.
static inline glm::vec3 step(const glm::vec3& anchor, const glm::vec3& old, float length,
                             const glm::vec3& fallback) noexcept {
    const float x = old.x - anchor.x, y = old.y - anchor.y, z = old.z - anchor.z;
    const float squared = x * x + y * y + z * z;
    if (squared < coincidence) return moved(anchor, fallback, length);
    const float scale = length / std::sqrt(squared);
    return {anchor.x + x * scale, anchor.y + y * scale, anchor.z + z * scale};
}

}  // namespace tendril::math
