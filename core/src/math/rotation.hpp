// Unit quaternions of floats or doubles in plain arithmetic, for the reason given in point.hpp. Not
// installed.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <type_traits>

#include "math/vector.hpp"
#include "tendril/elementary.hpp"

namespace tendril::math {

template <class T>
using Quat = glm::qua<T, glm::defaultp>;

template <class T>
static inline Quat<T> unit_quaternion(T w, T x, T y, T z) noexcept {
    const T scale = T(1) / std::sqrt(w * w + x * x + y * y + z * z);
    return {w * scale, x * scale, y * scale, z * scale};
}
static inline glm::quat narrow(const glm::dquat& q) noexcept {
    return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
            static_cast<float>(q.z)};
}
/// Normalises in double: a float quaternion has unit length only to 1e-7.
static inline glm::dquat wide(const glm::quat& q) noexcept {
    return unit_quaternion(static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
                           static_cast<double>(q.z));
}
template <class T>
static inline Quat<T> conjugate(const Quat<T>& q) noexcept {
    return {q.w, -q.x, -q.y, -q.z};
}
/// Applies `b` first, then `a`.
template <class T>
static inline Quat<T> compose(const Quat<T>& a, const Quat<T>& b) noexcept {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
template <class T>
static inline Vec<T> rotated(const Quat<T>& q, const Vec<std::type_identity_t<T>>& v) noexcept {
    const Vec<T> axis{q.x, q.y, q.z};
    const Vec<T> t = times(cross(axis, v), T(2));
    return plus(plus(v, times(t, q.w)), cross(axis, t));
}
/// Interpolates along the shortest rotation (K. Shoemake, "Animating rotation with quaternion curves",
/// SIGGRAPH 1985); `from` if `part` is 0, `to` or its negative (the same rotation) if it is 1.
static inline glm::quat slerp(const glm::quat& from, const glm::quat& to, float part) noexcept {
    const float cosine = from.w * to.w + from.x * to.x + from.y * to.y + from.z * to.z;
    const float sign = cosine < 0.0f ? -1.0f : 1.0f, size = std::abs(cosine);
    float a = 1.0f - part, b = part;
    if (size < 0.9995f) {
        const float angle = arctangent(std::sqrt((1.0f - size) * (1.0f + size)), size);
        a = sine(a * angle), b = sine(b * angle);  // not divided by sin(angle): unit_quaternion
                                                   // normalises
    }
    b *= sign;
    return unit_quaternion(a * from.w + b * to.w, a * from.x + b * to.x, a * from.y + b * to.y,
                           a * from.z + b * to.z);
}
/// Two unit vectors are treated as opposite if 1 + the cosine of their angle is below this.
template <class T>
inline constexpr T nearly_opposite = std::is_same_v<T, float> ? T(1e-6) : T(1e-14);
/// The minimal rotation that takes one unit vector to another; half a turn about `perpendicular(from)` if
/// they are opposite.
template <class T>
static inline Quat<T> minimal_rotation(const Vec<T>& from, const Vec<T>& to) noexcept {
    const T w = T(1) + dot(from, to);
    if (w < nearly_opposite<T>) {
        const Vec<T> axis = perpendicular(from);
        return {T(0), axis.x, axis.y, axis.z};
    }
    const Vec<T> axis = cross(from, to);
    return unit_quaternion(w, axis.x, axis.y, axis.z);
}

}  // namespace tendril::math
