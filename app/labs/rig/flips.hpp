// Finds the bones that jumped from one solve to the next although no control moved far, and why.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/labs/kit/flips.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A bone that flipped, by FlipRule: no control moved far enough to explain its rotation. A number moved far
/// if it changed by the rule's fraction of its range; a switch, if it was toggled.
struct BoneFlip {
    std::size_t element = 0;  ///< index in the definition
    double radians = 0.0;     ///< global rotation
};

/// Largest rotation first; among equals, the bone nearest the root first. `was` and `is` are two solved
/// states of the rig.
std::vector<BoneFlip> bone_flips(const rig::Rig& rig, const rig::State& was, const rig::State& is,
                                 const FlipRule& rule);

/// Diagonal of the bounding box of all bones, metres; 1 if that is empty.
double skeleton_size(const rig::Rig& rig, rig::State& state);

// Why a bone flipped: the unit at which the two solves diverge, and the evidence of its warnings or inputs.
// If neither explains the flip, the text says "cause not known".

struct FlipCause {
    std::optional<std::size_t> unit;  ///< index in Definition::units: where the two solves diverge
    std::string text;                 ///< "unit aim: the second target passed the primary axis"
};

/// One cause per flip. `was` and `is` are two solved states of the part's rig; each is solved again with a
/// zero time step. Meant for the moment of a flip, not for every tick.
std::vector<FlipCause> flip_causes(const RigPart& part, const rig::State& was, const rig::State& is,
                                   const std::vector<BoneFlip>& flips);

/// The rig just before and just after one unit of a solve.
struct UnitSolve {
    RigPart found, left;
};
/// The cause in this unit that can rotate a bone by `radians` from one solve to the next; empty if unknown.
std::optional<std::string> unit_cause(const rig::Unit& unit, const UnitSolve& before, const UnitSolve& after,
                                      double radians);

}  // namespace tendril::app
