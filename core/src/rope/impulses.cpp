// The impulses that bodies give colliders: equal and opposite to those of their contacts, as each solver
// computed them. Energy bounds and shortened steps change motion after that, without a collider.
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "rope/build.hpp"
#include "rope/chain_newton.hpp"
#include "rope/geometry.hpp"
#include "rope/implicit_step.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using detail::dot;
using glm::dvec3;

}  // namespace

/// Each node bears what its contacts leave of its forces: those of links are known; of several planes each
/// takes its normal part, and the deepest, which has the friction, the rest.
void ChainNewton::push_colliders() const {
    if (!local_.records_pushes) return;
    const double per_substep = 1.0 / state_.settings.substep;
    const auto link_contact = [&](std::uint32_t bond) -> const ContactScratch::LinkContact* {
        if (bond >= s_.bonds.size() || s_.bonds[bond].contact < 0) return nullptr;
        const auto c = static_cast<std::size_t>(s_.bonds[bond].contact);
        return s_.bond_effects[c].active ? &s_.link_contacts[c] : nullptr;
    };
    for (std::size_t c = 0; c < s_.contacts.size(); ++c) {
        const ContactScratch::Contact& contact = s_.contacts[c];
        const detail::ChainNode& node = s_.nodes[contact.node];
        const detail::NodeContact& effect = s_.node_effects[c];
        if (node.pinned) continue;
        const auto push = [&](std::uint32_t number, const dvec3& force, const dvec3& at) {
            local_.push(number, per_substep * force, at);
        };
        dvec3 left = node.force;
        const ContactScratch::LinkContact* beside = nullptr;
        for (const bool before : {true, false}) {
            const ContactScratch::LinkContact* const link = link_contact(contact.node - (before ? 1 : 0));
            if (link == nullptr) continue;
            const detail::BondContact& bond =
                s_.bond_effects[static_cast<std::size_t>(s_.bonds[link->bond].contact)];
            const double share = (before ? bond.at : 1.0 - bond.at) * bond.multiplier;
            push(link->collider, -share * bond.normal, link->point);
            left += share * bond.normal;
            beside = link;
        }
        for (int p = effect.planes; p-- > 0;) {
            const dvec3& normal = effect.normal[p];
            const dvec3 force = p == 0 ? left : std::min(0.0, dot(left, normal)) * normal;
            const std::span<const ContactScratch::Plane> planes =
                std::span(s_.planes).subspan(contact.first, contact.count);
            const auto plane = std::ranges::find_if(planes, [&](const ContactScratch::Plane& each) {
                return each.active && each.normal == normal;
            });
            push(plane->collider, force, node.x);
            left -= force;
        }
        if (effect.planes == 0 && beside != nullptr) push(beside->collider, left, beside->point);
    }
}

void ImplicitStep::push_colliders(const std::vector<ClothContact>& contacts) const {
    if (!local_.records_pushes) return;
    for (const ClothContact& each : contacts) {
        const IslandScratch::Near& near = local_.near[each.near];
        const dvec3 by = contact_point(each, scratch_.x) - each.at;
        const double along = dot(by, each.normal);
        const dvec3 force = stiffness_ * (each.gap + along) * each.normal +
                            each.drag * (each.slip + by - along * each.normal);
        local_.push(near.collider, (mass_ / h_) * force, each.at);
    }
}

void Substep::push_touched() {
    for (const std::uint32_t i : local_.touched) {
        Touch& touch = scratch_.touch[i];
        if (local_.records_pushes)
            local_.push(touch.collider, (-state_.mass[i] / h_) * touch.moved, scratch_.x[i]);
        touch = Touch{};
    }
    local_.touched.clear();
}

/// The momentum times h that the island would have without solvers, or that it has. Empty if it has pins.
std::optional<dvec3> Substep::momentum(bool free) const {
    dvec3 sum(0.0);
    bool pinned = false;
    each_particle([&](std::size_t i) {
        pinned = pinned || scratch_.weight[i] == 0.0;
        sum += state_.mass[i] * (free ? scratch_.base[i] - state_.position[i] : state_.displacement[i]);
    });
    if (pinned) return {};
    return sum;
}

