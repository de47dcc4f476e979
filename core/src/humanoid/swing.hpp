// How high a foot in the air must be to pass over the ground along its way. Not installed.
#pragma once

#include "humanoid/foot.hpp"

namespace tendril::humanoid::detail {

/// A sole in the air, in the ground's space, and its way in this step.
struct SoleInAir {
    std::array<glm::dvec3, 3> points;  // heel, ball, toe, as high as they are now
    glm::dvec3 moved;                  // horizontal, in this step, to where the points are now
    glm::dvec3 velocity, before;       // of the clip, in this step and the one before, m/s
    double left = 1e9;                 // how far it still goes, if it is about to land
};

struct OverWay {
    /// How far the sole must be raised now so that each of its points is above the ground when it gets there,
    /// rising at a steady speed: the upper envelope of the ground ahead. Negative if it is high enough.
    double raise = -1e300;
    /// The part of `moved` that takes it no nearer to an edge than it can rise.
    double part = 1.0;
};

/// Both change continuously as the foot moves.
OverWay over_way(const SoleInAir& sole, double from, const FootContext& context) noexcept;

}  // namespace tendril::humanoid::detail
