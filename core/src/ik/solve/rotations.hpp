// Rotations that follow the joints, for solves that work on joints alone. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Turns each bone's rotation in the state on by the minimal rotation that brings it to where its joints are
/// (parallel transport). One that agrees to rounding stays as it is to the bit, so that solves which move
/// nothing turn nothing. O(n), about 10 ns a bone.
void transport_rotations(Problem& problem) noexcept;

}  // namespace tendril::ik::detail
