// Whether a state is consistent. Not installed.
#pragma once

#include "tendril/magnitude.hpp"
#include "tendril/result.hpp"
#include "tendril/rope/state.hpp"

namespace tendril::rope::detail {

/// Maximum displacement of a particle in a substep, metres each way: from one edge of the world to the other.
inline constexpr double max_displacement = 2.0 * static_cast<double>(max_magnitude);

/// The message names the fault and its position.
Result check(const State& state);

}  // namespace tendril::rope::detail
