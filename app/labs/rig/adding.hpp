// What a menu adds: elements and units with no more than they need, taken from what is selected.
#pragma once

#include <optional>
#include <string>

#include "app/document/json.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// "bone 3": the first of these that no element has.
std::string free_element_name(const RigPart& part, const std::string& base);

/// A unit as rig.unit.add takes it, and why there is none.
struct UnitOffer {
    std::optional<SharedJson> unit;
    const char* needs = "";  ///< "two bones or more": where there is no unit
};
/// `operation` is the index in rig::Operation. Works on the active element, where it is one that works: the
/// others that are selected it follows. A for-each goes over all that are selected.
UnitOffer offered_unit(const RigPart& part, std::size_t operation);

}  // namespace tendril::app
