// FABRIK's two pulls on a tree: in from the effectors, out from the root.
#include <cmath>

#include "ik/math.hpp"
#include "ik/tree/workspace.hpp"

namespace tendril::ik::detail {

void pull_inward(TreeRoom& room) noexcept {
    for (std::size_t k = 1; k < room.used; ++k) {
        const Slot& slot = room.slots[k];
        room.proposed[k] = times(slot.goal, slot.own_share);
    }
    // Always from the last joint to the first, so that a mean's rounding does not depend on who is listed
    // when.
    for (std::size_t k = room.used; k-- > 1;) {
        const Slot& slot = room.slots[k];
        if (slot.parent == 0) continue;
        const glm::vec3 proposal = lay(room.proposed[k], room.at[slot.parent], slot.length);
        room.proposed[slot.parent] = moved(room.proposed[slot.parent], proposal, slot.share);
    }
}

void pull_outward(TreeRoom& room) noexcept {
    room.next[0] = room.at[0];
    for (std::size_t k = 1; k < room.used; ++k) {
        const Slot& slot = room.slots[k];
        room.next[k] = lay(room.next[slot.parent], room.proposed[k], slot.length);
    }
}

Fit fit(const TreeRoom& room, std::span<const glm::vec3> places) noexcept {
    Fit result;
    double worst = 0.0;
    for (std::size_t i = 0; i < room.goal_count; ++i) {
        const std::size_t k = room.goals[i];
        const Slot& slot = room.slots[k];
        const glm::dvec3 way = between(places[k], slot.goal);
        const double squared = inner(way, way);
        result.cost += slot.weight * squared;
        if (squared > worst) worst = squared;
    }
    result.worst = std::sqrt(worst);
    return result;
}

}  // namespace tendril::ik::detail
