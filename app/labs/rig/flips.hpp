// Which bones of a rig jumped from one solve to the next, while its controls hardly moved.
#pragma once

#include <cstddef>
#include <vector>

#include "app/labs/kit/reach_flip.hpp"
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

}  // namespace tendril::app
