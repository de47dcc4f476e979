// A rig as data: elements, named curves, and units in the order in which they run. A plain value, everything
// in it goes by name; rig.hpp makes something of it that solves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tendril/rig/control.hpp"
#include "tendril/rig/hierarchy.hpp"
#include "tendril/rig/unit.hpp"

namespace tendril::rig {

struct Element {
    std::string name{};
    ElementKind kind = ElementKind::Bone;
    std::string parent{};              ///< empty: it stands in the scene
    Transform initial{};               ///< within its parent
    std::optional<Control> control{};  ///< of controls only; Transform where it is left out
    bool operator==(const Element&) const = default;
};

/// A number with a name, which units write and others read: a morph weight, a value of a material.
struct NamedCurve {
    std::string name{};
    double value = 0.0;
    bool operator==(const NamedCurve&) const = default;
};

struct Definition {
    std::vector<Element> elements{};  ///< in any order; a parent may come after its children
    std::vector<NamedCurve> curves{};
    std::vector<Unit> units{};
    bool operator==(const Definition&) const = default;
};

}  // namespace tendril::rig
