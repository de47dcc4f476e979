// Hand IK: moves the hands of an animation to targets, blended by a weight.
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
// solved in closed form. The elbow stays on the side where the clip has it. Under a weight of 0.01 the hand
// is off and the pose stays bit-identical; larger weights are rescaled to start from there, so nothing jumps.
// When a target leaves or enters the cone of view, a critically damped spring eases the hand off or on.
//
// A target moves only its own arm, and the shoulder (if mapped) as far as needed when the arm is too short.
// It never moves the other hand.
//
// Cost: about 2 µs per hand and step. Allocates nothing.
#pragma once

#include <array>
#include <memory>

#include "tendril/humanoid/bone_map.hpp"
#include "tendril/signal/curve.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::humanoid {

struct HandTarget {
    glm::dvec3 position{0.0};  ///< position of the hand's joint, in the space of `root`
    /// Rotation of the hand's node, in that space; unset: the hand turns with the forearm.
    std::optional<glm::dquat> rotation{};
    double weight = 0.0;  ///< clamped to 0 to 1
};
using HandTargets = std::array<HandTarget, 2>;  ///< left, right

/// Radians, seconds.
struct HandsOptions {
    rig::Transform root{};  ///< where the character stands, as FeetOptions::root
    /// Half-angle of the head's view cone, by default 115 degrees; 0 to pi, which sees everything.
    double view = 2.007128639793479;
    double half_life = 0.1;  ///< for easing when a target enters or leaves the view; 1e-6 to 10
    double shoulder = 0.5;   ///< maximum turn of a shoulder; 0 to 1.48 (85 degrees)
    bool operator==(const HandsOptions&) const = default;
};
/// Names the member that is out of range.
Result check(const HandsOptions& options) noexcept;

struct HandState {
    bool in_view = false;
    signal::SpringState<double> view{};  ///< 0 to 1, a factor of the weight
    bool operator==(const HandState&) const = default;
};
struct HandsState {
    std::array<HandState, 2> hands{};  ///< left, right
    bool operator==(const HandsState&) const = default;
};

struct HandReport {
    double weight = 0.0;  ///< applied; 0: the hand is off
    bool in_view = false;
    double residual = 0.0;     ///< metres from the hand to its target
    glm::dvec3 position{0.0};  ///< position of the hand
};
struct HandsReport {
    std::array<HandReport, 2> hands{};  ///< left, right
    Result accepted{};                  ///< why nothing has changed: a pose, a target or options out of range
};

/// 0 until `begin`, 1 from `full` to `until`, 0 from `end` on, smooth between; seconds, in ascending order.
/// For evaluate_keys().
Expected<signal::Curve> weight_curve(double begin, double full, double until, double end);

/// Made once per character, then immutable.
class Hands {
  public:
    /// Refuses an unusable map, what find_soles() refuses, and an arm that is not a chain, has no length or
    /// has the other hand on it.
    static Expected<Hands> make(const Skeleton& skeleton, const BoneMap& map);
    ~Hands();
    Hands(Hands&&) noexcept;
    Hands& operator=(Hands&&) noexcept;

    /// `pose` holds the local transforms of all nodes and is corrected in place. If dt is not over 0, no time
    /// passes. On the first step a target in view counts fully at once.
    HandsReport step(std::span<rig::Transform> pose, const HandTargets& targets, double dt, HandsState& state,
                     const HandsOptions& options = {}) const noexcept;

  private:
    struct Plan;
    explicit Hands(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::HandsOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::HandState>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::HandsState>() noexcept;
