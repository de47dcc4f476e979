// Solves chains together with their contacts.
#include "rope/body_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "rope/segments.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

constexpr int max_rounds = 6, min_rounds = 3;
/// Accepted error of a contact, relative to the thickness.
constexpr double contact_tolerance = 1e-3;
/// Stiffness of a contact, relative to the effective mass of its two chains.
constexpr double relative_stiffness = 50.0;

/// How far projections may move a particle in a substep, metres.
constexpr double max_correction = 1e-3;

}  // namespace

/// The response of a contact whose points are at `to`.
BodyContacts::Response BodyContacts::respond(const Contact& contact, const Points& to) const {
    const Nearest nearest = nearest_of(contact, to);
    Response response{.weights = nearest.weights};
    double distance = detail::length(nearest.between);
    response.normal =
        distance > 1e-9 * contact.thickness ? (1.0 / distance) * nearest.between : contact.normal;
    if (detail::dot(response.normal, contact.normal) < 0.0) {  // they have crossed
        response.normal = -response.normal;
        distance = -distance;
    }
    const dvec3& n = response.normal;
    response.gap = distance - contact.thickness;
    const double before = detail::dot(contact.force, n), k = contact.stiffness;
    const double normal_force = std::max(0.0, before - k * (response.gap - contact.target));
    if (!(normal_force > 0.0)) return response;
    dvec3 slip(0.0);
    for (std::size_t p = 0; p < 4; ++p)
        slip += nearest.weights[p] * (to[p] - state_.position[contact.points[p]]);
    slip -= detail::dot(slip, n) * n;
    const dvec3 friction = contact.force - before * n - k * slip;
    const double size = detail::length(friction),
                 limit = static_cast<double>(state_.settings.friction) * normal_force;
    const double part = size > limit ? limit / size : 1.0;
    response.force = normal_force * n + part * friction;
    response.along = k;
    response.across = part * k;
    return response;
}

/// A node's current position or, before its chain's first step, the one without links and contacts.
dvec3 BodyContacts::expected_position(std::uint32_t number, std::uint32_t node) const {
    const ContactScratch& chain = chain_scratch(number);
    return chain.progress.moved ? chain.nodes[node].x : chain.nodes[node].base;
}

