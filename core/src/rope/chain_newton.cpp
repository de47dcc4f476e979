#include "rope/chain_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rope/build.hpp"
#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

constexpr int max_steps = 16;
constexpr int strict_steps = 4;   ///< a larger error is accepted after these
constexpr int release_steps = 8;  ///< contacts may be dropped during these
constexpr int max_rejected = 3;   ///< rejected steps in a row
/// Minimum link compliance over h^2, relative to the inverse mass of its ends. A link that cannot reach its
/// length stretches just enough to keep its tension finite. A metre of rope, 64 segments, carrying a hundred
/// times its weight stretches by a millionth.
constexpr double min_compliance = 1e-8;
constexpr double max_length_error = 1e-5;  ///< relative length error
/// After this many divergences links keep their extra stiffness, or a fold running along would cause more.
constexpr int max_divergences = 2;
constexpr double first_extra_stiffness = 10.0;
constexpr double max_growth = 0.25, max_turn = 0.5;

}  // namespace

std::uint32_t ChainNewton::particle(std::uint32_t node) const {
    return plan_.nodes[plan_.chains[chain_].first_node + node];
}

/// Starts at the beginning of the substep, with the tension of the previous one.
void ChainNewton::begin() {
    const Plan::Chain& chain = plan_.chains[chain_];
    const double h = state_.settings.substep, square = h * h;
    s_.nodes.resize(chain.links + 1);
    s_.bonds.resize(chain.links);
    s_.saved.resize(chain.links + 1);
    double mass = 0.0;
    for (std::uint32_t k = 0; k <= chain.links; ++k) {
        const std::uint32_t i = particle(k);
        detail::ChainNode& node = s_.nodes[k];
        node.base = scratch_.base[i];
        node.pinned = scratch_.weight[i] == 0.0;
        node.x = node.pinned ? node.base : state_.position[i];
        mass += node.mass = state_.mass[i];
        node.contact = node.push = -1;
        if (k == chain.links) break;
        const Link& link = state_.links[chain.first_link + k];
        detail::ChainBond& bond = s_.bonds[k];
        bond.rest = link.rest;
        bond.compliance = detail::compliance(state_.settings, link) / square;
        const double weights = scratch_.weight[i] + scratch_.weight[particle(k + 1)];
        bond.compliance = std::max(bond.compliance, min_compliance * weights);
        bond.multiplier = std::max(0.0, static_cast<double>(link.tension) * square);
        bond.contact = -1;
    }
    s_.node_effects.assign(s_.contacts.size(), {});
    for (std::size_t c = 0; c < s_.contacts.size(); ++c) {
        ContactScratch::Contact& contact = s_.contacts[c];
        s_.nodes[contact.node].contact = static_cast<std::int32_t>(c);
        contact.drag = 0.0;
        for (std::uint32_t p = 0; p < contact.count; ++p) begin_plane(contact, s_.planes[contact.first + p]);
    }
    s_.bond_effects.clear();
    for (ContactScratch::LinkContact& contact : s_.link_contacts) {
        s_.bonds[contact.bond].contact = static_cast<std::int32_t>(s_.bond_effects.size());
        s_.bond_effects.resize(s_.bond_effects.size() + detail::ChainBond::max_contacts);
        contact.touches = {};
    }
    s_.saved_contacts.assign(s_.bond_effects.size(), 0.0);
    s_.pushes.clear();
    begin_bends();
    s_.progress = {.mass = mass};
    detail::ChainSystem system = this->system();
    system.evaluate(0.0);
    s_.progress.worst = system.max_error();
}

void ChainNewton::begin_bends() {
    const Plan::Chain& chain = plan_.chains[chain_];
    const Body& body = state_.bodies[chain.body];
    s_.bends.clear();
    if (!detail::bends(state_, body)) return;
    s_.bends.resize(s_.nodes.size());
    const auto earlier = [&](std::uint32_t node) {
        const std::uint32_t i = particle(node);
        return state_.position[i] - state_.displacement[i];
    };
    const Link* const links = &state_.links[chain.first_link];
    for (std::uint32_t k = 1; k < chain.links; ++k) {
        detail::ChainBend &last = s_.bends[k - 1], &bend = s_.bends[k], &next = s_.bends[k + 1];
        const detail::ChainBend is = detail::bend_between(state_, body, links[k - 1], links[k]);
        bend.stiffness = is.stiffness, bend.before = is.before, bend.after = is.after;
        const double now = detail::bend_ahead * bend.stiffness, both = bend.before + bend.after;
        bend.earlier = (bend.stiffness - now) * bend.curvature(earlier(k - 1), earlier(k), earlier(k + 1));
        last.own += now * bend.before * bend.before;
        bend.own += now * both * both;
        next.own += now * bend.after * bend.after;
        last.to_next -= now * bend.before * both;
        bend.to_next -= now * bend.after * both;
        last.to_second += now * bend.before * bend.after;
    }
    if (!s_.contacts.empty() || !s_.link_contacts.empty()) return;
    for (std::uint32_t k = 0; k < chain.links; ++k)
        s_.bends[k].direction = detail::unit(earlier(k + 1) - earlier(k));
}

