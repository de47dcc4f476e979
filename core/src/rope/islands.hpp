// Divides the bodies of a world into islands that are solved together. Not installed.
#pragma once

#include "rope/plan.hpp"

namespace tendril::rope::detail {

/// The body of each particle.
std::vector<std::uint32_t> bodies_of_particles(const State& state);

/// Divides a plan into islands and sorts its lists by them. Requires chains, soft links and chunks, in the
/// state's order.
void divide_into_islands(const State& state, Plan& plan);

}  // namespace tendril::rope::detail
