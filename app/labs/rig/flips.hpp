// Which bones of a rig jumped from one solve to the next, while its controls hardly moved.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/labs/kit/flips.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A bone that flipped, by FlipRule: no control moved far for how far the bone turned. A number counts as
/// moved far where it moved by the rule's share of its range; a switch, where it was switched.
struct BoneFlip {
    std::size_t element = 0;  ///< its place in the definition
    double radians = 0.0;     ///< that it turned, in the scene
};

/// The bone that turned the furthest first; of those that turned together, the one nearest to the root.
/// `was` and `is`: two states of the rig, both solved.
std::vector<BoneFlip> bone_flips(const rig::Rig& rig, const rig::State& was, const rig::State& is,
                                 const FlipRule& rule);

/// Metres: from corner to corner of a box around all bones; 1 where that has no size.
double skeleton_size(const rig::Rig& rig, rig::State& state);

// Why a bone of a rig flipped: the unit in which the two solves part, and what the units report or their
// inputs show. Where neither says it, "cause not known".

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
