// Which bodies of a world are solved together. Not installed.
#pragma once

#include "rope/plan.hpp"

namespace tendril::rope::detail {

/// The body of each particle.
std::vector<std::uint32_t> bodies_of_particles(const State& state);

/// Divides a plan with chains, soft links and chunks, all of them in the state's order, into islands, and
/// sorts its lists by them.
void divide_into_islands(const State& state, Plan& plan);

}  // namespace tendril::rope::detail
