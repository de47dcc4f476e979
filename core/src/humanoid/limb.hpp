// Closed-form IK of two bones: a leg or an arm, with any nodes between its joints. Not installed.
//
// A limb is the path from the root node down to the limb's end. Only the rotations of its upper, lower and
// end node change; nodes between them (twist bones, pivots) move along.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "rig/math.hpp"
#include "tendril/humanoid/skeleton.hpp"

namespace tendril::humanoid::detail {

using Pose = std::span<rig::Transform>;

struct Limb {
    std::vector<std::int32_t> path{};                     // nodes, each the parent of the next
    std::size_t upper = 0, lower = 0, end = 0, tail = 0;  // indices into the path; the tail is its last

    /// Makes the limb from the root to `tail`, through the others. nullopt unless each is below the previous
    /// one; only `end` and `tail` may be the same node.
    static std::optional<Limb> make(const Skeleton& skeleton, std::int32_t upper, std::int32_t lower,
                                    std::int32_t end, std::int32_t tail);
    std::size_t node(std::size_t place) const noexcept { return static_cast<std::size_t>(path[place]); }
};

/// Placements of a limb's nodes, and of the parents of the three that turn.
struct LimbPlacement {
    Placement above_upper, upper, above_lower, lower, above_end, end, tail;

    void move(const glm::dvec3& by) noexcept;
    double upper_length() const noexcept;
    double lower_length() const noexcept;
    bool is_finite() const noexcept;
};
LimbPlacement place(const Limb& limb, const Placement& root, Pose pose) noexcept;
/// Updates everything below `above_upper`.
void place_below(const Limb& limb, LimbPlacement& at, Pose pose) noexcept;

/// True if all numbers are at most 1e12.
bool is_moderate(const Placement& placement) noexcept;

/// `vector` in the local space of `at`: multiplied by the inverse of at.axes; 0 if their volume is
/// not from 1e-200 to 1e200.
glm::dvec3 to_local(const Placement& at, const glm::dvec3& vector) noexcept;

/// Changes a node's local rotation so that the node turns by `turn` in the outer space.
void turn(rig::Transform& local, const Placement& above, const glm::dquat& turn) noexcept;

/// The distances from root to end that a limb may have.
struct Reach {
    double shortest, longest;
};
Reach reach_of(const LimbPlacement& at, double straightest) noexcept;

/// The new positions of middle joint and end, and the turns of the two bones.
struct Bend {
    glm::dvec3 mid, end;
    glm::dquat upper, lower;
};
/// The side to which a straight limb bends.
struct Pole {
    glm::dvec3 direction;  // unit length
    double part;  // offset of the joint, in limb lengths, at which its own side weighs as much as the pole
    bool always;  // the joint is never on the opposite side
};
/// Brings the limb's end to `target`, or as near as it can get. The middle joint keeps its side; the
/// straighter the limb, the stronger the pole.
Bend bend_to(const LimbPlacement& at, const glm::dvec3& target, const Pole& pole,
             double straightest) noexcept;
/// Applies the bend to the pose, and turns the end by `end_turn` relative to how it was. Updates `at`.
void apply(const Bend& bend, const glm::dquat& end_turn, const Limb& limb, LimbPlacement& at,
           Pose pose) noexcept;

}  // namespace tendril::humanoid::detail
