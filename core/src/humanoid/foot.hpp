// One foot's part of a step: its lock, the ground below it, and its goal. Not installed.
#pragma once

#include <array>
#include <optional>

#include "rig/math.hpp"
#include "tendril/humanoid/feet.hpp"

namespace tendril::humanoid::detail {

/// Shared by both feet of a step.
struct FootContext {
    const Ground& ground;
    const FeetOptions& options;
    double dt;        // seconds; 0: no time passes
    bool first_step;  // the first step: nothing eases
    double floor;     // height of the clip's floor, in the ground's space
    double base;      // lift of the root
    double decay;     // factor by which offsets decay in this step
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
    double rise = 0.0;     // rise of the plane below the foot, along its path in this step
    glm::dvec3 slip{0.0};  // horizontal
    double shifted = 0.0;  // horizontal move in this step, relative to the clip
};

/// Locks or releases the foot, and moves the offset of a foot in the air towards its foothold. Returns the
/// move.
glm::dvec3 update_lock(FootState& foot, const FootClip& clip, const FootContext& context) noexcept;

/// Queries the ground and turns the foot by it; sets foot.alone if there is no ground to stand on.
FootGoal find_goal(FootState& foot, const FootClip& clip, const glm::dvec3& eased,
                   const FootContext& context) noexcept;

// Footholds: positions with the whole sole on the ground (foothold.cpp).

/// Height differences up to this do not count as a step, metres.
inline constexpr double step_over_plane = 0.02;

inline double height_of_plane(const GroundHit& hit, double x, double z) noexcept {
    return hit.height - (hit.normal.x * x + hit.normal.z * z) / hit.normal.y;
}

/// The reason why a foot cannot stand on the result of a ray; No if it can.
FootAlone check_ground(const std::optional<GroundHit>& hit, const FootContext& context) noexcept;

/// The horizontal shift of the sole from its position in the clip to one where it can stand: with ground and
/// no step below all of it or, if treads are too short for that, with one end over the edge of the highest. 0
/// if it already stands like that, or cannot within reach. The shortest shift wins, but one near `before` is
/// preferred.
glm::dvec3 find_foothold(const glm::dvec3& heel, const glm::dvec3& toe, double from, const glm::dvec3& before,
                         const FootContext& context) noexcept;

// Lift of a foot in the air over the ground along its path (swing.cpp).

/// A sole in the air, in the ground's space, and its path in this step.
struct SwingSole {
    std::array<glm::dvec3, 3> points;  // heel, ball, toe, as high as they are now
    glm::dvec3 moved;                  // horizontal move in this step, up to `points`
    glm::dvec3 velocity, before;       // the clip's, in this step and the one before, m/s
    double remaining = 1e9;            // remaining distance, if it is about to land
};

struct Clearance {
    /// Distance that the sole must rise now to have each point above the ground when it gets there, rising at
    /// a steady speed: the upper envelope of the ground ahead. Negative if it is high enough.
    double raise = -1e300;
    /// The fraction of `moved` after which the foot can still rise in time for the next edge.
    double part = 1.0;
};

/// Both members change continuously as the foot moves.
Clearance find_clearance(const SwingSole& sole, double from, const FootContext& context) noexcept;

}  // namespace tendril::humanoid::detail
