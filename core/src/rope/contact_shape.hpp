// Geometry of shapes for finding contacts. Not installed.
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "tendril/rope/collider.hpp"

namespace tendril::rope::detail {

/// An axis-aligned box that contains a shape and everything it swept while moving by `by`. Infinite for a
/// plane.
void bounds(const Shape& shape, const glm::dvec3& by, glm::dvec3& low, glm::dvec3& high) noexcept;

/// Whether an axis-aligned box is entirely outside; only for shapes without useful bounds (planes).
bool beyond(const Shape& shape, const glm::dvec3& low, const glm::dvec3& high) noexcept;

/// Where the line from a (0) to b (1) is nearest to a shape, or deepest inside it. No value if that is an
/// end, or farther than `reach` away. Adds the distances computed, 14 at most, to `work`.
std::optional<double> nearest_between(const Shape& shape, const glm::dvec3& a, const glm::dvec3& b,
                                      double reach, std::uint64_t& work) noexcept;

/// A capsule's middle, in double precision: a capsule moved to its own middle does not move.
glm::dvec3 middle_of(const Capsule& capsule) noexcept;
/// Half the vector from end a to end b.
glm::dvec3 half_of(const Capsule& capsule) noexcept;
/// A collider's shape after this part of the way to its goal.
Shape interpolated(const Collider& collider, double part) noexcept;
/// The rotation by a steady spin.
glm::dquat rotation_after(const Drive& drive, double seconds) noexcept;
/// The shape after a steady motion for some seconds. A plane stays.
Shape driven(const Shape& shape, const Drive& drive, double seconds) noexcept;

/// The same shape with coordinates clamped to max_magnitude, which rounding can exceed.
Shape clamped_to_world(const Shape& shape) noexcept;

}  // namespace tendril::rope::detail
