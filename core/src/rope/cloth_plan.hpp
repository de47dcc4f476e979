// Finds the islands that are cloths whose links all fit a grid. Not installed.
#pragma once

#include "rope/plan.hpp"

namespace tendril::rope::detail {

/// Fills `plan.grids`, `plan.grid_links`, `plan.grid_of` and the grids of `plan.tied`; requires islands.
void find_grids(const State& state, Plan& plan);

}  // namespace tendril::rope::detail
