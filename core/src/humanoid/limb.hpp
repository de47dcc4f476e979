// Two bones of a skeleton solved in closed form: a leg or an arm, whatever stands between its joints. Not
// installed.
//
// A limb is the way from the node that hangs on nothing down to the limb's end. Only rotations of its upper,
// lower and end node are changed; nodes between them (twist bones, pivots) move along.
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
    std::size_t upper = 0, lower = 0, end = 0, tail = 0;  // places in it; the tail is what the path ends with

    /// From the root to `tail`, through the others; none where they do not hang on each other in that order,
    /// or two of the first three are one.
    static std::optional<Limb> make(const Skeleton& skeleton, std::int32_t upper, std::int32_t lower,
                                    std::int32_t end, std::int32_t tail);
    std::size_t node(std::size_t place) const noexcept { return static_cast<std::size_t>(path[place]); }
};

/// Where the nodes of a limb are, and what each of the three that turn hangs on.
struct LimbPlacement {
    Placement above_upper, upper, above_lower, lower, above_end, end, tail;

    void move(const glm::dvec3& by) noexcept;
    double upper_length() const noexcept;
    double lower_length() const noexcept;
    bool is_finite() const noexcept;
};
LimbPlacement place(const Limb& limb, const Placement& root, Pose pose) noexcept;
/// From `above_upper` on.
void place_below(const Limb& limb, LimbPlacement& at, Pose pose) noexcept;

/// Nothing beyond 1e12.
bool is_moderate(const Placement& placement) noexcept;

/// The vector that `at.axes` takes to `vector`; 0 where they have no volume.
glm::dvec3 seen_from(const Placement& at, const glm::dvec3& vector) noexcept;

/// The node's local rotation such that in space it is turned by `turn`.
void turn(rig::Transform& local, const Placement& above, const glm::dquat& turn) noexcept;

/// How near to its full length a limb may come, and how near to folded up.
struct Reach {
    double shortest, longest;
};
Reach reach_of(const LimbPlacement& at, double straightest) noexcept;

/// Where joints go, and by what the bones turn.
struct Bend {
    glm::dvec3 mid, end;
    glm::dquat upper, lower;
};
/// Where the middle joint of a limb that is straight goes.
struct Pole {
    glm::dvec3 direction;  // of length 1
    double part;  // of the limb's length that the joint has to stand aside for its own side to count as much
    bool always;  // the joint is never on the other side
};
/// The limb's end at `target`, or as near to it as it may come. The middle joint keeps to the side that it is
/// bent to; the straighter the limb, the more it goes by the pole.
Bend bend_to(const LimbPlacement& at, const glm::dvec3& target, const Pole& pole,
             double straightest) noexcept;
/// Takes that into the pose, and turns the end by `end_turn` against how it was. `at` is where the limb is
/// before, and becomes where it is after.
void apply(const Bend& bend, const glm::dquat& end_turn, const Limb& limb, LimbPlacement& at,
           Pose pose) noexcept;

}  // namespace tendril::humanoid::detail
