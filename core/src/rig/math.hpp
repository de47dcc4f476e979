// Brings the math functions that the rig uses into its namespace. Not installed.
#pragma once

#include <algorithm>

#include "math/rotation.hpp"
#include "math/vector.hpp"
#include "tendril/elementary.hpp"

namespace tendril::rig::detail {

using math::across;
using math::arctangent;
using math::conjugate;
using math::cross;
using math::direction_of;
using math::dot;
using math::length;
using math::minimal_rotation;
using math::minus;
using math::perpendicular;
using math::pi;
using math::plus;
using math::rotated;
using math::rotation_about;
using math::times;
using math::unit_quaternion;

inline glm::dvec3 product(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline glm::dvec3 mix(const glm::dvec3& a, const glm::dvec3& b, double part) noexcept {
    return {a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part, a.z + (b.z - a.z) * part};
}
inline double dot(const glm::dquat& a, const glm::dquat& b) noexcept {
    return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}
/// Half the angle between two rotations the short way, radians: 0 to pi / 2.
inline double half_angle_between(const glm::dquat& a, const glm::dquat& b) noexcept {
    const glm::dquat turn = math::compose(b, conjugate(a));
    return arctangent(length(glm::dvec3{turn.x, turn.y, turn.z}), std::abs(turn.w));
}
/// Like math::slerp.
inline glm::dquat slerp(const glm::dquat& from, const glm::dquat& to, double part) noexcept {
    const double half = half_angle_between(from, to);
    double a = 1.0 - part, b = part;
    if (half > 1e-9) {  // below, sines equal their angles
        a = math::sine(a * half);
        b = math::sine(b * half);
    }
    if (dot(from, to) < 0.0) b = -b;
    return unit_quaternion(a * from.w + b * to.w, a * from.x + b * to.x, a * from.y + b * to.y,
                           a * from.z + b * to.z);
}
/// Clamps a weight from a curve or another unit to 0 to 1; NaN becomes 0.
inline double weight(double value) noexcept {
    return value > 0.0 ? std::min(value, 1.0) : 0.0;
}

}  // namespace tendril::rig::detail
