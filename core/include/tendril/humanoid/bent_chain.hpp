// Bends a tail, a spine or a tentacle of a character along a curve.
//
//     const auto first = skeleton.find("tail_1"), last = skeleton.find("tail_8");
//     Expected<BentChain> tail = BentChain::make(skeleton, *first, *last);
//     std::vector<glm::vec3> points = tail->points_through(pose, 4);  // or your own
//     ... each frame, after the animation and before IK:
//     const ik::CurveReport report = tail->bend(pose, points, {.weight = 0.5f});
//
// The curve begins at the chain's first node, wherever the pose has it, and runs through the control points.
// They are in the space of the chain's parent node, in metres: a tail's curve moves with the hips, so IK may
// move the hips before or after bend(). Bend a spine before IK; hands and feet then still reach their
// targets.
//
// Method: ik::place_along() (tendril/ik/curve.hpp) in the space of the points. The bones turn from the rest
// pose no further than the curve requires: first all of them by the shortest arc from the first bone to the
// curve's beginning, then each with the curve's rotation-minimising frame. Rest twist stays, and a curve that
// moves a little rolls a little, unless it begins straight against the first bone's rest direction.
//
// Only rotations change, and with `fit` lengths. Children of the chain's nodes follow. With a weight of 0 the
// pose stays bit-identical.
//
// Cost: O(bones + control points + nodes of the skeleton). bend() does not allocate or throw.
#pragma once

#include <memory>

#include "tendril/humanoid/skeleton.hpp"
#include "tendril/ik/curve.hpp"

namespace tendril::humanoid {

/// Made once per character. bend() uses internal scratch: do not share an object between threads.
class BentChain {
  public:
    static constexpr std::size_t max_points = 256;

    /// The nodes from `first` down to `last`. All turn except the last, which keeps its rotation relative to
    /// its parent. Refuses nodes out of range, a `last` that is not below `first`, and a chain without any
    /// length at rest.
    static Expected<BentChain> make(const Skeleton& skeleton, std::size_t first, std::size_t last);
    ~BentChain();
    BentChain(BentChain&&) noexcept;
    BentChain& operator=(BentChain&&) noexcept;

    /// The chain's nodes, from first to last.
    std::span<const std::size_t> nodes() const noexcept;
    std::size_t bones() const noexcept { return nodes().empty() ? 0 : nodes().size() - 1; }
    /// The space of the control points, in metres: the position and rotation of the chain's parent. `placed`
    /// has one placement for every node.
    Placement space(std::span<const Placement> placed) const noexcept;
    /// At most `count` control points through the chain's joints, evenly spread along it. Empty if the pose
    /// is not finite or belongs to another skeleton. Allocates.
    std::vector<glm::vec3> points_through(std::span<const rig::Transform> pose, std::size_t count) const;

    /// `pose` holds the local transforms of all nodes; the chain's are replaced. `points`: the control points
    /// after the first node, 1 to max_points. The rest pose replaces `options.up`. `memory`, for bones()
    /// bones, is only needed to report jumps. Status::InvalidInput for a pose, points or options that are not
    /// finite or out of range; then nothing changes.
    ik::CurveReport bend(std::span<rig::Transform> pose, std::span<const glm::vec3> points,
                         const ik::CurveOptions& options, ik::CurveMemory& memory) noexcept;
    ik::CurveReport bend(std::span<rig::Transform> pose, std::span<const glm::vec3> points,
                         const ik::CurveOptions& options = {}) noexcept;

  private:
    struct Plan;
    explicit BentChain(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid
