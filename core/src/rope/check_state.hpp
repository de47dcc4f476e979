// Whether a state holds together. Not installed.
#pragma once

#include "tendril/rope/world.hpp"

namespace tendril::rope::detail {

/// Throws std::invalid_argument naming what is wrong and where.
void check(const State& state);

}  // namespace tendril::rope::detail
