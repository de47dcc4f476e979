// What solves on joints alone do to a pose before the first iteration, and after the last. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// From the first bone on that is not at its length, as far as chain.hpp allows, every joint is moved to it.
/// A joint given at the point of the one before it goes straight on, or along its rest direction where
/// nothing came before.
template <class Watch>
void enforce_lengths(Problem& problem, Watch watch) noexcept;

/// Each joint is blended by `part`, 0 to 1, towards its rest direction from the one before.
template <class Watch>
void snap_back(Problem& problem, float part, Watch watch) noexcept;

/// Turns each bone's rotation in the state on by the minimal rotation that brings it to where its joints are
/// (parallel transport). One that agrees to rounding stays as it is to the bit, so that solves which move
/// nothing turn nothing. O(n), about 10 ns a bone.
void transport_rotations(Problem& problem) noexcept;

}  // namespace tendril::ik::detail
