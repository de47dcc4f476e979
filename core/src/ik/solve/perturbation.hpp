// The collinear singularity: if a chain lies on one line with its target, no method can tell which way to
// bend it. Such a chain is bent a little, deterministically. Not installed.
#pragma once

#include <cstdint>

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Unit vector from the root towards the point furthest from it, the choice that rounding affects least.
glm::vec3 line_of(const Problem& problem) noexcept;

/// Pseudo-random, -1 to 1, without a regular pattern.
float scattered(std::size_t bone, std::uint32_t salt) noexcept;

/// True if root, joints and target lie on one line, to 1e-5 of the reach. O(n) at worst, usually O(1): it
/// stops at the first point off the line.
bool is_collinear(const Problem& problem) noexcept;

/// Bends the chain into a shallow arc, towards the pole if there is one off the line, otherwise towards a
/// fixed side.
template <class Watch>
void bend_collinear_chain(Problem& problem, Watch watch) noexcept;

/// Perturbs a chain that stalled in another way: turns every bone a little, each in its own direction.
/// Deterministic: `number` selects the directions.
template <class Watch>
void perturb(Problem& problem, int number, Watch watch) noexcept;

}  // namespace tendril::ik::detail
