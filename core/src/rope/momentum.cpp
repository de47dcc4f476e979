// Forces within and between bodies conserve momentum and angular momentum. A solve that ends early or is cut
// short does not, so each group of bodies that push each other is moved as a rigid whole afterwards.
#include "rope/substep.hpp"

#include "rope/body_contacts.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::rope {

void IslandStep::list_members() {
    const std::span<const Plan::Island> parts = plan_.parts_of(island_);
    local_.members.clear();
    local_.at_edge = false;
    const auto add = [&](std::uint32_t part, std::uint32_t chain) {
        local_.members.push_back({static_cast<std::uint32_t>(local_.members.size()), part, chain, {}});
    };
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
        const Plan::Range& chains = parts[p].chains;
        if (!parts[p].isolated) add(p, Member::no_chain);
        for (std::uint32_t r = 0; parts[p].isolated && r < chains.count; ++r) add(p, chains.first + r);
    }
}

Scratch::Nearest IslandStep::nearest_to(Group group) const {
    Scratch::Nearest nearest = Scratch::Nearest::None;
    const auto add = [&](std::uint32_t body) { nearest = std::max(nearest, scratch_.body_near[body]); };
    for (const Member& each : group) {
        if (each.chain != Member::no_chain) {
            add(plan_.chains[each.chain].body);
            continue;
        }
        const Plan::Island& part = plan_.parts_of(island_)[each.part];
        for (const std::uint32_t body : Plan::part(plan_.bodies, part.bodies)) add(body);
    }
    return nearest;
}

bool IslandStep::is_free(Group group) const {
    bool free = !local_.at_edge && nearest_to(group) == Scratch::Nearest::None;
    if (free) each_particle_of(group, [&](std::size_t i) { free = free && scratch_.weight[i] > 0.0; });
    return free;
}

/// Gives each free group the momentum and angular momentum that outside forces cause. Verlet's rule conserves
/// angular momentum about the positions at the start of the substep.
void Substep::restore_momentum() {
    if (island_.contacts != 0) BodyContacts(*this).sort_members();
    each_group([&](std::span<Member> group) {
        if (!is_free(group)) return;
        const RigidMotion off = rigid_motion(group, state_.position,
                                             [&](std::size_t i) { return scratch_.x[i] - scratch_.base[i]; });
        if (!(detail::length(off.mean) < max_magnitude)) return;  // NaN in one particle stays there
        each_particle_of(group, [&](std::size_t i) { scratch_.x[i] -= off.at(state_.position[i]); });
        for (Member& each : group) each.slowdown.reset();
    });
}

}  // namespace tendril::rope
