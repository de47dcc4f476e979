// Whether the machine keeps up with real time, for the labs' messages. In a live window only.
#pragma once

#include "app/document/runtime.hpp"

namespace tendril::app {

/// Seconds that the window catches up after a stall; the rest of a longer one is dropped.
inline constexpr double max_stall = 0.25;

struct Pace final : Runtime {
    double kept = 1.0;  ///< fraction of the last second that the ticks kept up with
};
inline Pace& pace_of(const Runtimes& runtimes) {
    return runtimes.of<Pace>("pace");
}

}  // namespace tendril::app
