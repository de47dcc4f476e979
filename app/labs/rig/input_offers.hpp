// What an input of a unit may be instead of what it is: elements, outputs of units before it, what a for-each
// says. For the inspector, which lists them; each is one that rig.unit.set takes.
#pragma once

#include "app/document/json.hpp"
#include "app/labs/rig/unit_inputs.hpp"

namespace tendril::app {

struct InputOffer {
    std::string title;  ///< "dial, value", "unit late", "each ratio, 0 to 1"
    SharedJson value;   ///< for with_input()
    bool now = false;   ///< what the input is
};
/// Of one whose UnitInput::takes is not Nothing. An input of values can be a number of its own again, too.
/// Of roots, what the one at `index` may be; another where `index` is their number.
/// Cost: O(elements + units).
std::vector<InputOffer> input_offers(const RigPart& part, const UnitRow& row, const UnitInput& input,
                                     std::size_t index = 0);

}  // namespace tendril::app
