// Straight lines: how a tree gets out of one, and when it belongs on one.
#include <cmath>
#include <cstdint>

#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {
namespace {

constexpr float small_kick = 0.05f, large_kick = 0.3f;  ///< part of a bone's length
constexpr float least_sine = 1e-3f;                     ///< a bone off the line by less is on it

/// Where a limb starts that ends at slot `tip`.
std::size_t limb_base(const TreeRoom& room, std::size_t tip) noexcept {
    std::size_t base = room.slots[tip].parent;
    while (base != 0 && room.slots[base].branches == 1 && room.slots[base].weight == 0.0) {
        base = room.slots[base].parent;
    }
    return base;
}

bool on_line(const TreeRoom& room, std::size_t tip, std::size_t base, const glm::vec3& line) noexcept {
    for (std::size_t k = tip; k != base; k = room.slots[k].parent) {
        const glm::vec3 bone = minus(room.at[k], room.at[room.slots[k].parent]);
        if (length(cross(bone, line)) > least_sine * room.slots[k].length) return false;
    }
    return true;
}

bool kick_limb(TreeRoom& room, std::size_t tip, double tolerance) noexcept {
    const std::size_t base = limb_base(room, tip);
    if (room.slots[tip].parent == base) return false;  // one bone turns to its goal at once
    const glm::vec3 &goal = room.slots[tip].goal, &place = room.at[tip];
    if (static_cast<double>(distance(goal, place)) <= tolerance) return false;
    glm::vec3 line = minus(goal, room.at[base]);
    if (length(line) < 1e-3f * room.slots[tip].length) line = minus(place, room.at[room.slots[tip].parent]);
    const float size = length(line);
    if (!(size > 1e-15f)) return false;
    line = times(line, 1.0f / size);
    if (!on_line(room, tip, base, line)) return false;
    const glm::vec3 side = perpendicular(line);
    for (std::size_t k = room.slots[tip].parent; k != base; k = room.slots[k].parent) {
        room.at[k] = moved(room.at[k], side, small_kick * room.slots[k].length);
    }
    return true;
}

void lay_all(TreeRoom& room) noexcept {
    for (std::size_t k = 1; k < room.used; ++k) {
        const Slot& slot = room.slots[k];
        room.at[k] = lay(room.at[slot.parent], room.at[k], slot.length);
    }
}

/// -1 to 1, another for each number: the top bits of a product with the golden ratio.
float scattered(std::size_t number) noexcept {
    const std::uint32_t bits = static_cast<std::uint32_t>(number) * 2654435769u;
    return static_cast<float>(bits >> 8) * (2.0f / 16777216.0f) - 1.0f;
}

/// The only effector that pulls at anything; null where there are more.
const Effector* only_one(const TreeRoom& room, std::span<const Effector> effectors) noexcept {
    const Effector* only = nullptr;
    for (const Effector& effector : effectors) {
        if (effector.weight == 0.0f || room.slot_of[effector.joint] == 0) continue;
        if (only) return nullptr;
        only = &effector;
    }
    return only;
}

/// `by` metres from `from` along `line`. One step after the other, so that no bone is off by the rounding of
/// both its ends.
glm::vec3 stepped(const glm::vec3& from, const glm::dvec3& line, double by) noexcept {
    const double size = std::sqrt(inner(line, line));
    // Too near to each other for floats to tell: any way will do.
    const glm::dvec3 along =
        size > 1e-30 ? glm::dvec3(line.x / size, line.y / size, line.z / size) : glm::dvec3(1.0, 0.0, 0.0);
    return {static_cast<float>(static_cast<double>(from.x) + along.x * by),
            static_cast<float>(static_cast<double>(from.y) + along.y * by),
            static_cast<float>(static_cast<double>(from.z) + along.z * by)};
}

void lay_straight(TreeRoom& room, const glm::vec3& target) noexcept {
    for (std::size_t k = 1; k < room.used; ++k) {
        room.at[k] = stepped(room.at[k - 1], between(room.at[k - 1], target),
                             static_cast<double>(room.slots[k].length));
    }
}

/// The longest bone towards the goal, the others back along it.
void fold(TreeRoom& room, const glm::vec3& goal) noexcept {
    std::size_t longest = 1;
    for (std::size_t k = 1; k < room.used; ++k) {
        if (room.slots[k].length > room.slots[longest].length) longest = k;
    }
    const glm::dvec3 line = between(room.at[0], goal);
    for (std::size_t k = 1; k < room.used; ++k) {
        const double bone = static_cast<double>(room.slots[k].length);
        room.at[k] = stepped(room.at[k - 1], line, k == longest ? bone : -bone);
    }
}

}  // namespace

bool lay_at_rim(TreeRoom& room, std::span<const Effector> effectors) noexcept {
    const Effector* const effector = only_one(room, effectors);
    if (!effector) return false;
    const double furthest = room.path_reach[effector->joint];
    const double nearest = 2.0 * room.path_longest[effector->joint] - furthest;
    const double far = gap(room.at[0], effector->target);
    if (far > furthest) {
        lay_straight(room, effector->target);
    } else if (far < nearest) {
        fold(room, room.slots[room.goals[0]].goal);
    } else {
        return false;
    }
    return true;
}

bool kick_lines(TreeRoom& room, double tolerance) noexcept {
    bool kicked = false;
    for (std::size_t i = 0; i < room.goal_count; ++i) kicked |= kick_limb(room, room.goals[i], tolerance);
    if (kicked) lay_all(room);
    return kicked;
}

void kick_all(TreeRoom& room) noexcept {
    for (std::size_t k = 1; k < room.used; ++k) {
        const Slot& slot = room.slots[k];
        const glm::vec3 bone = minus(room.at[k], room.at[slot.parent]);
        const float size = length(bone);
        if (!(size > 1e-15f)) continue;
        const glm::vec3 along = times(bone, 1.0f / size), side = perpendicular(along);
        const float by = large_kick * slot.length;
        room.at[k] = moved(room.at[k], side, by * scattered(2 * k));
        room.at[k] = moved(room.at[k], cross(along, side), by * scattered(2 * k + 1));
    }
    lay_all(room);
}

}  // namespace tendril::ik::detail
