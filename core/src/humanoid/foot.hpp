// One foot's part of a step: whether it is locked, where the ground is, and where the ankle goes by that. Not
// installed.
#pragma once

#include "rig/math.hpp"
#include "tendril/humanoid/feet.hpp"

namespace tendril::humanoid::detail {

/// What a step's two feet have in common.
struct FootContext {
    const Ground& ground;
    const FeetOptions& options;
    double dt;        // seconds; 0: no time passes
    bool fresh;       // the first step: everything is where it goes at once
    double floor;     // of the clip, in the ground's space
    double base;      // what the root is moved up by
    double eased;     // what an easing leaves of anything in this step
    double steepest;  // cosine of max_slope
};

/// Where a foot is in the clip, in the ground's space.
struct FootClip {
    glm::dvec3 ankle, heel, toe;
};

/// Where it goes.
struct FootGoal {
    double lift = 0.0;     // what the ankle is moved up by, once what limits its speed has let it
    double contact = 0.0;  // the lift with which the sole is on the ground
    glm::dvec3 slip{0.0};  // what the ankle is moved by seen from above
};

/// Locks the foot or lets it go, and eases what a lock has moved it by.
void update_lock(FootState& foot, const FootClip& clip, const FootContext& context) noexcept;

/// Asks the ground, turns the foot by it; sets foot.alone where there is none to stand on.
FootGoal find_goal(FootState& foot, const FootClip& clip, const FootContext& context) noexcept;

}  // namespace tendril::humanoid::detail
