// Vectors in plain arithmetic, for the reason that point.hpp gives; of floats, and of doubles for the few
// sums and closed forms in which floats would lose what counts. Not installed.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
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

}  // namespace tendril::math