void ChainNewton::save_state() {
    for (std::size_t k = 0; k < s_.nodes.size(); ++k) {
        s_.saved[k].x = s_.nodes[k].x;
        if (k == s_.bonds.size()) break;
        s_.saved[k].multiplier = s_.bonds[k].multiplier;
        s_.saved[k].error = s_.bonds[k].error;
    }
    for (std::size_t c = 0; c < s_.bond_effects.size(); ++c)
        s_.saved_contacts[c] = s_.bond_effects[c].multiplier;
}

/// Scales the last step down.
void ChainNewton::scale_step(double part) {
    // Part 0 assigns the old value, so that no NaN survives.
    const auto scale = [&](auto& to, const auto& from) {
        to = part > 0.0 ? from + part * (to - from) : from;
    };
    for (std::size_t k = 0; k < s_.nodes.size(); ++k) {
        scale(s_.nodes[k].x, s_.saved[k].x);
        if (k < s_.bonds.size()) scale(s_.bonds[k].multiplier, s_.saved[k].multiplier);
    }
    for (std::size_t c = 0; c < s_.bond_effects.size(); ++c)
        scale(s_.bond_effects[c].multiplier, s_.saved_contacts[c]);
}

/// Whether a link has grown or shrunk too much, or the chain moved farther than its length and free path.
/// `turn`: the largest change of a link relative to its length, or of the first node to the chain's.
bool ChainNewton::has_diverged(double& turn) const {
    bool diverged = false, finite = true;
    turn = 0.0;
    double whole = detail::length(s_.nodes[0].base - state_.position[particle(0)]);
    for (std::size_t k = 0; k < s_.bonds.size(); ++k) {
        const double rest = s_.bonds[k].rest;
        finite &= std::isfinite(s_.bonds[k].error);
        diverged |= !(std::abs(s_.bonds[k].error) <= max_growth * rest + std::abs(s_.saved[k].error));
        const dvec3 before = s_.saved[k + 1].x - s_.saved[k].x, now = s_.nodes[k + 1].x - s_.nodes[k].x;
        const double squared = std::max({rest * rest, detail::dot(before, before), 1e-18});
        whole += std::sqrt(squared);
        turn = std::max(turn, detail::dot(now - before, now - before) / squared);
    }
    const double shift = detail::length(s_.nodes[0].x - s_.saved[0].x) / whole;
    diverged |= !(shift <= 1.0);
    turn = finite ? std::max(shift, std::sqrt(turn)) : std::numeric_limits<double>::infinity();
    return diverged;
}

void ChainNewton::solve() {
    begin();
    while (step(false, false)) {
    }
    finish();
}

bool ChainNewton::step(bool pushes_changed, bool force_step) {
    detail::ChainSystem system = this->system();
    auto& p = s_.progress;
    const int steps = std::min(max_steps, state_.settings.iterations);
    if (pushes_changed) system.evaluate(p.extra_stiffness);
    p.may_release = p.steps_taken <= release_steps;
    const bool changed = update_contacts();
    const double tolerance = p.steps_taken <= strict_steps ? max_length_error
                             : p.may_release               ? 10.0 * max_length_error
                                                           : 100.0 * max_length_error;
    const bool done = p.moved && !changed && p.worst <= tolerance &&
                      (p.used_stiffness == 0.0 || p.divergences == max_divergences);
    if ((done && !force_step) || p.steps_taken == steps) return false;
    if (++p.steps_taken == strict_steps)  // too fast for the mean of directions; the latest one converges
        for (detail::ChainBend& bend : s_.bends) bend.direction = dvec3(0.0);
    save_state();
    system.step();
    local_.done.work += s_.bonds.size();
    system.evaluate(p.extra_stiffness);
    const bool diverged = has_diverged(p.turn);
    if (diverged && p.rejected < max_rejected) {
        if (p.rejected == 0) p.divergences = std::min(p.divergences + 1, max_divergences);
        ++p.rejected;
        p.extra_stiffness = std::max(first_extra_stiffness, 100.0 * p.extra_stiffness);
        scale_step(0.0);
        system.evaluate(p.extra_stiffness);
        return true;
    }
    p.rejected = 0;
    if (diverged && p.turn > max_turn) {
        scale_step(max_turn / p.turn);
        system.evaluate(p.extra_stiffness);
    }
    p.moved = true;
    p.used_stiffness = p.extra_stiffness;
    const double before = std::exchange(p.worst, system.max_error());
    if (p.divergences < max_divergences)
        p.extra_stiffness = p.extra_stiffness > first_extra_stiffness ? 0.1 * p.extra_stiffness : 0.0;
    else
        p.extra_stiffness = std::max(p.worst > 0.5 * before ? 10.0 * p.extra_stiffness : p.extra_stiffness,
                                     first_extra_stiffness);
    return true;
}

void ChainNewton::finish() {
    const Plan::Chain& chain = plan_.chains[chain_];
    for (std::uint32_t k = 0; k <= chain.links; ++k) {
        const std::uint32_t i = particle(k);
        if (scratch_.weight[i] > 0.0) scratch_.x[i] = s_.nodes[k].x;
        if (k < chain.links) scratch_.multiplier[chain.first_link + k] = s_.bonds[k].multiplier;
    }
    push_colliders();
    const auto& p = s_.progress;
    scratch_.chain_error[chain_] = p.worst;
    local_.done.passes = std::max(local_.done.passes, p.steps_taken);
    const bool exhausted = p.steps_taken == std::min(max_steps, state_.settings.iterations);
    if (exhausted && !(p.worst <= 100.0 * max_length_error)) ++local_.done.unconverged;
}

}  // namespace tendril::rope
