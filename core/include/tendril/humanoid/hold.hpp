// Hands that hold one object: a wheel, a rifle, a box.
//
//     const std::vector<Grip> grips{{Effector::LeftHand, {0.2, 0, 0}}, {Effector::RightHand, {-0.2, 0, 0}}};
//     HoldState state;  // a value, kept from frame to frame, beside the body's
//     sample(clip, skeleton, seconds, pose);
//     const auto report = hold(*body, pose, {}, {.grips = grips, .asked = wheel}, body_state, state);
//     draw(report->object);  // where the hands hold it
//
// The grips close first: each hand is on its grip, turned as the grip says, within the limits of the arm's
// joints. The object follows the requested pose only as far as that allows. If the arms cannot follow, it
// moves to a nearby pose that the hands can hold with the trunk where it is: the nearest if no joint is at
// its limit. The report says by how much, which arm is straight and which joint is at its limit. If no pose
// closes the grips (an object longer than both arms, a joint at its limit), the hands share the remaining
// error.
//
// Method: Body::solve() reaches for the grips with hips and trunk. Then the arms and the object are solved
// together, with the trunk where it is: sequential quadratic programming, in which the grips are equality
// constraints, kept by the proximal method of multipliers (R. T. Rockafellar, "Augmented Lagrangians and
// applications of the proximal point algorithm in convex programming", Mathematics of Operations Research
// 1(2), 1976). A joint at its limit loses the direction that leads out of it (active set). As in the body's
// solve, an arm counts as straight 0.08 % before its full length, so that the elbow does not snap.
//
// Self-collision and balance act while the body reaches; closing the grips then moves the arms without them.
//
// The lower arm takes its share of the hand's twist (BodyOptions::twist_share), counted from -180 to 180
// degrees from rest. A hand without a limit that turns past 180 degrees jumps to -180, and its lower arm with
// it; HoldReport::jumped does not detect that, since no joint moves.
//
// Cost: under 4 times Body::solve() with the same targets, under 6 if the object leaves the requested pose in
// every frame (tests/bench/humanoid_body.cpp).
#pragma once

#include "tendril/humanoid/body.hpp"

namespace tendril::humanoid {

/// A hand's grip on an object, in the object's frame.
struct Grip {
    Effector hand = Effector::LeftHand;  ///< LeftHand or RightHand
    glm::dvec3 position{0.0};            ///< the hand's joint, metres
    /// Rotation of the hand's node. Unset: the hand turns with the forearm.
    std::optional<glm::dquat> rotation{};
    /// Axis about which the hand may turn in its grip, as around a bar. None if at most 1e-9 long.
    glm::dvec3 axis{0.0};
    bool operator==(const Grip&) const = default;
};

/// A palm on an object, in the object's frame. Directions are longer than 1e-9.
struct Palm {
    Effector hand = Effector::LeftHand;
    glm::dvec3 middle{0.0};             ///< middle of the palm, metres
    glm::dvec3 fingers{0.0, 0.0, 1.0};  ///< direction of the fingers
    glm::dvec3 faces{0.0, -1.0, 0.0};   ///< direction the palm faces; only its part across the fingers counts
    glm::dvec3 axis{0.0};               ///< Grip::axis
};
/// `reach`: metres from the hand's joint to the middle of its palm. Refuses an effector that is not a hand,
/// and directions that are too short, parallel (to 1e-6 radians) or not finite. In the T-pose, the body's
/// palms face down.
Expected<Grip> grip_of(const Body& body, const Palm& palm, double reach);

/// An object's pose, in the character's space.
struct ObjectPose {
    glm::dvec3 position{0.0};                 ///< metres
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit
    bool operator==(const ObjectPose&) const = default;
};

struct HeldObject {
    std::span<const Grip> grips{};  ///< one or two, of different hands
    ObjectPose asked{};
};

struct HoldOptions {
    BodyOptions body{};
    /// Turning the object by a radian counts as much as moving it this far: metres, 0.05 to 1e3. Unset: a
    /// sixth of the figure's height, 0.3 m for 1.8 m.
    std::optional<double> turn_length{};
    int max_iterations = 80;  ///< 1 to 1000; up to 20 more close the grips if it has not settled
};

/// The end of the last solve, to detect jumps. Empty before the first.
struct HoldState {
    /// The requested grip position of each hand that held; left, right.
    std::array<std::optional<glm::dvec3>, 2> grips{};
    std::array<glm::dvec3, 2> shoulders{};  ///< joints of the upper arms
    std::array<glm::dvec3, 2> elbows{}, hands{};
    bool operator==(const HoldState&) const = default;
};

struct GripReport {
    bool holds = false;     ///< this hand has a grip
    double gap = 0.0;       ///< from the hand's joint to the grip, metres; at most 1e-5 if closed
    double off = 0.0;       ///< from the hand's rotation to the grip's, radians; at most 5e-4 if closed
    bool straight = false;  ///< the arm is at full length, and the object pulls it farther
};

struct HoldReport {
    BodyReport body{};    ///< the reach; `at_limit` has the arms' joints as they hold the object
    ObjectPose object{};  ///< where the object is held
    double moved = 0.0;   ///< metres from the requested position
    double turned = 0.0;  ///< radians from the requested rotation
    std::array<GripReport, 2> grips{};  ///< left, right
    int iterations = 0;
    bool settled = true;  ///< false: max_iterations stopped it, or it found no finite pose
    /// An elbow or hand moved over 20 times as far as the requested grips and the shoulders. Each hand is
    /// judged from its second frame on.
    bool jumped = false;
    /// Every gap and turn is closed, to 1e-5 m and 5e-4 radians.
    bool closed() const noexcept;
};

/// `pose`, `targets` and `body_state` as in Body::solve(); a hand that holds must have no target. Refuses
/// what Body::solve() refuses, no grip, more than two, two of one hand, one of an effector that is not a
/// hand, and numbers that are not finite or out of range; then nothing changes. Allocates nothing once
/// `body_state` has been used.
Expected<HoldReport> hold(Body& body, std::span<rig::Transform> pose, std::span<const BodyTarget> targets,
                          const HeldObject& object, BodyState& body_state, HoldState& state,
                          const HoldOptions& options = {});

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::HoldOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::HoldState>() noexcept;
