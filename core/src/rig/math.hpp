// The algebra that the rig uses, without its qualification. Not installed.
#pragma once

#include <algorithm>

#include "math/rotation.hpp"
#include "math/vector.hpp"

namespace tendril::rig::detail {

using math::across;
using math::conjugate;
using math::cross;
using math::direction_of;
using math::dot;
using math::length;
using math::minimal_rotation;
using math::minus;
using math::perpendicular;
using math::plus;
using math::rotated;
using math::times;

inline glm::dvec3 product(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline glm::dvec3 mix(const glm::dvec3& a, const glm::dvec3& b, double part) noexcept {
    return {a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part, a.z + (b.z - a.z) * part};
}
inline double dot(const glm::dquat& a, const glm::dquat& b) noexcept {
    return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}
/// A weight that came out of a curve or another unit may be anything; NaN leaves things as they are.
inline double weight(double value) noexcept {
    return value > 0.0 ? std::min(value, 1.0) : 0.0;
}

}  // namespace tendril::rig::detail
