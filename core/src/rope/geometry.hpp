// Vectors in double precision, with the operations in a fixed order. Not installed.
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "math/vector.hpp"

namespace tendril::rope::detail {

using glm::dvec3;

using math::cross;
using math::dot;
using math::length;

/// +Y for the zero vector.
inline dvec3 unit(const dvec3& a) noexcept {
    const double size = length(a);
    return size > 1e-30 ? (1.0 / size) * a : dvec3(0.0, 1.0, 0.0);
}
/// A perpendicular unit vector, always the same for the same direction.
inline dvec3 perpendicular(const dvec3& a) noexcept {
    const dvec3 along = unit(a);
    return unit(std::abs(along.y) < 0.9 ? cross(cross(along, {0.0, 1.0, 0.0}), along)
                                        : cross(cross(along, {1.0, 0.0, 0.0}), along));
}

/// The axes of a rotated box, from a quaternion of any length but 0.
struct Axes {
    dvec3 x, y, z;

    explicit Axes(const glm::quat& rotation) noexcept {
        double qx = rotation.x, qy = rotation.y, qz = rotation.z, qw = rotation.w;
        const double size = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
        const double by = size > 1e-30 ? 1.0 / size : 0.0;
        qx *= by, qy *= by, qz *= by, qw *= by;
        x = {1.0 - 2.0 * (qy * qy + qz * qz), 2.0 * (qx * qy + qw * qz), 2.0 * (qx * qz - qw * qy)};
        y = {2.0 * (qx * qy - qw * qz), 1.0 - 2.0 * (qx * qx + qz * qz), 2.0 * (qy * qz + qw * qx)};
        z = {2.0 * (qx * qz + qw * qy), 2.0 * (qy * qz - qw * qx), 1.0 - 2.0 * (qx * qx + qy * qy)};
    }
    dvec3 to_local(const dvec3& v) const noexcept { return {dot(v, x), dot(v, y), dot(v, z)}; }
    dvec3 to_world(const dvec3& v) const noexcept { return v.x * x + v.y * y + v.z * z; }
};

}  // namespace tendril::rope::detail
