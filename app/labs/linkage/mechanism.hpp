// The Linkage lab's presets: the library's mechanisms, with their lengths as tables of fields.
#pragma once

#include <tendril/ik/mechanisms.hpp>
#include <variant>
#include <vector>

#include "app/fields/fields.hpp"

namespace tendril::app {

/// Twelve of Jansen's legs on one crank, at 1/100 scale: six pairs, a sixth of a turn apart.
struct JansenWalker : ik::Jansen {
    JansenWalker();
};

/// The lengths of a mechanism; std::monostate: drawn by hand.
using Mechanism = std::variant<std::monostate, ik::FourBar, ik::SliderCrank, ik::Peaucellier, ik::Pantograph,
                               ik::ScissorLift, ik::Jansen, JansenWalker, ik::Delta, ik::Stewart>;

struct MechanismKind {
    const char* name;
    const char* title;
    const char* help;
    Mechanism (*blank)();
    std::span<const Field> fields;
    std::vector<FieldText> texts;
    const char* traced;        ///< the point whose path is shown at first; empty: none
    const char* drivers = "";  ///< in space: name prefix of the driven links
};

/// In the order of the variant's alternatives, from the second on.
const std::vector<MechanismKind>& mechanism_kinds();
/// Throws std::invalid_argument for an unknown name.
const MechanismKind& mechanism_kind(std::string_view name);
/// Null if it was drawn by hand.
const MechanismKind* kind_of(const Mechanism& mechanism);

/// The table and the lengths; an empty table if it was drawn by hand.
FieldsOf mechanism_fields(const Mechanism& mechanism);
FieldsIn mechanism_fields(Mechanism& mechanism);

}  // namespace tendril::app
