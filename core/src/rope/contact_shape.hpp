// What finding contacts needs to know about shapes. Not installed.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "tendril/rope/collider.hpp"

namespace tendril::rope::detail {

/// A box along the axes that contains a shape and all that it swept while it moved by `by`. A plane's is
/// without end.
void bounds(const Shape& shape, const glm::dvec3& by, glm::dvec3& low, glm::dvec3& high) noexcept;

/// Whether a box along the axes lies wholly outside, for the shapes that their bounds say little about.
bool beyond(const Shape& shape, const glm::dvec3& low, const glm::dvec3& high) noexcept;

inline constexpr int max_line_samples = 14;
/// Where between the ends of the line from a (0) to b (1) a shape is nearest, or reaches deepest; no value
/// where that is an end, or is further than `reach` away. Takes max_line_samples distances at most.
std::optional<double> nearest_between(const Shape& shape, const glm::dvec3& a, const glm::dvec3& b,
                                      double reach) noexcept;

/// The same shape with no coordinate over max_magnitude, which rounding can make it.
Shape kept_in(const Shape& shape) noexcept;

}  // namespace tendril::rope::detail
