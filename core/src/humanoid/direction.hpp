// Directions and the angles between them. Not installed.
#pragma once

#include "rig/math.hpp"

namespace tendril::humanoid::detail {

/// The angle in radians; the vectors may have any length but 0.
inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    using namespace rig::detail;
    return arctangent(length(cross(a, b)), dot(a, b));
}

/// Turns a unit vector towards another by at most `most` radians; about any axis if they are opposite.
inline glm::dvec3 turned_toward(const glm::dvec3& from, const glm::dvec3& to, double most) noexcept {
    const double angle = angle_between(from, to);
    if (angle <= most) return to;
    return rig::detail::rotated(rig::detail::slerp(glm::dquat(1.0, 0.0, 0.0, 0.0),
                                                   rig::detail::minimal_rotation(from, to), most / angle),
                                from);
}

}  // namespace tendril::humanoid::detail
