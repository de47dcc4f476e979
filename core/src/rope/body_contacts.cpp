// Solves chains together with their contacts.
#include "rope/body_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace tendril::rope {
namespace {

using glm::dvec3;

constexpr int max_rounds = 6, min_rounds = 3;
/// What a contact may be off, relative to the thickness.
constexpr double enough_apart = 1e-3;
/// Of a contact, relative to what its two chains offer.
constexpr double stiffer_than_offered = 50.0;

dvec3 at(const dvec3& from, const dvec3& to, double part) {
    return from + part * (to - from);
}

}  // namespace

BodyContacts::Ends BodyContacts::ends_of(std::uint32_t a, std::uint32_t b,
                                         const std::vector<dvec3>& at) const {
    const Link &first = state_.links[a], &second = state_.links[b];
    return {at[first.a], at[first.b], at[second.a], at[second.b]};
}

/// The force of a contact whose segments are there.
BodyContacts::Response BodyContacts::respond(const Contact& contact, const Ends& to) const {
    const auto nearest = detail::nearest_of_segments(to.a0, to.a1, to.b0, to.b1);
    Response response{.at_a = nearest.at_a, .at_b = nearest.at_b};
    double apart = detail::length(nearest.between);
    response.normal = apart > 1e-9 * contact.thickness ? (1.0 / apart) * nearest.between : contact.start;
    if (detail::dot(response.normal, contact.start) < 0.0) {  // they have crossed
        response.normal = -response.normal;
        apart = -apart;
    }
    const dvec3& n = response.normal;
    response.gap = apart - contact.thickness;
    const double before = detail::dot(contact.force, n), k = contact.stiffness;
    const double pressed = std::max(0.0, before - k * (response.gap - contact.target));
    if (!(pressed > 0.0)) return response;
    const Ends from = ends_of(contact.a, contact.b, state_.position);
    const dvec3 by_a = at(to.a0 - from.a0, to.a1 - from.a1, response.at_a);
    const dvec3 by_b = at(to.b0 - from.b0, to.b1 - from.b1, response.at_b);
    dvec3 slip = by_b - by_a;
    slip -= detail::dot(slip, n) * n;
    const dvec3 friction = contact.force - before * n - k * slip;
    const double size = detail::length(friction),
                 most = static_cast<double>(state_.settings.friction) * pressed;
    const double part = size > most ? most / size : 1.0;
    response.force = pressed * n + part * friction;
    response.along = k;
    response.across = part * k;
    return response;
}

/// Where a node is, or will be if nothing presses on it.
dvec3 BodyContacts::expected(std::uint32_t number, std::uint32_t node) const {
    const ContactScratch& chain = memory(number);
    return chain.progress.moved ? chain.nodes[node].x : chain.nodes[node].base;
}

BodyContacts::Response BodyContacts::respond(const Contact& contact) const {
    const auto expected_end = [&](std::uint32_t link, std::uint32_t end) {
        const std::uint32_t chain = plan_.chain_of[link];
        return expected(chain, link - plan_.chains[chain].first_link + end);
    };
    return respond(contact, {expected_end(contact.a, 0), expected_end(contact.a, 1),
                             expected_end(contact.b, 0), expected_end(contact.b, 1)});
}

void BodyContacts::order_sides() {
    s_.sides.clear();
    s_.chains.clear();
    const auto add = [&](std::uint32_t link, std::uint32_t contact, bool is_b) {
        const std::uint32_t chain = plan_.chain_of[link];
        s_.sides.push_back({chain, link - plan_.chains[chain].first_link, contact, is_b});
        s_.chains.push_back(chain);
    };
    for (std::uint32_t c = 0; c < s_.contacts.size(); ++c) {
        add(s_.contacts[c].a, c, false);
        add(s_.contacts[c].b, c, true);
    }
    std::sort(s_.sides.begin(), s_.sides.end(), [](const Side& p, const Side& q) {
        return std::tie(p.chain, p.bond, p.contact, p.is_b) < std::tie(q.chain, q.bond, q.contact, q.is_b);
    });
    std::sort(s_.chains.begin(), s_.chains.end());
    s_.chains.erase(std::unique(s_.chains.begin(), s_.chains.end()), s_.chains.end());
}

std::span<const BodyContacts::Side> BodyContacts::sides_of(std::uint32_t chain) const {
    const auto before = [](const Side& side, std::uint32_t c) { return side.chain < c; };
    const auto after = [](std::uint32_t c, const Side& side) { return c < side.chain; };
    const auto first = std::lower_bound(s_.sides.begin(), s_.sides.end(), chain, before);
    return {first, std::upper_bound(first, s_.sides.end(), chain, after)};
}

/// The mass that a chain offers to a contact: that of a node, and of its neighbours as far as tension makes
/// them follow. Other contacts nearer than that share it.
double BodyContacts::offered(std::size_t number) const {
    const Side& side = s_.sides[number];
    const Plan::Chain& chain = plan_.chains[side.chain];
    const Link& link = state_.links[chain.first_link + side.bond];
    if (scratch_.weight[link.a] + scratch_.weight[link.b] == 0.0)
        return std::numeric_limits<double>::infinity();
    const double mass = 0.5 * (state_.mass[link.a] + state_.mass[link.b]);
    const double tension = std::max(0.0, static_cast<double>(link.tension)) * h_ * h_;
    const double sideways = std::min(tension / std::max(static_cast<double>(link.rest), 1e-9), 1e9 * mass);
    const auto follow = static_cast<std::uint32_t>(std::min(1.0 + std::sqrt(sideways / mass), 1e6));
    std::size_t first = number, end = number + 1;
    while (first > 0 && s_.sides[first - 1].chain == side.chain &&
           s_.sides[first - 1].bond + follow >= side.bond)
        --first;
    while (end < s_.sides.size() && s_.sides[end].chain == side.chain &&
           s_.sides[end].bond <= side.bond + follow)
        ++end;
    return std::sqrt(mass * (mass + 4.0 * sideways)) / static_cast<double>(end - first);
}

