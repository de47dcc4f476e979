// Why a bone of a rig flipped: the unit in which the two solves part, and what the units report or their
// inputs show. Where neither says it, "cause not known".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/labs/rig/flips.hpp"

namespace tendril::app {

struct FlipCause {
    std::optional<std::size_t> unit;  ///< in Definition::units, after which the bone was turned the other way
    std::string text;                 ///< "unit aim: the second target passed the primary axis"
};

/// One a flip. `was` and `is`: two states of the part's rig, both solved; each is solved once more, without
/// any time passing. For the moment of a flip, not for every tick.
std::vector<FlipCause> flip_causes(const RigPart& part, const rig::State& was, const rig::State& is,
                                   const std::vector<BoneFlip>& flips);

/// Of one unit between two solves: `before` and `after` have the rig as the unit found it and as it left it.
struct UnitSolve {
    RigPart found, left;
};
/// What of it can turn a bone by `radians` at a stroke; nothing where that is not known.
std::optional<std::string> unit_cause(const rig::Unit& unit, const UnitSolve& before, const UnitSolve& after,
                                      double radians);

}  // namespace tendril::app