/// Makes the sum of the island's pushes the momentum that it lost, `lost` over h: solvers stop before their
/// forces balance exactly.
void Substep::balance_pushes(const dvec3& lost) {
    const std::span<Push> pushes = std::span(local_.pushes).subspan(local_.first_push);
    dvec3 off = (1.0 / h_) * lost;
    double whole = 0.0;
    for (const Push& each : pushes) {
        off -= each.impulse;
        whole += detail::length(each.impulse);
    }
    for (Push& each : pushes)
        if (whole > 0.0) each.impulse += (detail::length(each.impulse) / whole) * off;
}

/// The pull of links, ties and bending on attached particles, and their weight. Call before the state is
/// written.
void Substep::push_attached() {
    const auto pull = [&](std::uint32_t i, const dvec3& force) {  // times h^2
        if (scratch_.weight[i] > 0.0) return;
        const auto pin = std::ranges::lower_bound(state_.pins, i, {}, &Pin::particle);
        if (pin->collider)
            local_.push(scratch_.collider_at[pin->collider.index], (1.0 / h_) * force, scratch_.x[i]);
    };
    each_particle([&](std::size_t i) {
        pull(static_cast<std::uint32_t>(i), (h_ * h_ * state_.mass[i]) * acceleration_);
    });
    const auto pull_both = [&](std::uint32_t a, std::uint32_t b, double multiplier) {
        const dvec3 force = multiplier * detail::unit(scratch_.x[b] - scratch_.x[a]);
        pull(a, force);
        pull(b, -force);
    };
    for (const std::uint32_t i : Plan::part(plan_.links, island_.links))
        pull_both(state_.links[i].a, state_.links[i].b, scratch_.multiplier[i]);
    for (const std::uint32_t i : Plan::part(plan_.ties, island_.ties))
        pull_both(state_.ties[i].a, state_.ties[i].b, scratch_.tie_multiplier[i]);
    for (const Plan::Chain& chain : Plan::part(plan_.chains, island_.chains)) {
        const Body& body = state_.bodies[chain.body];
        if (!detail::bends(state_, body)) continue;
        for (std::uint32_t k = 1; k < chain.links; ++k) {
            const std::uint32_t* const points = &plan_.nodes[chain.first_node + k - 1];
            const Link* const links = &state_.links[chain.first_link + k - 1];
            const detail::ChainBend bend = detail::bend_between(state_, body, links[0], links[1]);
            const auto curvature = [&](auto at) {
                return bend.curvature(at(points[0]), at(points[1]), at(points[2]));
            };
            const double now = detail::bend_ahead * bend.stiffness;
            const dvec3 moment = now * curvature([&](std::uint32_t i) { return scratch_.x[i]; }) +
                                 (bend.stiffness - now) * curvature([&](std::uint32_t i) {
                                     return state_.position[i] - state_.displacement[i];
                                 });
            const std::array<double, 3> shares{bend.before, -bend.before - bend.after, bend.after};
            for (std::size_t i = 0; i < 3; ++i) pull(points[i], -shares[i] * moment);
        }
    }
}

void Workspace::Parts::begin_impulses(const State& state, bool record) {
    impulses.clear();
    for (IslandScratch& thread : threads) {
        thread.records_pushes = record;
        thread.pushes.clear();
        if (record) thread.pushes.reserve(2 * state.position.size());
    }
    for (const Collider& each : state.colliders)
        if (record) impulses.push_back({.collider = each.id});
}

/// In the order of islands, whatever threads took them: each thread takes some in this order.
void Workspace::Parts::add_impulses(const State& state) {
    for (IslandScratch& thread : threads) thread.first_push = 0;
    const auto island = [](const IslandScratch& thread) {
        return thread.first_push < thread.pushes.size() ? thread.pushes[thread.first_push].island : ~0u;
    };
    for (;;) {
        IslandScratch& next = *std::ranges::min_element(threads, {}, island);
        const std::uint32_t number = island(next);
        if (number == ~0u) break;
        for (; island(next) == number; ++next.first_push) {
            const Push& push = next.pushes[next.first_push];
            ColliderImpulse& to = impulses[push.collider];
            const dvec3 middle(centre(state.colliders[push.collider].shape));
            to.linear += push.impulse;
            to.angular += detail::cross(push.at - middle, push.impulse);
        }
    }
    for (IslandScratch& thread : threads) thread.pushes.clear();
}

std::span<const ColliderImpulse> Workspace::Parts::reported_impulses() {
    std::erase_if(impulses, [](const ColliderImpulse& each) { return each.linear == dvec3(0.0); });
    return impulses;
}

}  // namespace tendril::rope
