// After the last iteration: writes the caller's joints, including branches without effectors.
#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {
namespace {

bool same(const glm::vec3& a, const glm::vec3& b) noexcept {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

glm::quat rotation_between(const glm::vec3& from, const glm::vec3& to) noexcept {
    const float a = length(from), b = length(to);
    if (same(from, to) || !(a > 1e-15f) || !(b > 1e-15f)) return {1.0f, 0.0f, 0.0f, 0.0f};
    return minimal_rotation(times(from, 1.0f / a), times(to, 1.0f / b));
}

/// The rotation of the bone that ends at `joint` since the start. Identity for joints at the root.
glm::quat rotation_of(const TreeScratch& scratch, std::span<const glm::vec3> joints,
                      std::size_t joint) noexcept {
    const Node& node = scratch.nodes[scratch.node_of[joint]];
    if (node.joint == 0) return {1.0f, 0.0f, 0.0f, 0.0f};
    const std::size_t parent = scratch.joints[node.joint].parent;
    return rotation_between(minus(scratch.start[node.joint], scratch.start[parent]),
                            minus(joints[node.joint], joints[parent]));
}

void follow_parent(TreeScratch& scratch, std::span<glm::vec3> joints, std::size_t joint) noexcept {
    const std::size_t parent = scratch.joints[joint].parent;
    const bool first = scratch.node_of[parent] != no_node;
    const glm::quat rotation = first ? rotation_of(scratch, joints, parent) : scratch.rotations[parent];
    scratch.rotations[joint] = rotation;
    if (rotation.w == 1.0f && same(joints[parent], scratch.start[parent])) {
        joints[joint] = scratch.start[joint];
        return;
    }
    const glm::vec3 bone = rotated(rotation, minus(scratch.start[joint], scratch.start[parent]));
    joints[joint] = at_length(joints[parent], plus(joints[parent], bone), scratch.joints[joint].length);
}

}  // namespace

void transport_rotations(const TreeScratch& scratch, std::span<const glm::vec3> joints,
                         std::span<glm::quat> rotations) noexcept {
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const std::size_t parent = scratch.joints[k].parent;
        const glm::quat rotation = rotation_between(minus(scratch.start[k], scratch.start[parent]),
                                                    minus(joints[k], joints[parent]));
        const glm::quat q = compose(rotation, rotations[k]);
        rotations[k] = unit_quaternion(q.w, q.x, q.y, q.z);
    }
}

void finish(TreeScratch& scratch, std::span<glm::vec3> joints) noexcept {
    joints[0] = scratch.start[0];
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const std::size_t node = scratch.node_of[k];
        if (node == no_node) {
            follow_parent(scratch, joints, k);
        } else {
            const bool stays = same(scratch.at[node], scratch.start[scratch.nodes[node].joint]);
            joints[k] = stays ? scratch.start[k] : scratch.at[node];
        }
    }
}

}  // namespace tendril::ik::detail
