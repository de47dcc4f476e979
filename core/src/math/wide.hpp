// What only vectors of doubles need. Not installed.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <optional>

#include "math/vector.hpp"

namespace tendril::math {

static inline glm::dvec3 wide(const glm::vec3& a) noexcept {
    return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}
static inline glm::vec3 narrow(const glm::dvec3& a) noexcept {
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
/// What of `a` is at right angles to the unit vector `axis`.
static inline glm::dvec3 across(const glm::dvec3& a, const glm::dvec3& axis) noexcept {
    return minus(a, times(axis, dot(a, axis)));
}

/// A unit vector along `a`; none where `a` is not longer than `minimum`.
static inline std::optional<glm::dvec3> direction_of(const glm::dvec3& a, double least) noexcept {
    const double size = length(a);
    if (!(size > least)) return std::nullopt;
    return times(a, 1.0 / size);
}
/// Some unit vector at right angles to a unit vector; the same for the same.
static inline glm::dvec3 perpendicular(const glm::dvec3& axis) noexcept {
    // Away from the axis that it has the smallest part of, so that the product is never small.
    const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
    const glm::dvec3 away = y <= x && y <= z ? glm::dvec3(0, 1, 0)
                            : z <= x         ? glm::dvec3(0, 0, 1)
                                             : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = across(away, axis);
    return times(side, 1.0 / length(side));
}

}  // namespace tendril::math
