// The folding sections that the panels have drawn, so that a command can offer them by name.
#pragma once

#include <set>
#include <string>

#include "app/document/runtime.hpp"

namespace tendril::app {

struct DrawnSections final : Runtime {
    std::set<std::string> names;  ///< "chain: Target"
};

}  // namespace tendril::app
