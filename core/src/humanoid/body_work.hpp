// A body's precomputed data, and the scratch of its solves. Not installed.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "humanoid/anatomy.hpp"
#include "ik/limits/joint.hpp"
#include "tendril/humanoid/balance.hpp"
#include "tendril/humanoid/body.hpp"
#include "tendril/humanoid/twist.hpp"

namespace tendril::humanoid {

namespace detail {

/// A bone that turns. Rotations are relative to the T-pose, where they are all the identity.
struct Link {
    Bone bone;
    std::size_t node;
    int parent;                           ///< a link; -1 for the hips
    double mobility;                      ///< 1 for an upper arm
    unsigned effectors;                   ///< a bit for each effector that its turn moves
    glm::dquat rest;                      ///< the node's rotation in the T-pose
    glm::dvec3 hinge;                     ///< unit axis; zero: no hinge
    ik::detail::LimitedJoint base_limit;  ///< its limit
    ik::detail::LimitedJoint limit;       ///< the same, widened to the clip's pose

    // in the clip's pose
    glm::dvec3 offset;     ///< from the parent link, in its frame
    glm::dquat start;      ///< rotation
    glm::dquat clip_turn;  ///< rotation in the parent link's frame
    // in the pose being solved
    glm::dquat turn;  ///< rotation in the parent link's frame
    glm::dquat rotation;
    glm::dvec3 position;
};

/// An arm or a leg. Near full length, bending it shortens it by the square of the angle, so it would bend
/// infinitely fast to follow a target that approaches at constant speed. A solve treats it as shorter by
/// `shortening(angle)`, so that it shortens linearly from the start.
struct BodyLimb {
    int upper = -1, lower = -1, end = -1;  ///< links
    glm::dvec3 axis{0.0};                  ///< axis of the bend, in the upper link's frame
    double quadratic = 0.0;                ///< shortening, metres per square radian
    double linear = 0.0;                   ///< the linear shortening near straight, metres per radian
    double start = 0.0;                    ///< shortening() of the clip's pose
    // in the pose being solved
    double bend = 0.0;                  ///< radians
    glm::dvec3 along{0.0}, about{0.0};  ///< unit, from the upper link to the end; axis in character space

    double shortening(double angle) const noexcept {
        const double value = angle * (linear - quadratic * angle);
        return angle > 0.0 && value > 0.0 ? value : 0.0;
    }
    /// Rounding may bend a straight limb slightly backwards; that counts as straight.
    double slope(double angle) const noexcept {
        constexpr double straight_turn = 1e-9;  // radians
        return angle > -straight_turn && quadratic * angle < linear ? linear - 2.0 * quadratic * angle : 0.0;
    }
};

/// The node farthest from the joint of a bone without children: a fingertip, the top of the head.
struct Tip {
    int link;
    glm::dvec3 at;  ///< from the link, in its frame; metres
};

/// A capsule on a link. Its points are relative to the link, in its frame, with the clip's scale.
struct Volume {
    BodyCapsule capsule;
    int link;
    unsigned moved_by;  ///< a bit for each link whose turn moves it
    glm::dvec3 from{0.0}, to{0.0};
};
/// Two capsules that are kept apart, by the sum of their radii or, if less, by their distance at rest.
struct Pair {
    std::size_t first, second;
    double min_distance;  ///< metres, between their axes
};

/// A mass point on a link, also relative to the link, in its frame, with the clip's scale.
struct LinkMass {
    MassPoint point;
    int link;
    glm::dvec3 at{0.0};
};

inline constexpr std::size_t max_contacts = 12;
inline constexpr std::size_t max_rows = 3 * effector_count + 1 + max_contacts;  ///< one for balance

}  // namespace detail

struct Body::Work {
    BodyJoints joints;
    std::vector<std::int32_t> parents;  ///< parent of each node
    std::vector<std::size_t> needed;    ///< mapped bones and all nodes above them, parents first
    std::vector<Bone> bones;
    double size = 1.0;  ///< detail::size_of()
    std::vector<detail::Link> links;
    std::vector<detail::BodyLimb> limbs;
    std::vector<detail::Tip> tips;
    std::vector<detail::Volume> volumes;
    std::vector<detail::Pair> pairs;
    std::vector<detail::LinkMass> masses;  ///< empty without soles
    std::optional<Soles> soles;
    std::array<int, effector_count> ends{};
    TwistNodes twist;

    std::vector<Placement> placements;    ///< for all nodes; only those in `needed` are current
    std::vector<glm::dquat> saved_turns;  ///< turns before a step
    glm::dvec3 saved_shift{0.0};
    std::vector<glm::dvec3> first;  ///< positions of links, then tips, at the start of the solve

    /// Adds the capsules and the pairs to keep apart. Refuses an unmapped bone and numbers out of range.
    Result add_volumes(std::span<const rig::Transform> rest, std::span<const BodyCapsule> capsules);
    void place_needed(std::span<const rig::Transform> pose) noexcept;
    /// Reads the links, volumes and limbs from the clip's pose.
    void read_pose(std::span<const rig::Transform> pose) noexcept;
    /// Writes the links' rotations, and the hips' shift, to the pose.
    void write_pose(std::span<rig::Transform> pose, const glm::dvec3& shift) const noexcept;
    glm::dvec3 place_of(const detail::Tip& tip) const noexcept;
    /// Forward kinematics of the links' turns.
    void place_links(const glm::dvec3& shift) noexcept;
};

}  // namespace tendril::humanoid
