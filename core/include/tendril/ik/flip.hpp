// Finds flips and their causes: a bone turns far in one frame while its target hardly moves. Needs only joint
// positions, so it works for any solver in any engine.
//
// A bone's turn is explained if the target turned enough as seen from the root, or the pole target turned
// enough about the line from root to target. Otherwise it is a flip.
//
// Cost: O(joints). Nothing here throws; only copies of a pose allocate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// Flip: a bone turned by over `degrees` while target and pole target (in a rig, each moved control) turned
/// by less than `angle_share` of that about the root, or moved by less than `reach_share` of the reach.
struct FlipRule {
    float degrees = 30.0f;      ///< 1 to 180
    float angle_share = 0.2f;   ///< 0 to 1
    float reach_share = 0.02f;  ///< 0 to 1

    bool operator==(const FlipRule&) const = default;
};

/// Movement in one frame of an input that can turn bones: a target, a control, a weight.
struct InputMove {
    double distance = 0.0;  ///< metres, relative to the bone's root
    double angle = 0.0;     ///< radians, of its direction as seen from there, 0 to pi
    double turn = 0.0;      ///< radians, about itself
    double share = 0.0;     ///< change of a number, as a fraction of its range
};
/// Movement of a point; `from` and `to` are relative to the bone's root.
InputMove move_between(const glm::dvec3& from, const glm::dvec3& to) noexcept;
/// The rule itself, for chains, rigs and bodies: true if an input moved far enough to explain that a bone
/// turned by `radians`. `reach`: the chain's reach or the skeleton's size, metres.
bool explains(const InputMove& move, double radians, double reach, const FlipRule& rule = {}) noexcept;

/// A chain in one frame: at least one joint; all finite. Metres, or any other unit throughout.
struct ReachPose {
    std::vector<glm::vec3> joints{};  ///< root first
    std::optional<glm::vec3> target{};
    std::optional<glm::vec3> pole{};  ///< the pole target

    glm::vec3 root() const noexcept { return joints.front(); }
};

enum class FlipCause : std::uint8_t {
    TargetJump,   ///< the target jumped
    ThroughRoot,  ///< the target went through the root
    PassedPole,   ///< the line from root to target passed the pole target
    Straight,     ///< the chain was nearly straight, so no bend direction was preferred
    Folded,       ///< the same for a chain folded onto one line
    ClosePole,    ///< the line came close to the pole target
    PassedAxis,   ///< without a pole target: the line passed an axis of the space, see passed_axis()
    Rolled,       ///< the bone turned about itself, which positions do not show
    Unexplained   ///< nothing in the input explains it
};
/// For display, a clause: "the target's line passed the pole".
const char* text(FlipCause cause) noexcept;

/// The bone that turned furthest (the first, if several tie), given by its end that moved further: an arm's
/// elbow. Poses are compared relative to their roots.
struct BoneTurn {
    std::size_t joint = 0;
    float radians = 0.0f;
};
/// Both poses must have the same number of joints.
BoneTurn furthest_turn(const ReachPose& before, const ReachPose& after) noexcept;

/// The flip between two poses one frame apart, with equally many joints. A missing target counts as still.
std::optional<BoneTurn> find_flip(const ReachPose& before, const ReachPose& after,
                                  const FlipRule& rule = {}) noexcept;

/// The likely cause: the first that applies, in the order ThroughRoot, PassedPole, Straight or Folded,
/// ClosePole, Unexplained.
FlipCause flip_cause(const ReachPose& before, const ReachPose& after) noexcept;

// The individual tests.

/// Sum of the bones' lengths.
float reach_of(const ReachPose& pose) noexcept;
/// True if the target passed within a fiftieth of the reach of the root.
bool went_through_root(const ReachPose& before, const ReachPose& after) noexcept;

/// Passage of the line from root to target by the pole target, where the bend has no direction.
struct PolePassage {
    bool passed = false;  ///< the pole target changed sides
    bool close = false;   ///< in one of the poses the line is within 10 degrees of the pole target
};
PolePassage pole_passage(const ReachPose& before, const ReachPose& after) noexcept;

/// True if the line from root to target swept past an axis of the space (in either direction) while there was
/// no pole target. A solver that bends towards that axis, usually up, has no preferred side there.
/// flip_cause() never returns PassedAxis, because Tendril's solvers do not bend towards an axis.
bool passed_axis(const ReachPose& before, const ReachPose& after) noexcept;

/// The largest distance of a joint from the line through the first and the last. Needs at least one joint.
float bend_of(std::span<const glm::vec3> joints) noexcept;
/// True if the chain was nearly straight in either pose: bend_of() under a twentieth of the reach.
bool was_straight(const ReachPose& before, const ReachPose& after) noexcept;
/// The cause if was_straight(): Straight, or Folded if the tip was within half the reach of the root.
FlipCause collinear_cause(const ReachPose& before, const ReachPose& after) noexcept;

/// Radians, 0 to pi; 0 if either has no length.
float angle_between(glm::vec3 a, glm::vec3 b) noexcept;

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::FlipRule>() noexcept;
