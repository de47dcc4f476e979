// Which units name something: an element, another unit, a curve. Nothing that is named can be removed.
#pragma once

#include <optional>
#include <string>
#include <tendril/rig/unit.hpp>
#include <vector>

namespace tendril::app {

enum class Named { Element, Unit, Curve };

struct Use {
    std::string unit;    ///< that names it
    std::string member;  ///< in which: "primary.target"
};

/// The first, in order, bodies included; none where nothing names it.
std::optional<Use> first_use(const std::vector<rig::Unit>& units, Named kind, const std::string& name);

}  // namespace tendril::app
