// What the window tells the labs: the folding sections that the panels have drawn, so that a command can
// offer them by name, and whether the machine keeps up.
#pragma once

#include <set>
#include <string>

#include "app/document/runtime.hpp"

namespace tendril::app {

struct DrawnSections final : Runtime {
    std::set<std::string> names;  ///< "chain: Target"
};

/// In a live window only.
struct Pace final : Runtime {
    double kept = 1.0;  ///< share of the last second that the ticks kept up with
};
inline Pace& pace_of(const Runtimes& runtimes) {
    return runtimes.of<Pace>("pace");
}

}  // namespace tendril::app
