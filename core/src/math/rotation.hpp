// Vectors and unit quaternions in plain arithmetic, for the reason that point.hpp gives. Not installed.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "math/vector.hpp"

namespace tendril::math {

static inline glm::quat unit_quaternion(float w, float x, float y, float z) noexcept {
    const float scale = 1.0f / std::sqrt(w * w + x * x + y * y + z * z);
    return {w * scale, x * scale, y * scale, z * scale};
}
static inline glm::quat conjugate(const glm::quat& q) noexcept {
    return {q.w, -q.x, -q.y, -q.z};
}
/// First `b`, then `a`.
static inline glm::quat compose(const glm::quat& a, const glm::quat& b) noexcept {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
static inline glm::vec3 rotated(const glm::quat& q, const glm::vec3& v) noexcept {
    const glm::vec3 axis{q.x, q.y, q.z};
    const glm::vec3 t = times(cross(axis, v), 2.0f);
    return plus(plus(v, times(t, q.w)), cross(axis, t));
}
/// About a unit axis, radians.
static inline glm::quat rotation_about(const glm::vec3& axis, float angle) noexcept {
    const float s = std::sin(0.5f * angle);
    return {std::cos(0.5f * angle), axis.x * s, axis.y * s, axis.z * s};
}
/// Part of the shortest way from one rotation to another (K. Shoemake, "Animating rotation with quaternion
/// curves", SIGGRAPH 1985); `from` where `part` is 0, `to` or its negative, which is the same, where it is 1.
static inline glm::quat slerp(const glm::quat& from, const glm::quat& to, float part) noexcept {
    const float cosine = from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z;
    const float sign = cosine < 0.0f ? -1.0f : 1.0f, size = std::abs(cosine);
    float a = 1.0f - part, b = part;
    if (size < 0.9995f) {
        const float angle = std::acos(size);
        a = std::sin(a * angle), b = std::sin(b * angle);  // by the sine of the whole: unit_quaternion's part
    }
    b *= sign;
    return unit_quaternion(a * from.w + b * to.w, a * from.x + b * to.x, a * from.y + b * to.y,
                           a * from.z + b * to.z);
}
/// The minimal rotation that takes one unit vector to another; half a turn about `perpendicular(from)` where
/// they are opposite.
static inline glm::quat minimal_rotation(const glm::vec3& from, const glm::vec3& to) noexcept {
    const float w = 1.0f + dot(from, to);
    if (w < 1e-6f) {
        const glm::vec3 axis = perpendicular(from);
        return {0.0f, axis.x, axis.y, axis.z};
    }
    const glm::vec3 axis = cross(from, to);
    return unit_quaternion(w, axis.x, axis.y, axis.z);
}

}  // namespace tendril::math
