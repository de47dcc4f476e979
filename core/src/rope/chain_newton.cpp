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
constexpr int few_steps = 4;      ///< after these a larger error is accepted
constexpr int release_steps = 8;  ///< in these contacts may be dropped
constexpr int max_rejected = 3;   ///< consecutive steps that may be repeated
/// Minimum link compliance over h^2, relative to the inverse mass of its ends. A link that cannot reach its
/// length stretches just enough to keep its tension finite. A metre of rope, 64 segments, carrying a hundred
/// times its weight stretches by a millionth.
constexpr double min_compliance = 1e-8;
constexpr double accepted = 1e-5;  ///< relative length error
/// Number of times that steps may diverge before links keep their resistance to turning: a fold that
/// runs along a rope would otherwise make them diverge again and again, to the end.
constexpr int max_relapses = 2;
constexpr double first_stiffer = 10.0;
constexpr double grown_too_far = 0.25, turned_too_far = 0.5;

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
    s_.kept.resize(chain.links + 1);
    for (std::uint32_t k = 0; k <= chain.links; ++k) {
        const std::uint32_t i = particle(k);
        detail::ChainNode& node = s_.nodes[k];
        node.base = scratch_.base[i];
        node.pinned = scratch_.weight[i] == 0.0;
        node.x = node.pinned ? node.base : state_.position[i];
        node.mass = state_.mass[i];
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
    s_.holds.assign(s_.contacts.size(), {});
    for (std::size_t c = 0; c < s_.contacts.size(); ++c) {
        ContactScratch::Contact& contact = s_.contacts[c];
        s_.nodes[contact.node].contact = static_cast<std::int32_t>(c);
        for (std::uint32_t p = 0; p < contact.count; ++p) begin_plane(contact, s_.planes[contact.first + p]);
    }
    s_.bond_holds.assign(s_.link_contacts.size(), {});
    s_.kept_contacts.assign(s_.link_contacts.size(), 0.0);
    for (std::size_t c = 0; c < s_.link_contacts.size(); ++c) {
        s_.bonds[s_.link_contacts[c].bond].contact = static_cast<std::int32_t>(c);
        s_.link_contacts[c].collider = ~0u;
    }
    s_.pushes.clear();
    begin_bends();
    s_.progress = {};
    detail::ChainSystem system = this->system();
    system.evaluate(0.0);
    s_.progress.worst = system.largest_error();
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

void ChainNewton::keep() {
    for (std::size_t k = 0; k < s_.nodes.size(); ++k) {
        s_.kept[k].x = s_.nodes[k].x;
        if (k == s_.bonds.size()) break;
        s_.kept[k].multiplier = s_.bonds[k].multiplier;
        s_.kept[k].error = s_.bonds[k].error;
    }
    for (std::size_t c = 0; c < s_.bond_holds.size(); ++c) s_.kept_contacts[c] = s_.bond_holds[c].multiplier;
}

/// Reduces the last step to a part.
void ChainNewton::go_back(double part) {
    // NaN must not survive: part 0 assigns.
    const auto back = [&](auto& to, const auto& from) { to = part > 0.0 ? from + part * (to - from) : from; };
    for (std::size_t k = 0; k < s_.nodes.size(); ++k) {
        back(s_.nodes[k].x, s_.kept[k].x);
        if (k < s_.bonds.size()) back(s_.bonds[k].multiplier, s_.kept[k].multiplier);
    }
    for (std::size_t c = 0; c < s_.bond_holds.size(); ++c)
        back(s_.bond_holds[c].multiplier, s_.kept_contacts[c]);
}

/// Whether a link has grown or shrunk too much. `turned`: the largest change of a link's direction, relative
/// to its length.
bool ChainNewton::went_too_far(double& turned) const {
    bool diverged = false, numbers = true;
    turned = 0.0;
    for (std::size_t k = 0; k < s_.bonds.size(); ++k) {
        const double rest = s_.bonds[k].rest;
        numbers &= std::isfinite(s_.bonds[k].error);
        diverged |= !(std::abs(s_.bonds[k].error) <= grown_too_far * rest + std::abs(s_.kept[k].error));
        const dvec3 before = s_.kept[k + 1].x - s_.kept[k].x, now = s_.nodes[k + 1].x - s_.nodes[k].x;
        const double squared = std::max({rest * rest, detail::dot(before, before), 1e-18});
        turned = std::max(turned, detail::dot(now - before, now - before) / squared);
    }
    turned = numbers ? std::sqrt(turned) : std::numeric_limits<double>::infinity();
    return diverged;
}

void ChainNewton::solve() {
    begin();
    while (step(false, false)) {
    }
    finish();
}

bool ChainNewton::step(bool presses, bool more) {
    detail::ChainSystem system = this->system();
    auto& p = s_.progress;
    const int steps = std::min(max_steps, state_.settings.iterations);
    if (presses) system.evaluate(p.stiffer);
    p.may_release = p.taken <= release_steps;
    const bool changed = update_contacts();
    const double enough = p.taken <= few_steps ? accepted
                          : p.may_release      ? 10.0 * accepted
                                               : 100.0 * accepted;
    const bool done =
        p.moved && !changed && p.worst <= enough && (p.used == 0.0 || p.relapses == max_relapses);
    if ((done && !more) || p.taken == steps) return false;
    if (++p.taken == few_steps)  // too fast for the mean of directions: the latest alone converges
        for (detail::ChainBend& bend : s_.bends) bend.direction = dvec3(0.0);
    keep();
    system.step();
    local_.done.work += s_.bonds.size();
    system.evaluate(p.stiffer);
    const bool diverged = went_too_far(p.turned);
    if (diverged && p.rejected < max_rejected) {
        if (p.rejected == 0) p.relapses = std::min(p.relapses + 1, max_relapses);
        ++p.rejected;
        p.stiffer = std::max(first_stiffer, 100.0 * p.stiffer);
        go_back(0.0);
        system.evaluate(p.stiffer);
        return true;
    }
    p.rejected = 0;
    if (diverged && p.turned > turned_too_far) {
        go_back(turned_too_far / p.turned);
        system.evaluate(p.stiffer);
    }
    p.moved = true;
    p.used = p.stiffer;
    const double before = std::exchange(p.worst, system.largest_error());
    if (p.relapses < max_relapses)
        p.stiffer = p.stiffer > first_stiffer ? 0.1 * p.stiffer : 0.0;
    else
        p.stiffer = std::max(p.worst > 0.5 * before ? 10.0 * p.stiffer : p.stiffer, first_stiffer);
    return true;
}

void ChainNewton::finish() {
    const Plan::Chain& chain = plan_.chains[chain_];
    for (std::uint32_t k = 0; k <= chain.links; ++k) {
        const std::uint32_t i = particle(k);
        if (scratch_.weight[i] > 0.0) scratch_.place[i] = s_.nodes[k].x;
        if (k < chain.links) scratch_.multiplier[chain.first_link + k] = s_.bonds[k].multiplier;
    }
    const auto& p = s_.progress;
    scratch_.chain_error[chain_] = p.worst;
    local_.done.passes = std::max(local_.done.passes, p.taken);
    const bool spent = p.taken == std::min(max_steps, state_.settings.iterations);
    if (spent && !(p.worst <= 100.0 * accepted)) ++local_.done.unconverged;
}

}  // namespace tendril::rope