BodyContacts::Response BodyContacts::respond(const Contact& contact) const {
    const auto expected_end = [&](std::uint32_t link, std::uint32_t end) {
        const std::uint32_t chain = plan_.chain_of[link];
        return expected_position(chain, link - plan_.chains[chain].first_link + end);
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

/// A chain's effective mass at a contact, kg: the masses of a node and the neighbours coupled to it by
/// tension, divided by the number of contacts among them.
double BodyContacts::effective_mass(std::size_t number) const {
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
    // Sums the inverse masses first.
    for (std::size_t i = 0; i < s_.sides.size(); ++i)
        s_.contacts[s_.sides[i].contact].stiffness += 1.0 / effective_mass(i);
    for (Contact& contact : s_.contacts)
        contact.stiffness = contact.stiffness > 0.0 ? relative_stiffness / contact.stiffness : 0.0;
}

/// Sets the pushes on the nodes of a chain.
void BodyContacts::set_pushes(std::uint32_t number, std::span<const Side> sides) {
    ContactScratch& chain = chain_scratch(number);
    for (detail::NodePush& push : chain.pushes)
        push = {push.node, expected_position(number, push.node), dvec3(0.0), {}};
    for (const Side& side : sides) {
        const Contact& contact = s_.contacts[side.contact];
        const Response response = respond(contact);
        // If both segments are in this chain, each is treated as fixed although the step moves both.
        const bool own = plan_.chain_of[contact.a] == plan_.chain_of[contact.b];
        const double sign = side.is_b ? 1.0 : -1.0, times = own ? 2.0 : 1.0;
        const double t = std::abs(response.weights[side.is_b ? 3 : 1]);
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
        ContactScratch& chain = chain_scratch(r);
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
            ChainNewton newton(state_, plan_, island_, scratch_, local_, chain_scratch(r));
            newton.open(r);
            set_pushes(r, sides_of(r));
            stepped |= newton.step(true, more);
        }
        more = update_forces() > contact_tolerance || round + 1 < min_rounds;
        if (!stepped && !more) break;
    }
    for (const std::uint32_t r : s_.chains) {
        ChainNewton newton(state_, plan_, island_, scratch_, local_, chain_scratch(r));
        newton.open(r);
        while (newton.step(false, false)) {
        }
        newton.finish();
    }
}

/// The first body in the group of bodies that contacts join to this one.
std::uint32_t BodyContacts::first_of(std::uint32_t body) const {
    while (scratch_.body_group[body] != body) body = scratch_.body_group[body];
    return body;
}

/// Joins two bodies that push each other.
void BodyContacts::join(const Pair& pair) {
    const std::uint32_t a = first_of(pair.body_a), b = first_of(pair.body_b);
    scratch_.body_group[std::max(a, b)] = std::min(a, b);
}

void BodyContacts::sort_members() {
    const std::span<const Plan::Island> parts = plan_.parts_of(island_);
    for (Member& each : local_.members)
        each.group = first_of(each.chain == Member::no_chain ? plan_.bodies[parts[each.part].bodies.first]
                                                             : plan_.chains[each.chain].body);
    std::sort(local_.members.begin(), local_.members.end(), [](const Member& p, const Member& q) {
        return std::tie(p.group, p.part, p.chain) < std::tie(q.group, q.part, q.chain);
    });
}

void BodyContacts::find_self_contacts(const Body& cloth, double stiffness,
                                      std::vector<ClothSelfContact>& self_contacts) {
    const auto body = static_cast<std::uint32_t>(&cloth - state_.bodies.data());
    local_.done.work += s_.projected.size();
    measure_moves();
    for (Contact& contact : s_.projected) {
        if (contact.body_a != body || contact.body_b != body ||
            contact.distance - max_approach(contact, &Scratch::Listed::moved) > contact.thickness)
            continue;
        contact.stiffness = stiffness;
        const Response found = respond(contact, points_of(contact, scratch_.x));
        if (!(found.along > 0.0)) continue;
        dvec3 slip(0.0), at(0.0);
        for (std::size_t k = 0; k < 4; ++k) {
            const dvec3 x = scratch_.x[contact.points[k]];
            at += found.weights[k] * x;
            slip += found.weights[k] * (x - state_.position[contact.points[k]]);
        }
        slip -= detail::dot(slip, found.normal) * found.normal;
        self_contacts.push_back({contact.points, found.weights, found.normal, found.along, found.across,
                                 found.gap - contact.target, at, slip});
    }
}

/// Sorts contacts by depth, deepest first; unless `all`, drops those too far apart to meet in this substep.
void BodyContacts::begin_projection(bool all) {
    measure_moves();
    const auto distant = [&](const Contact& contact) {
        const double reach = contact.target + max_correction;
        return contact.distance - max_approach(contact, &Scratch::Listed::moved) >
                   contact.thickness + reach ||
               respond(contact, points_of(contact, scratch_.x)).gap > reach;
    };
    if (!all) std::erase_if(s_.projected, distant);
    std::stable_sort(s_.projected.begin(), s_.projected.end(), [](const Contact& p, const Contact& q) {
        return p.distance - p.thickness < q.distance - q.thickness;
    });
}

double BodyContacts::project(bool all) {
    std::vector<dvec3>& x = scratch_.x;
    double worst = 0.0;
    const auto correct = [&](Contact& contact) {
        contact.force = dvec3(0.0);
        const Response found = respond(contact, points_of(contact, x));
        const double depth = contact.target - found.gap;
        if (!(depth > 0.0)) return;
        double freedom = 0.0;
        dvec3 slip(0.0);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t i = contact.points[k];
            freedom += found.weights[k] * found.weights[k] * scratch_.weight[i];
            slip += found.weights[k] * (x[i] - state_.position[i]);
        }
        if (!(freedom > 0.0)) return;
        join(contact);
        worst = std::max(worst, depth / contact.thickness);
        slip -= detail::dot(slip, found.normal) * found.normal;
        const double slip_distance = detail::length(slip),
                     limit = depth * static_cast<double>(state_.settings.friction);
        const dvec3 by = depth * found.normal - (slip_distance > limit ? limit / slip_distance : 1.0) * slip;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t i = contact.points[k];
            x[i] += (found.weights[k] * scratch_.weight[i] / freedom) * by;
        }
    };
    local_.done.work += (all ? s_.contacts.size() : 0) + s_.projected.size();
    if (all) std::for_each(s_.contacts.begin(), s_.contacts.end(), correct);
    std::for_each(s_.projected.begin(), s_.projected.end(), correct);
    return worst;
}

}  // namespace tendril::rope
