// Finds bones that jumped from one solve to the next although no control moved far, and why.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A bone that flipped, by FlipRule: no control moved far enough to explain its rotation. A number moved far
/// if it changed by the rule's fraction of its range; a switch, if it was toggled.
struct RigFlip {
    std::size_t element = 0;  ///< index in the definition
    double radians = 0.0;     ///< global rotation
    /// The unit at which the two solves diverge, and the evidence of its warnings or inputs: "unit aim: the
    /// second target crossed the line to the first". If neither explains it: "cause not known".
    std::string cause{};
};

/// For each unit the bone that it rotated furthest (among equals, the one nearest the root), at most `most`.
/// `was` and `is` are two solved states of the part's rig; if bones flipped, each is solved again, with a
/// zero time step.
std::vector<RigFlip> rig_flips(const RigPart& part, const rig::State& was, const rig::State& is,
                               std::size_t most);

}  // namespace tendril::app
