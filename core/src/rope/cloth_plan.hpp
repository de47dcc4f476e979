// Which islands are cloths whose links all fit their grid. Not installed.
#pragma once

#include "rope/plan.hpp"

namespace tendril::rope::detail {

/// Fills `plan.grids` and `plan.grid_links`, once islands are there.
void find_grids(const State& state, Plan& plan);

}  // namespace tendril::rope::detail
