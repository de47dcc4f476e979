// One foot's part of a step: its lock, the ground below it, and its goal. Not installed.
#pragma once

#include "rig/math.hpp"
#include "tendril/humanoid/feet.hpp"

namespace tendril::humanoid::detail {

/// Shared by both feet of a step.
struct FootContext {
    const Ground& ground;
    const FeetOptions& options;
    double dt;        // seconds; 0: no time passes
    bool fresh;       // the first step: nothing eases
    double floor;     // of the clip, in the ground's space
    double base;      // how far the root is raised
    double eased;     // the factor by which an offset decays in this step
    double steepest;  // cosine of max_slope
};

/// A foot in the clip, in the ground's space.
struct FootClip {
    glm::dvec3 ankle, heel, ball, toe;
};

/// Offsets of the ankle from the clip.
struct FootGoal {
    double lift = 0.0;     // upwards, before the speed limit
    double contact = 0.0;  // the lift that puts the sole on the ground
    double rise = 0.0;     // of the plane below the foot, along its way in this step
    glm::dvec3 slip{0.0};  // horizontal
    double shifted = 0.0;  // horizontal, in this step, relative to the clip
};

/// Locks or releases the foot, and moves the offset of one in the air towards its foothold. Returns that
/// move.
glm::dvec3 update_lock(FootState& foot, const FootClip& clip, const FootContext& context) noexcept;

/// Queries the ground and turns the foot by it; sets foot.alone if there is no ground to stand on.
FootGoal find_goal(FootState& foot, const FootClip& clip, const glm::dvec3& eased,
                   const FootContext& context) noexcept;

}  // namespace tendril::humanoid::detail
