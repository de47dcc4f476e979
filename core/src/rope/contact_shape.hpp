// What finding contacts needs to know about shapes. Not installed.
#pragma once

#include <glm/vec3.hpp>

#include "tendril/rope/collider.hpp"

namespace tendril::rope::detail {

/// A box along the axes that holds a shape and all that it went through while it moved by `by`. A plane's is
/// without end.
void bounds(const Shape& shape, const glm::dvec3& by, glm::dvec3& low, glm::dvec3& high) noexcept;

/// Whether a box along the axes lies wholly outside, for the shapes that their bounds say little about.
bool beyond(const Shape& shape, const glm::dvec3& low, const glm::dvec3& high) noexcept;

/// Where on the line from a (0) to b (1) the shape is nearest, or reaches deepest.
double nearest_on_line(const Shape& shape, const glm::dvec3& a, const glm::dvec3& b) noexcept;

}  // namespace tendril::rope::detail
