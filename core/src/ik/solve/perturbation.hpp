// The collinear singularity: a chain that lies on a line with its target gets no hint from any method which
// way to bend. It is bent a little, always in the same way. Not installed.
#pragma once

#include <cstdint>

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// From the root to what is furthest from it: no other choice is as little bent by rounding.
glm::vec3 line_of(const Problem& problem) noexcept;

/// -1 to 1, without a pattern that a shape could fit.
float scattered(std::size_t bone, std::uint32_t salt) noexcept;

/// Whether root, joints and target lie on one line, to 1e-5 of the reach. O(n), and O(1) as a rule: it ends
/// at the first that does not.
bool is_collinear(const Problem& problem) noexcept;

/// Bends the chain into a shallow arc, towards the pole where there is one that is off the line, else towards
/// a fixed side of it.
template <class Watch>
void bend_collinear_chain(Problem& problem, Watch watch) noexcept;

/// For a chain that stalled in some other way: every bone is turned a little, each in its own direction;
/// another one for each `number`, the same for the same.
template <class Watch>
void perturb(Problem& problem, int number, Watch watch) noexcept;

}  // namespace tendril::ik::detail
