// Vectors of floats in plain arithmetic, for the reason given in point.hpp; of doubles for the few sums and
// closed forms in which floats would lose too much precision. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <optional>
#include <type_traits>

namespace tendril::math {

template <class T>
using Vec = glm::vec<3, T, glm::defaultp>;

template <class T>
static inline Vec<T> minus(const Vec<T>& a, const Vec<T>& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
static inline Vec<T> plus(const Vec<T>& a, const Vec<T>& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
static inline Vec<T> times(const Vec<T>& a, std::type_identity_t<T> by) noexcept {
    return {a.x * by, a.y * by, a.z * by};
}
template <class T>
static inline T dot(const Vec<T>& a, const Vec<T>& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
static inline Vec<T> cross(const Vec<T>& a, const Vec<T>& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
static inline T length(const Vec<T>& a) noexcept {
    return std::sqrt(dot(a, a));
}
template <class T>
static inline T largest_coordinate(const Vec<T>& a) noexcept {
    return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}
/// The component of `a` perpendicular to the unit vector `axis`.
template <class T>
static inline Vec<T> across(const Vec<T>& a, const Vec<T>& axis) noexcept {
    return minus(a, times(axis, dot(a, axis)));
}
/// Unit vector along `a`; none if `a` is not longer than `minimum`.
template <class T>
static inline std::optional<Vec<T>> direction_of(const Vec<T>& a, std::type_identity_t<T> minimum) noexcept {
    const T size = length(a);
    if (!(size > minimum)) return std::nullopt;
    return times(a, T(1) / size);
}
/// A unit vector perpendicular to `a`, which must not be zero; deterministic.
template <class T>
static inline Vec<T> perpendicular(const Vec<T>& a) noexcept {
    // Start from the axis along which `a` is smallest, so that the result is never small.
    const T x = std::abs(a.x), y = std::abs(a.y), z = std::abs(a.z);
    const Vec<T> away = y <= x && y <= z ? Vec<T>(0, 1, 0) : z <= x ? Vec<T>(0, 0, 1) : Vec<T>(1, 0, 0);
    const Vec<T> side = minus(away, times(a, dot(away, a) / dot(a, a)));
    return times(side, T(1) / length(side));
}

static inline glm::dvec3 wide(const glm::vec3& a) noexcept {
    return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}
static inline glm::vec3 narrow(const glm::dvec3& a) noexcept {
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
/// From `a` to `b`, in double.
static inline glm::dvec3 between(const glm::vec3& a, const glm::vec3& b) noexcept {
    return minus(wide(b), wide(a));
}
/// The point `by` metres from `from` along a unit vector: computed in double and rounded once.
static inline glm::vec3 moved(const glm::vec3& from, const glm::dvec3& direction, double by) noexcept {
    return narrow(plus(wide(from), times(direction, by)));
}

}  // namespace tendril::math
