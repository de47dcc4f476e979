// Preparations of a pose before the first iteration, and its rotations after the last. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Moves joints to their lengths, from the first bone on that is not at its length within the tolerance of
/// chain.hpp. A joint given at its predecessor's position continues straight on, or along its rest direction
/// if there is no previous bone.
template <class Watch>
void enforce_lengths(Problem& problem, Watch watch) noexcept;

/// Blends each bone by `part`, 0 to 1, towards its rest direction.
template <class Watch>
void snap_back(Problem& problem, float part, Watch watch) noexcept;

/// Updates each bone's rotation in the state by the minimal rotation to its current direction (parallel
/// transport). A rotation that agrees to rounding is kept bit for bit, so that solves which move nothing
/// rotate nothing. O(n), about 10 ns per bone.
void transport_rotations(Problem& problem) noexcept;

}  // namespace tendril::ik::detail