void BodyContacts::choose_stiffness() {
    for (Contact& contact : s_.contacts) contact.stiffness = 0.0;
    // Initially its inverse.
    for (std::size_t i = 0; i < s_.sides.size(); ++i)
        s_.contacts[s_.sides[i].contact].stiffness += 1.0 / offered(i);
    for (Contact& contact : s_.contacts)
        contact.stiffness = contact.stiffness > 0.0 ? stiffer_than_offered / contact.stiffness : 0.0;
}

/// Sets what presses on the nodes of a chain.
void BodyContacts::press(std::uint32_t number, std::span<const Side> sides) {
    ContactScratch& chain = memory(number);
    for (detail::NodePush& push : chain.pushes)
        push = {.node = push.node, .at = expected(number, push.node), .force = dvec3(0.0), .stiffness = {}};
    for (const Side& side : sides) {
        const Contact& contact = s_.contacts[side.contact];
        const Response response = respond(contact);
        // If both segments are of this chain, both move in its step, as if they would not.
        const bool own = plan_.chain_of[contact.a] == plan_.chain_of[contact.b];
        const double sign = side.is_b ? 1.0 : -1.0, times = own ? 2.0 : 1.0;
        const double t = side.is_b ? response.at_b : response.at_a;
        for (std::uint32_t end = 0; end < 2; ++end) {
            const detail::ChainNode& node = chain.nodes[side.bond + end];
            detail::NodePush& push = chain.pushes[static_cast<std::size_t>(node.push)];
            const double share = end == 0 ? 1.0 - t : t, stiff = times * share;
            const dvec3& n = response.normal;
            const double beyond = response.along - response.across;
            push.force += (sign * share) * response.force;
            push.stiffness.xx += stiff * response.across, push.stiffness.yy += stiff * response.across;
            push.stiffness.zz += stiff * response.across;
            push.stiffness.add(stiff * beyond, n, n);
        }
    }
}

/// Returns the largest change, as a distance relative to the thickness.
double BodyContacts::update_forces() {
    double worst = 0.0;
    for (Contact& contact : s_.contacts) {
        const dvec3 force = respond(contact).force;
        const double change = detail::length(force - contact.force);
        if (change > worst * contact.stiffness * contact.thickness)
            worst = change / (contact.stiffness * contact.thickness);
        contact.force = force;
    }
    return worst;
}

void BodyContacts::solve() {
    order_sides();
    choose_stiffness();
    for (const std::uint32_t r : s_.chains) {
        scratch_.chain_solved[r] = 1;
        ContactScratch& chain = memory(r);
        ChainNewton newton(state_, plan_, island_, scratch_, local_, chain);
        newton.find(r);
        newton.begin();
        for (const Side& side : sides_of(r))
            for (std::uint32_t node = side.bond; node < side.bond + 2; ++node) {
                if (chain.nodes[node].push >= 0) continue;
                chain.nodes[node].push = static_cast<std::int32_t>(chain.pushes.size());
                chain.pushes.emplace_back().node = node;
            }
    }
    bool more = true;
    for (int round = 0; round < max_rounds; ++round) {
        bool stepped = false;
        for (const std::uint32_t r : s_.chains) {
            ChainNewton newton(state_, plan_, island_, scratch_, local_, memory(r));
            newton.open(r);
            press(r, sides_of(r));
            stepped |= newton.step(true, more);
        }
        more = update_forces() > enough_apart || round + 1 < min_rounds;
        if (!stepped && !more) break;
    }
    for (const std::uint32_t r : s_.chains) {
        ChainNewton newton(state_, plan_, island_, scratch_, local_, memory(r));
        newton.open(r);
        while (newton.step(false, false)) {
        }
        newton.finish();
    }
}

void BodyContacts::project() {
    std::vector<dvec3>& place = scratch_.place;
    local_.done.work += s_.contacts.size();
    for (Contact& contact : s_.contacts) {
        contact.force = dvec3(0.0);
        const Response found = respond(contact, ends_of(contact.a, contact.b, place));
        const double depth = contact.target - found.gap;
        if (!(depth > 0.0)) continue;
        const Link &a = state_.links[contact.a], &b = state_.links[contact.b];
        const std::uint32_t particles[] = {a.a, a.b, b.a, b.b};
        const double shares[] = {found.at_a - 1.0, -found.at_a, 1.0 - found.at_b, found.at_b};
        double freedom = 0.0;
        dvec3 slip(0.0);
        for (int k = 0; k < 4; ++k) {
            freedom += shares[k] * shares[k] * scratch_.weight[particles[k]];
            slip += shares[k] * (place[particles[k]] - state_.position[particles[k]]);
        }
        if (!(freedom > 0.0)) continue;
        slip -= detail::dot(slip, found.normal) * found.normal;
        const double slipped = detail::length(slip),
                     most = depth * static_cast<double>(state_.settings.friction);
        const dvec3 by = depth * found.normal - (slipped > most ? most / slipped : 1.0) * slip;
        for (int k = 0; k < 4; ++k)
            place[particles[k]] += (shares[k] * scratch_.weight[particles[k]] / freedom) * by;
    }
}

}  // namespace tendril::rope
