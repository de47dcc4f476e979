// Look-at: turns spine, neck and head so that the head looks at a target.
//
//     Expected<LookAt> look = LookAt::make(skeleton, map);
//     LookAtState state;                                       // a value: save it, put it back
//     ... each frame, after sample(), the feet and the body:
//     const LookAtReport report = look->step(pose, {.target = ball}, dt, state);
//
// Each bone from the spine up takes its share of the turn by rig::aim(), within its limit; the head takes the
// rest. The turns are added to the clip's own movement: with a weight of 0 the pose stays bit-identical. When
// a target leaves or enters the cone of view, a critically damped spring eases the gaze off or on. The gaze
// moves from one target to another no faster than `max_speed`.
//
// Cost: about 6 µs per step. Allocates nothing.
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

    double spine_part = 0.2;    ///< share of the turn taken by the bones from Spine to UpperChest; 0 to 1
    double neck_part = 0.3;     ///< share of the turn taken by the neck; 0 to 1; with spine_part at most 1
    double spine_limit = 0.35;  ///< maximum turn of those spine bones together; 0 to pi
    double neck_limit = 0.5;
    double head_limit = 0.9;

    /// Half-angle of the view cone about the clip's gaze, by default 108 degrees; 0 to pi. If a target comes
    /// back into view on the other side during the ease, the gaze moves to it through the clip's gaze.
    double view = 1.8849555921538759;
    double half_life = 0.1;  ///< for easing when a target enters or leaves the view; 1e-6 to 10
    double max_speed = 8.0;  ///< radians per second; 1e-6 to 1e3
    bool operator==(const LookAtOptions&) const = default;
};
/// Names the member that is out of range.
Result check(const LookAtOptions& options) noexcept;

struct LookAtState {
    bool in_view = false;
    signal::SpringState<double> view{};  ///< 0 to 1, a factor of the weight
    glm::dvec3 gaze{0.0};  ///< unit direction to look in, in the space of `root`; 0 before the first step
    bool operator==(const LookAtState&) const = default;
};

struct LookAtReport {
    double weight = 0.0;  ///< applied
    bool in_view = false;
    double left = 0.0;  ///< radians between the head's gaze and the target
    Result accepted{};  ///< why nothing has changed: a pose or options out of range
};

/// Made once per character, then immutable.
class LookAt {
  public:
    /// Refuses an unusable map, what find_soles() refuses, and a head that is not above the spine.
    static Expected<LookAt> make(const Skeleton& skeleton, const BoneMap& map);
    ~LookAt();
    LookAt(LookAt&&) noexcept;
    LookAt& operator=(LookAt&&) noexcept;

    /// `pose` holds the local transforms of all nodes and is corrected in place. If dt is not over 0, no time
    /// passes. The first step looks at the target at once.
    LookAtReport step(std::span<rig::Transform> pose, const LookAtOptions& options, double dt,
                      LookAtState& state) const noexcept;

  private:
    struct Plan;
    explicit LookAt(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::LookAtOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::LookAtState>() noexcept;
