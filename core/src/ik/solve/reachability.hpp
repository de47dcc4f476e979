// Targets that no pose can reach, and the answer to them, found without iterating. Not installed.
#pragma once

#include <optional>

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// With R the reach, m the longest bone, s the sum of the others and D the target's distance from the root:
/// where D > R the chain is straightened towards the target (Stretched); where D < m - s the longest bone
/// points at it and the others fold back (TooClose). Nothing, and none is moved, where it can be reached.
/// Distances within a millionth of the reach count as equal: that is what floats leave of the sums.
template <class Watch>
std::optional<Report> answer_beyond_reach(Problem& problem, Watch watch) noexcept;

/// The distance in double, rounded once.
float exact_distance(const glm::vec3& a, const glm::vec3& b) noexcept;

}  // namespace tendril::ik::detail
