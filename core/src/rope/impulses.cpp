// The impulses that bodies give colliders: equal and opposite to those of their contacts, as each solver
// computed them. Later changes by energy bounds and shortened steps are not counted.
#include <algorithm>
#include <array>
#include <cstddef>

#include "rope/build.hpp"
#include "rope/chain_newton.hpp"
#include "rope/geometry.hpp"
#include "rope/implicit_step.hpp"
#include "rope/substep.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::rope {
namespace {

using detail::dot;
using glm::dvec3;

}  // namespace

/// Gives each collider the force of its contacts. At a link that is the contact's multiplier; at a node it is
/// the sum of the node's other forces, `force`, which the contact balances.
void ChainNewton::push_colliders() const {
    if (!local_.records_pushes) return;
    const double per_substep = 1.0 / state_.settings.substep;
    const auto push = [&](std::uint32_t number, const dvec3& force, const dvec3& at) {
        local_.push(number, per_substep * force, at);
    };
    constexpr std::size_t touches = detail::ChainBond::max_contacts;
    const auto touch = [&](std::size_t effect) -> const ContactScratch::LinkContact::Touch& {
        return s_.link_contacts[effect / touches].touches[effect % touches];
    };
    for (std::size_t c = 0; c < s_.bond_effects.size(); ++c) {
        const detail::BondContact& effect = s_.bond_effects[c];
        if (effect.active) push(touch(c).collider, -effect.multiplier * effect.normal, touch(c).point);
    }
    const auto link_at = [&](std::uint32_t bond) -> const ContactScratch::LinkContact::Touch* {
        if (bond >= s_.bonds.size() || s_.bonds[bond].contact < 0) return nullptr;
        const auto c =
            static_cast<std::size_t>(s_.bonds[bond].contact);  // touches fill their places in order
        return s_.bond_effects[c].active ? &touch(c) : nullptr;
    };
    for (std::size_t c = 0; c < s_.contacts.size(); ++c) {
        const ContactScratch::Contact& contact = s_.contacts[c];
        const detail::ChainNode& node = s_.nodes[contact.node];
        if (node.pinned) continue;
        if (s_.node_effects[c].planes > 0) {
            push_planes(contact, s_.node_effects[c], per_substep);
            continue;
        }
        const auto* const next = link_at(contact.node);
        const auto* const last = link_at(contact.node - 1);
        if (next != nullptr || last != nullptr)  // friction
            push((next != nullptr ? next : last)->collider, node.force, node.x);
    }
}

/// Splits a node's force among its planes by Gauss-Seidel: each takes a push along its normal, never a pull.
/// The remainder is friction on the deepest one.
void ChainNewton::push_planes(const ContactScratch::Contact& contact, const detail::NodeContact& effect,
                              double per_substep) const {
    constexpr int rounds = 16;
    const detail::ChainNode& node = s_.nodes[contact.node];
    std::array<double, detail::NodeContact::max_planes> parts{};
    dvec3 rest = node.force;
    for (int i = 0; i < (effect.planes > 1 ? rounds : 1); ++i)
        for (int p = 0; p < effect.planes; ++p) {
            double& part = parts[static_cast<std::size_t>(p)];
            const double now = std::max(0.0, part - dot(rest, effect.normal[p]));
            rest += (now - part) * effect.normal[p];
            part = now;
        }
    const auto planes = std::span(s_.planes).subspan(contact.first, contact.count);
    for (int p = 0; p < effect.planes; ++p) {
        const auto plane = std::ranges::find_if(planes, [&](const ContactScratch::Plane& each) {
            return each.active && each.normal == effect.normal[p];
        });
        if (plane == planes.end()) continue;  // not a number
        const dvec3 force = -parts[static_cast<std::size_t>(p)] * effect.normal[p];
        local_.push(plane->collider, per_substep * (p == 0 ? force + rest : force), node.x);
    }
}

/// Solvers of cloth stop before their forces balance. So without pins, the impulses are corrected to add up
/// to the momentum that the bodies lost.
void ImplicitStep::push_colliders(const std::vector<ClothContact>& contacts) const {
    if (!local_.records_pushes) return;
    const std::size_t first = local_.pushes.size();
    dvec3 off(0.0);
    bool pinned = false;
    each_particle([&](std::size_t i) {
        pinned = pinned || scratch_.weight[i] == 0.0;
        off += (state_.mass[i] / h_) * (scratch_.base[i] - scratch_.x[i]);
    });
    double whole = 0.0;
    for (const ClothContact& each : contacts) {
        const dvec3 by = contact_point(each, scratch_.x) - each.at;
        const double along = dot(by, each.normal);
        const dvec3 force = stiffness_ * (each.gap + along) * each.normal +
                            each.drag * (each.slip + by - along * each.normal);
        local_.push(local_.near[each.near].collider, (mass_ / h_) * force, each.at);
        off -= local_.pushes.back().impulse;
        whole += detail::length(local_.pushes.back().impulse);
    }
    for (Push& each : std::span(local_.pushes).subspan(first))
        if (!pinned && whole > 0.0) each.impulse += (detail::length(each.impulse) / whole) * off;
}

void Substep::push_touched() {
    for (const std::uint32_t i : local_.touched) {
        Touch& touch = scratch_.touch[i];
        for (const Touch::Share& each : touch.shares)
            if (local_.records_pushes && each.moved != dvec3(0.0))
                local_.push(each.collider, (-state_.mass[i] / h_) * each.moved, scratch_.x[i]);
        touch = Touch{};
    }
    local_.touched.clear();
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
        if (scratch_.weight[a] + scratch_.weight[b] == 0.0) return;  // nothing solves it
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

/// Adds in the order of islands, whichever threads solved them: each thread's list is in that order.
void Workspace::Parts::add_impulses(const State& state) {
    for (IslandScratch& thread : threads) thread.next_push = 0;
    const auto island = [](const IslandScratch& thread) {
        return thread.next_push < thread.pushes.size() ? thread.pushes[thread.next_push].island : ~0u;
    };
    for (;;) {
        IslandScratch& next = *std::ranges::min_element(threads, {}, island);
        const std::uint32_t number = island(next);
        if (number == ~0u) break;
        for (; island(next) == number; ++next.next_push) {
            const Push& push = next.pushes[next.next_push];
            if (!(detail::length(push.impulse) < max_magnitude)) continue;  // not a number
            ColliderImpulse& to = impulses[push.collider];
            const dvec3 middle(centre(state.colliders[push.collider].shape));
            to.linear += push.impulse;
            to.angular += detail::cross(push.at - middle, push.impulse);
        }
    }
    for (IslandScratch& thread : threads) thread.pushes.clear();
}

std::span<const ColliderImpulse> Workspace::Parts::reported_impulses() {
    std::erase_if(impulses, [](const ColliderImpulse& each) {
        return each.linear == dvec3(0.0) && each.angular == dvec3(0.0);
    });
    return impulses;
}

}  // namespace tendril::rope
