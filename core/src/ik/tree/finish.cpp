// After the last iteration: back to the caller's joints, with the branches that go along.
#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {
namespace {

bool same(const glm::vec3& a, const glm::vec3& b) noexcept {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

glm::quat turn_between(const glm::vec3& from, const glm::vec3& to) noexcept {
    const float a = length(from), b = length(to);
    if (same(from, to) || !(a > 1e-15f) || !(b > 1e-15f)) return {1.0f, 0.0f, 0.0f, 0.0f};
    return least_rotation(times(from, 1.0f / a), times(to, 1.0f / b));
}

/// How the bone that `joint` ends has turned since the start. What sits on the root has no such bone.
glm::quat turn_of(const TreeRoom& room, std::span<const glm::vec3> joints, std::size_t joint) noexcept {
    const Slot& slot = room.slots[room.slot_of[joint]];
    if (slot.joint == 0) return {1.0f, 0.0f, 0.0f, 0.0f};
    const std::size_t parent = room.joints[slot.joint].parent;
    return turn_between(minus(room.start[slot.joint], room.start[parent]),
                        minus(joints[slot.joint], joints[parent]));
}

void go_along(TreeRoom& room, std::span<glm::vec3> joints, std::size_t joint) noexcept {
    const std::size_t parent = room.joints[joint].parent;
    const bool first = room.slot_of[parent] != no_slot;
    const glm::quat turn = first ? turn_of(room, joints, parent) : room.turns[parent];
    room.turns[joint] = turn;
    if (turn.w == 1.0f && same(joints[parent], room.start[parent])) {
        joints[joint] = room.start[joint];
        return;
    }
    const glm::vec3 bone = rotated(turn, minus(room.start[joint], room.start[parent]));
    joints[joint] = lay(joints[parent], plus(joints[parent], bone), room.joints[joint].length);
}

}  // namespace

void carry_rotations(const TreeRoom& room, std::span<const glm::vec3> joints,
                     std::span<glm::quat> rotations) noexcept {
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const std::size_t parent = room.joints[k].parent;
        const glm::quat turn =
            turn_between(minus(room.start[k], room.start[parent]), minus(joints[k], joints[parent]));
        const glm::quat q = compose(turn, rotations[k]);
        rotations[k] = unit_quaternion(q.w, q.x, q.y, q.z);
    }
}

void finish(TreeRoom& room, std::span<glm::vec3> joints) noexcept {
    joints[0] = room.start[0];
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const std::size_t slot = room.slot_of[k];
        if (slot == no_slot) {
            go_along(room, joints, k);
        } else {
            const bool stays = same(room.at[slot], room.start[room.slots[slot].joint]);
            joints[k] = stays ? room.start[k] : room.at[slot];
        }
    }
}

}  // namespace tendril::ik::detail
