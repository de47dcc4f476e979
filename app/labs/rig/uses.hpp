// Which units name something: an element, another unit, a curve. Nothing that is named can be removed.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <tendril/rig/unit.hpp>
#include <vector>

namespace tendril::app {

enum class Named { Element, Unit, Curve };

struct Use {
    std::string unit;    ///< that names one of them
    std::string member;  ///< in which: "primary.target"
    std::string name;    ///< of what it names
};

/// The first, in order, bodies included; none where nothing names any of them.
std::optional<Use> first_use(const std::vector<rig::Unit>& units, Named kind,
                             const std::set<std::string>& names);

}  // namespace tendril::app
