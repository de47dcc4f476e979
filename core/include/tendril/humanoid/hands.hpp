// Hand IK: the hands of an animation brought to targets, as much as a weight says.
//
//     Expected<Hands> hands = Hands::make(skeleton, map);
//     const signal::Curve hook = weight_curve(0.3, 0.55, 0.6, 0.8);        // over the clip's time
//     HandsState state;                                                    // a value: save it, put it back
//     ... each frame, after sample() and the feet:
//     HandTargets targets;
//     targets[1] = {.position = post, .weight = signal::evaluate_keys(hook, clip_time)};
//     const HandsReport report = hands->step(pose, targets, dt, state);
//
// The weight blends position and rotation of the hand from the animation to the target; the arm is then
// solved in closed form for that. Its elbow stays on the side where the clip has it. Under 0.01 the hand is
// off, and the pose comes back to the bit; what is left of the weight counts from there, so nothing jumps. A
// target outside of the cone of view eases off and on again by a critically damped spring.
//
// Only the arm moves, and, where it is too short and the map has a shoulder, that as far as it must: one
// hand's target never moves the other hand, nor anything but its own arm.
//
// Cost: some 2 µs a hand and step. Nothing is allocated.
#pragma once

#include <array>
#include <memory>

#include "tendril/humanoid/bone_map.hpp"
#include "tendril/signal/curve.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::humanoid {

struct HandTarget {
    glm::dvec3 position{0.0};  ///< of the hand's joint, in the space of `root`
    /// Of the hand's node, in that space; left out, the hand goes along with the forearm.
    std::optional<glm::dquat> rotation{};
    double weight = 0.0;  ///< what is not from 0 to 1 is clamped
};
using HandTargets = std::array<HandTarget, 2>;  ///< left, right

/// Radians, seconds.
struct HandsOptions {
    rig::Transform root{};  ///< where the character stands, as FeetOptions::root
    double view = 2.0;  ///< half the cone's angle about where the head looks; 0 to 3.15: everything is seen
    double half_life = 0.1;  ///< in which a target comes into view and out of it; over 0, to 10
    double shoulder = 0.5;   ///< a shoulder turns by at most this; 0 to 1.5
};
/// Names the member that is out of its range.
Result check(const HandsOptions& options) noexcept;

struct HandState {
    bool in_view = false;
    signal::SpringState<double> view{};  ///< 0 to 1, how much of the weight is left by it
    bool operator==(const HandState&) const = default;
};
struct HandsState {
    std::array<HandState, 2> hands{};  ///< left, right
    bool operator==(const HandsState&) const = default;
};

struct HandReport {
    double weight = 0.0;  ///< that was applied, 0 where the hand is off
    bool in_view = false;
    double residual = 0.0;     ///< metres from the hand to its target
    glm::dvec3 position{0.0};  ///< of the hand
};
struct HandsReport {
    /// False: a pose, a target or options that are not finite or out of their ranges; nothing has changed.
    bool valid = true;
    std::array<HandReport, 2> hands{};  ///< left, right
};

/// 0 until `begin`, 1 from `full` to `until`, 0 from `end` on, smooth between; seconds, each at least the one
/// before it. For evaluate_keys().
Expected<signal::Curve> weight_curve(double begin, double full, double until, double end);

/// Made once for a character, then only read.
class Hands {
  public:
    /// Refuses a map that is not usable, arms that are no chain, or that have both hands on one, or no
    /// length.
    static Expected<Hands> make(const Skeleton& skeleton, const BoneMap& map);
    ~Hands();
    Hands(Hands&&) noexcept;
    Hands& operator=(Hands&&) noexcept;

    /// `pose` is corrected in place: local transforms of all nodes. A dt that is not over 0 lets no time
    /// pass. The first step starts with what is in view.
    HandsReport step(std::span<rig::Transform> pose, const HandTargets& targets, double dt, HandsState& state,
                     const HandsOptions& options = {}) const noexcept;

  private:
    struct Plan;
    explicit Hands(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid
