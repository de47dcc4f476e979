// The nodes of a character, in the order of its file: a parent may come before or after its children.
//
//     Expected<Skeleton> skeleton = Skeleton::make(std::move(nodes));
//     if (!skeleton) return log(skeleton.message());  // "Skeleton: nodes must be at most 4096, got 5000"
//
//     std::vector<rig::Transform> pose = rest_pose(*skeleton);
//     std::vector<Placement> placements(skeleton->size());
//     place(*skeleton, pose, placements);
//     placements[hand].position
//
// A placement is an affine map, not a translation, a rotation and a scale: files multiply matrices, so a
// rotated child of a node with non-uniform scale is sheared, and its joints are where the shear puts them.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/result.hpp"
#include "tendril/rig/transform.hpp"

namespace tendril::humanoid {

/// The space of a node's keys in clips, if it differs from the parent's.
struct KeySpace {
    std::int32_t parent = -1;  ///< index into the list; -1: the character's space
    rig::Transform rest{};     ///< rest transform of the node in this space
    bool operator==(const KeySpace&) const = default;
};

struct Node {
    std::string name{};        ///< unique, not empty
    std::int32_t parent = -1;  ///< index into the list; -1: a root
    rig::Transform rest{};     ///< local to the parent; metres
    /// Set by attached(): the node's parent is not the one in its file, whose clips stay unchanged.
    std::optional<KeySpace> keys{};
    /// The parent to which the keys of clips are local.
    std::int32_t key_parent() const noexcept { return keys ? keys->parent : parent; }
    const rig::Transform& key_rest() const noexcept { return keys ? keys->rest : rest; }
    bool operator==(const Node&) const = default;
};

class Skeleton {
  public:
    static constexpr std::size_t max_nodes = 4096;

    Skeleton() = default;
    /// Refuses more than max_nodes, an empty or duplicate name, a parent out of range, cycles, rest
    /// transforms that rig::checked() refuses, and key spaces above or below one another.
    static Expected<Skeleton> make(std::vector<Node> nodes);

    std::size_t size() const noexcept { return nodes_.size(); }
    const std::vector<Node>& nodes() const noexcept { return nodes_; }
    const Node& operator[](std::size_t node) const noexcept { return nodes_[node]; }
    /// Every node once, after its parent; siblings in the file's order.
    const std::vector<std::int32_t>& order() const noexcept { return order_; }
    /// Children in the file's order.
    std::span<const std::int32_t> children(std::size_t node) const noexcept;
    std::optional<std::size_t> find(std::string_view name) const noexcept;
    /// True if `node` is `above` or one of its descendants.
    bool is_below(std::size_t node, std::size_t above) const noexcept;
    /// The nodes with a key space of their own.
    std::span<const std::size_t> moved() const noexcept { return moved_; }

    bool operator==(const Skeleton& other) const { return nodes_ == other.nodes_; }

  private:
    std::vector<Node> nodes_;
    std::vector<std::int32_t> order_;
    std::vector<std::int32_t> children_;  // all nodes' children, node by node
    std::vector<std::size_t> moved_;
    std::vector<std::uint32_t> first_;  // where a node's children begin in children_; size() + 1 elements
};

/// A node's place in the character's space: its local point p is at axes * p + position.
struct Placement {
    glm::dmat3 axes{1.0};
    glm::dvec3 position{0.0};

    glm::dvec3 apply(const glm::dvec3& point) const noexcept;
    /// The rotation without scale and shear: x keeps its direction, y stays in the plane of x and y, and z
    /// completes a right-handed frame, even if the axes mirror. An axis of length 0 counts as perpendicular
    /// to the others.
    glm::dquat rotation() const noexcept;
};
/// Applies `child`, then `parent`.
Placement operator*(const Placement& parent, const Placement& child) noexcept;
Placement placement(const rig::Transform& transform) noexcept;

/// The transform whose placement in `parent` is `global`; its shear is lost, and an axis of length 0 gets
/// scale 0.
rig::Transform relative(const Placement& parent, const Placement& global) noexcept;

std::vector<rig::Transform> rest_pose(const Skeleton& skeleton);

/// Places every node from its local transform in `pose`. Both lists have size() elements. O(size()).
void place(const Skeleton& skeleton, std::span<const rig::Transform> pose,
           std::span<Placement> placements) noexcept;

}  // namespace tendril::humanoid
