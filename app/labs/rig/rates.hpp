// The take at the usual frame rates at once: how far apart its bones come.
//
// Each sees the controls as they are at the ends of its own frames, as games at those rates would; they are
// held against each other at the end of every frame of the slowest.
#pragma once

#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// Over the first so many ticks of the take. Throws std::invalid_argument where that would take too long.
RateDifference compare_take_rates(const RigPart& part, std::uint32_t ticks, rig::Workspace& scratch);

}  // namespace tendril::app
