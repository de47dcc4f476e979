// A rig as data: elements, named curves, and units in the order in which they run. A plain value in which
// everything is referenced by name; Rig::make (rig.hpp) compiles it.
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
    std::string parent{};              ///< empty: a root
    Transform initial{};               ///< within its parent
    std::optional<Control> control{};  ///< controls only; default: a Transform control
    bool operator==(const Element&) const = default;
};

/// A named number that units read and write: a morph weight, a material parameter.
struct NamedCurve {
    std::string name{};
    double value = 0.0;
    bool operator==(const NamedCurve&) const = default;
};

struct Definition {
    std::vector<Element> elements{};  ///< in any order; a parent may come after its children
    std::vector<NamedCurve> curves{};
    Units units{};
    bool operator==(const Definition&) const = default;
};

}  // namespace tendril::rig

namespace tendril {
template <>
std::span<const Field> fields<rig::Element>() noexcept;
template <>
std::span<const Field> fields<rig::Definition>() noexcept;
}  // namespace tendril
