// Look-at: spine, neck and head turned so that the head looks at a target.
//
//     Expected<LookAt> look = LookAt::make(skeleton, map);
//     LookAtState state;                                       // a value: save it, put it back
//     ... each frame, after sample(), the feet and the body:
//     const LookAtReport report = look->step(pose, {.target = ball}, dt, state);
//
// Each bone from the spine up takes its part of the way that is left by rig::aim(), within its limit; what is
// left then is the head's. The clip's own movement stays below that: a weight of 0 gives it back to the bit.
// A target outside of the cone of view eases off and on again by a critically damped spring, and the gaze
// goes from one target to another no faster than `max_speed`.
//
// Cost: some 6 µs a step. Nothing is allocated.
#pragma once

#include <memory>

#include "tendril/humanoid/bone_map.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::humanoid {

/// Metres, radians, seconds.
struct LookAtOptions {
    glm::dvec3 target{0.0};  ///< in the space of `root`
    double weight = 1.0;     ///< 0 to 1
    rig::Transform root{};   ///< where the character stands, as FeetOptions::root

    double spine_part = 0.2;    ///< of the way, by the mapped bones from Spine to UpperChest together; 0 to 1
    double neck_part = 0.3;     ///< of the way, by the neck; 0 to 1, with spine_part at most 1
    double spine_limit = 0.35;  ///< that those bones turn by at most against the clip, together; 0 to 3.15
    double neck_limit = 0.5;
    double head_limit = 0.9;

    double view = 1.9;       ///< half the cone's angle about where the clip looks; 0 to 3.15
    double half_life = 0.1;  ///< in which a target comes into view and out of it; over 0, to 10
    double max_speed = 8.0;  ///< radians a second; over 0, to 1e3
};
/// Names the member that is out of its range.
Result check(const LookAtOptions& options) noexcept;

struct LookAtState {
    bool in_view = false;
    signal::SpringState<double> view{};  ///< 0 to 1, how much of the weight is left by it
    glm::dvec3 gaze{
        0.0};  ///< where it is to look, of length 1, in the space of the root; 0 before the first step
    bool operator==(const LookAtState&) const = default;
};

struct LookAtReport {
    /// False: a pose or options that are not finite or out of their ranges; nothing has changed.
    bool valid = true;
    double weight = 0.0;  ///< that was applied
    bool in_view = false;
    double left = 0.0;  ///< radians between where the head looks and the target
};

/// Made once for a character, then only read.
class LookAt {
  public:
    /// Refuses a map that is not usable, and a head that is not above the spine.
    static Expected<LookAt> make(const Skeleton& skeleton, const BoneMap& map);
    ~LookAt();
    LookAt(LookAt&&) noexcept;
    LookAt& operator=(LookAt&&) noexcept;

    /// `pose` is corrected in place: local transforms of all nodes. A dt that is not over 0 lets no time
    /// pass. The first step looks there at once.
    LookAtReport step(std::span<rig::Transform> pose, const LookAtOptions& options, double dt,
                      LookAtState& state) const noexcept;

  private:
    struct Plan;
    explicit LookAt(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid
