// The initial shape of a rope. Not installed.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace tendril::rope::detail {

/// `segments` + 1 points from `from` to `to`: straight, or, if `length` exceeds the distance, on a parabola
/// along `down` (unit). Neighbours are then length / segments apart.
std::vector<glm::dvec3> hang(const glm::dvec3& from, const glm::dvec3& to, double length,
                             std::size_t segments, const glm::dvec3& down);

}  // namespace tendril::rope::detail
