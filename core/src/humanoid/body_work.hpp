// A body made ready for solves, and what a solve needs. Not installed.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "humanoid/anatomy.hpp"
#include "ik/limits/joint.hpp"
#include "tendril/humanoid/body.hpp"
#include "tendril/humanoid/twist.hpp"

namespace tendril::humanoid {

namespace detail {

/// A bone that turns. Rotations are from the T-pose, so that at rest in it they are all 1.
struct Link {
    Bone bone;
    std::size_t node;
    int parent;                      ///< a link; -1: the hips
    double mobility;                 ///< 1: turns as readily as an upper arm
    unsigned effectors;              ///< a bit for each that its turn moves
    glm::dquat rest;                 ///< of the node in the T-pose
    glm::dvec3 hinge;                ///< the axis, unit; zero: a ball
    ik::detail::LimitedJoint given;  ///< its limit
    ik::detail::LimitedJoint limit;  ///< that reaches as far as the clip does

    // of the clip's pose
    glm::dvec3 offset;  ///< from the link before, in its frame
    glm::dquat start;   ///< rotation
    glm::dquat own;     ///< the same in the frame of the link before
    // of the pose that is sought
    glm::dquat turn;  ///< rotation in the frame of the link before
    glm::dquat rotation;
    glm::dvec3 position;
};

/// An arm or a leg. Near its full length a bend by an angle makes it shorter by that angle's square, so that
/// it bends infinitely fast where a target comes nearer evenly. A solve takes it for shorter by
/// `beyond(angle)` than it is: then it grows shorter evenly from the start on.
struct BodyLimb {
    int upper = -1, lower = -1, end = -1;  ///< links
    glm::dvec3 axis{0.0};                  ///< about which it bends, in the frame of the upper link
    double square = 0.0;                   ///< metres that it is shorter for a square radian
    double even = 0.0;                     ///< metres for a radian, where it is all but straight
    double start = 0.0;                    ///< beyond() of the clip's pose
    // now
    double bend = 0.0;                  ///< radians
    glm::dvec3 along{0.0}, about{0.0};  ///< from the upper link to the end; the axis in the character's space

    double beyond(double angle) const noexcept {
        const double value = angle * (even - square * angle);
        return angle > 0.0 && value > 0.0 ? value : 0.0;
    }
    double slope(double angle) const noexcept {
        return angle >= 0.0 && square * angle < even ? even - 2.0 * square * angle : 0.0;
    }
};

/// What hangs farthest from a bone that no other bone hangs on: a finger's end, the top of the head.
struct Tip {
    int link;
    glm::dvec3 at;  ///< from the link, in its frame; metres
};

/// A capsule on a link. Points are from the link, in its frame, as the clip scales it.
struct Volume {
    BodyCapsule capsule;
    int link;
    unsigned moved_by;  ///< a bit for each link whose turn moves it
    glm::dvec3 from{0.0}, to{0.0};
};
/// Two that are kept apart, by their radii or as they are at rest, where that is less.
struct Pair {
    std::size_t first, second;
    double apart;  ///< metres, from line to line
};

inline constexpr std::size_t max_contacts = 12;
inline constexpr std::size_t max_rows = 3 * effector_count + max_contacts;

}  // namespace detail

struct Body::Work {
    BodyJoints joints;
    std::vector<std::int32_t> parents;  ///< of all nodes
    std::vector<std::size_t> needed;    ///< nodes on the way to a bone, each after its parent
    std::vector<Bone> bones;
    std::vector<detail::Link> links;
    std::vector<detail::BodyLimb> limbs;
    std::vector<detail::Tip> tips;
    std::vector<detail::Volume> volumes;
    std::vector<detail::Pair> pairs;
    std::array<int, effector_count> ends{};
    TwistNodes twist;

    std::vector<Placement> placements;  ///< of all nodes; those that are needed are right
    std::vector<glm::dquat> kept;       ///< turns before a step
    glm::dvec3 kept_shift{0.0};
    std::vector<glm::dvec3> first;  ///< where the links were when the solve began

    /// And the pairs of them that are kept apart. Refuses a capsule of a bone that is not there, and numbers.
    Result add_volumes(std::span<const rig::Transform> rest, std::span<const BodyCapsule> capsules);
    void place_needed(std::span<const rig::Transform> pose) noexcept;
    /// Links as the clip has them.
    void take(std::span<const rig::Transform> pose) noexcept;
    /// The pose's rotations as the links have them.
    void give(std::span<rig::Transform> pose, const glm::dvec3& shift) const noexcept;
    glm::dvec3 place_of(const detail::Tip& tip) const noexcept;
    /// Where the links are for their turns.
    void place_links(const glm::dvec3& shift) noexcept;
};

}  // namespace tendril::humanoid
