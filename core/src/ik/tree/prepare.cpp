// Before the first iteration: who takes part, where the effectors can get to, and how means are made.
#include <algorithm>
#include <cfloat>
#include <cmath>

#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {
namespace {

constexpr double least_weight = 1e-4;  ///< of the heaviest

double largest_coordinate(const glm::vec3& p) noexcept {
    return static_cast<double>(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
}

/// Whether the bone is at its length but for rounding, so that it can be left as it is. The same as a chain
/// allows, but for bones under a metre, which are held to their own scale.
bool holds(const glm::vec3& from, const glm::vec3& to, float length) noexcept {
    const double wanted = static_cast<double>(length);
    const double furthest = std::max(largest_coordinate(from), largest_coordinate(to));
    double allowed = 1e-4 * wanted + furthest * static_cast<double>(FLT_EPSILON);
    if (furthest <= 1e3) allowed = std::min(allowed, 1e-4 * std::max(1.0, wanted));
    return std::abs(gap(from, to) - wanted) <= allowed;
}

void lay_start(TreeRoom& room, std::span<const glm::vec3> joints) noexcept {
    room.start[0] = joints[0];
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const glm::vec3& anchor = room.start[room.joints[k].parent];
        const float length = room.joints[k].length;
        room.start[k] = holds(anchor, joints[k], length) ? joints[k] : lay(anchor, joints[k], length);
    }
}

/// Gives every joint on the way to an effector its slot.
void assign_slots(TreeRoom& room) noexcept {
    const std::size_t count = room.joints.size();
    for (std::size_t k = 0; k < count; ++k) room.slot_of[k] = room.effector_at[k] == no_joint ? no_slot : 0;
    for (std::size_t k = count; k-- > 1;) {
        if (room.slot_of[k] != no_slot) room.slot_of[room.joints[k].parent] = 0;
    }
    room.slots[0] = Slot{};
    room.at[0] = room.start[0];
    room.slot_of[0] = 0;
    room.used = 1;
    for (std::size_t k = 1; k < count; ++k) {
        if (room.slot_of[k] == no_slot) continue;
        const TreeJoint& joint = room.joints[k];
        const std::size_t parent = room.slot_of[joint.parent];
        if (joint.length == 0.0f) {
            room.slot_of[k] = parent;
            continue;
        }
        Slot slot;
        slot.parent = parent;
        slot.joint = k;
        slot.length = joint.length;
        room.slots[room.used] = slot;
        room.at[room.used] = room.start[k];
        room.slot_of[k] = room.used++;
        ++room.slots[parent].branches;
    }
}

/// The place nearest to the effector's target that it can reach by itself.
glm::dvec3 reachable(const TreeRoom& room, const Effector& effector) noexcept {
    const glm::vec3& root = room.start[0];
    const double furthest = room.path_reach[effector.joint];
    const double nearest = 2.0 * room.path_longest[effector.joint] - furthest;
    glm::dvec3 way = between(root, effector.target);
    double far = std::sqrt(inner(way, way));
    const double wanted = far > furthest ? furthest : far < nearest ? nearest : far;
    if (wanted == far) return glm::dvec3(effector.target);
    if (far < 1e-6 * wanted) {  // the target is on the root: any side will do, so the one it is on
        way = between(root, room.start[effector.joint]);
        far = std::sqrt(inner(way, way));
        if (far < 1e-6 * wanted) way = glm::dvec3(far = 1.0, 0.0, 0.0);
    }
    const double scale = wanted / far;
    return {static_cast<double>(root.x) + way.x * scale, static_cast<double>(root.y) + way.y * scale,
            static_cast<double>(root.z) + way.z * scale};
}

void collect_goals(TreeRoom& room, std::span<const Effector> effectors) noexcept {
    double heaviest = 0.0;
    room.lightest = 1.0;
    for (const Effector& effector : effectors) {
        if (room.path_reach[effector.joint] == 0.0) continue;  // it cannot move
        heaviest = std::max(heaviest, static_cast<double>(effector.weight));
    }
    // By joint and not by the list: what shares a slot is summed in an order of its own.
    for (std::size_t k = 1; k < room.joints.size(); ++k) {
        if (room.effector_at[k] == no_joint || room.slot_of[k] == 0) continue;
        const Effector& effector = effectors[room.effector_at[k]];
        const double weight = std::max(least_weight, static_cast<double>(effector.weight) / heaviest);
        room.lightest = std::min(room.lightest, weight);
        const glm::dvec3 goal = reachable(room, effector);
        Slot& slot = room.slots[room.slot_of[k]];
        slot.weight += weight;
        slot.goal_sum = {slot.goal_sum.x + weight * goal.x, slot.goal_sum.y + weight * goal.y,
                         slot.goal_sum.z + weight * goal.z};
    }
}

void share_out(TreeRoom& room) noexcept {
    room.goal_count = 0;
    for (std::size_t k = room.used; k-- > 1;) {
        Slot& slot = room.slots[k];
        slot.pull += slot.weight;
        room.slots[slot.parent].pull += slot.pull;
    }
    for (std::size_t k = 1; k < room.used; ++k) {
        Slot& slot = room.slots[k];
        slot.own_share = static_cast<float>(slot.weight / slot.pull);
        slot.share = static_cast<float>(slot.pull / room.slots[slot.parent].pull);
        if (slot.weight == 0.0) continue;
        slot.goal = {static_cast<float>(slot.goal_sum.x / slot.weight),
                     static_cast<float>(slot.goal_sum.y / slot.weight),
                     static_cast<float>(slot.goal_sum.z / slot.weight)};
        room.goals[room.goal_count++] = k;
    }
}

}  // namespace

void prepare(TreeRoom& room, std::span<const glm::vec3> joints,
             std::span<const Effector> effectors) noexcept {
    lay_start(room, joints);
    std::fill(room.effector_at.begin(), room.effector_at.end(), no_joint);
    for (std::size_t i = 0; i < effectors.size(); ++i) {
        if (effectors[i].weight > 0.0f) room.effector_at[effectors[i].joint] = i;
    }
    assign_slots(room);
    collect_goals(room, effectors);
    share_out(room);
}

}  // namespace tendril::ik::detail
