// The energy bound. A solve that falls short, or depenetration, can leave a body with more energy than it
// had; its velocity is then scaled down until the gain is gone. The direct solver always keeps the bound; the
// others keep it near a collider that strikes the body, or while its links hold their lengths. Slowing cannot
// remove a gain by bending; the step is shortened instead (direct.cpp).
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "rope/body_contacts.hpp"
#include "rope/build.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// A gain of less than this, relative to weight times length, is rounding.
constexpr double rounding = 1e-9;

/// The energy that scaling a velocity by s removes. A shorter displacement also moves the halfway point
/// towards the end of the substep; `released` is the potential energy released between the two.
double energy_removed(double kinetic, double released, double s) {
    return kinetic * (1.0 - s * s) + released * (1.0 - s);
}

/// The largest s that removes `gained`; if none does, the one that removes most.
double velocity_scale(double kinetic, double released, double gained) {
    if (!(gained > 0.0) || !(kinetic > 0.0)) return 1.0;
    const double min_scale = std::clamp(-released / (2.0 * kinetic), 0.0, 1.0);
    const double root = released * released + 4.0 * kinetic * (kinetic + released - gained);
    if (!(root > 0.0)) return min_scale;
    // The form of the root that does not subtract nearly equal numbers.
    const double sum = std::sqrt(root);
    const double s = released > 0.0 ? 2.0 * (kinetic + released - gained) / (sum + released)
                                    : (sum - released) / (2.0 * kinetic);
    return std::clamp(s, min_scale, 1.0);
}

/// Whether a link's length error is so large that it holds uncounted energy.
bool is_strained(const Link& link, const dvec3& along) {
    constexpr double max_strain = 1e-3;  // relative to its length
    const double rest = link.rest;
    return link.kind == Link::Kind::Stretch && std::abs(detail::length(along) - rest) > max_strain * rest;
}

}  // namespace

inline void Substep::Ledger::add_particle(std::size_t i) {
    const dvec3 now = step_->scratch_.x[i] - step_->state_.position[i];
    if (step_->scratch_.weight[i] == 0.0) {
        driven_ = driven_ || now != dvec3(0.0);
        pinned_ = true;
        return;
    }
    const dvec3 then = step_->state_.displacement[i];
    solver_momentum_ += step_->state_.mass[i] * (step_->scratch_.x[i] - step_->scratch_.base[i]);
    const double mass = step_->state_.mass[i], moving = detail::kinetic_energy(mass, now, step_->h_);
    const double half = 0.5 * mass * detail::dot(step_->acceleration_, now);
    mass_ += mass;
    kinetic_ += moving;
    momentum_ += mass * now;
    gravity_work_ += half;
    const double moved = detail::kinetic_energy(mass, then, step_->h_);
    gained_ += moving - moved - half - step_->before_ * 0.5 * mass * detail::dot(step_->acceleration_, then);
    if (step_->has_air_)  // the wind's work does not count as a gain
        gained_ -=
            detail::dot(step_->scratch_.wind_move[i], now + then) * (0.5 * mass / (step_->h_ * step_->h_));
    kinetic_before_ += moved;
    damping_loss_ += (1.0 - step_->damping_ * step_->damping_) * moved;
}

inline void Substep::Ledger::add_link(std::uint32_t number) {
    const State& state = step_->state_;
    const Link& link = state.links[number];
    length_ += link.rest;
    const double compliance = detail::compliance(state.settings, link);
    const dvec3 then = state.position[link.b] - state.position[link.a];
    if (compliance == 0.0) {
        const bool checks_strain = near_ != Scratch::Nearest::None && state.settings.solver != Solver::Direct;
        strained_ = strained_ || (checks_strain && is_strained(link, then));
        return;
    }
    const dvec3 now = step_->scratch_.x[link.b] - step_->scratch_.x[link.a];
    const double tension = step_->scratch_.multiplier[number] / (step_->h_ * step_->h_);
    const double half = detail::elastic_energy(link, compliance, tension, now, now - then);
    gained_ += half - detail::elastic_energy(link, compliance, link.tension, then,
                                             state.displacement[link.b] - state.displacement[link.a]);
    elastic_ += half;
    elastic_release_ += half - detail::elastic_energy(link, compliance, tension, now, dvec3(0.0));
}

/// The solver takes curvatures at both ends of a substep, and so bounds the mean of their energies.
void Substep::Ledger::add_bending(const Plan::Chain& chain) {
    const State& state = step_->state_;
    const Body& body = state.bodies[chain.body];
    if (!detail::bends(state, body)) return;
    const auto energy = [&](auto at) {
        double sum = 0.0;
        for (std::uint32_t k = chain.first_link + 1; k < chain.first_link + chain.links; ++k)
            sum += detail::bending_energy(state, body, state.links[k - 1], state.links[k], at);
        return sum;
    };
    const double now = energy([&](std::uint32_t i) { return step_->scratch_.x[i]; });
    const double start = energy([&](std::uint32_t i) { return state.position[i]; });
    const double then = energy([&](std::uint32_t i) { return state.position[i] - state.displacement[i]; });
    gained_ += 0.5 * (now - then);
    elastic_release_ += 0.5 * (start - now);
}

/// The links of a cloth are too stiff for lengths halfway; its solver has summed their energy at the end.
void Substep::Ledger::add_cloth(const detail::Cloth& cloth) {
    length_ += cloth.energy.length;
    gained_ += cloth.energy.gained;
    elastic_ += cloth.energy.elastic;
}

bool Substep::Ledger::gains_over(double part) const {
    return gained() > 0.0 && gained() > part * mass_ * length_ * detail::length(step_->acceleration_);
}

/// Removes the gain from motion relative to the mean, and only near a collider from the mean too: a free body
/// keeps falling freely. A pin takes momentum, so with one all motion is scaled alike. Any remaining gain is
/// stretch, such as that of a body in which a collider appeared: tensions are scaled down, so that the links
/// cannot return it as motion.
Substep::Slowdown Substep::Ledger::slowdown() const {
    Slowdown slowdown;
    if (!gains_over(rounding)) return slowdown;
    double remaining_gain = gained_;
    if (pinned_) {
        slowdown.mean_factor = slowdown.relative_factor =
            velocity_scale(kinetic_, gravity_work_ + elastic_release_, remaining_gain);
        remaining_gain -= energy_removed(kinetic_, gravity_work_ + elastic_release_, slowdown.mean_factor);
    } else {
        slowdown.mean = (1.0 / mass_) * momentum_;
        const double whole = detail::kinetic_energy(mass_, slowdown.mean, step_->h_);
        const double apart = std::max(0.0, kinetic_ - whole);
        slowdown.relative_factor = velocity_scale(apart, elastic_release_, remaining_gain);
        remaining_gain -= energy_removed(apart, elastic_release_, slowdown.relative_factor);
        if (near_ != Scratch::Nearest::None) {
            slowdown.mean_factor = velocity_scale(whole, gravity_work_, remaining_gain);
            remaining_gain -= energy_removed(whole, gravity_work_, slowdown.mean_factor);
        }
    }
    slowdown.remaining_gain = remaining_gain;
    if ((near_ != Scratch::Nearest::None || !pinned_) && remaining_gain > 0.0 && elastic_ > 0.0)
        slowdown.tension_factor = std::sqrt(std::max(0.0, 1.0 - remaining_gain / elastic_));
    return slowdown;
}

bool Substep::Ledger::leaves_gain(double part) const {
    return slowdown().remaining_gain >
           part * std::max(kinetic_before_, mass_ * length_ * detail::length(step_->acceleration_));
}

double Substep::Ledger::contact_loss() const {
    return near_ != Scratch::Nearest::None && !driven_ ? std::max(0.0, -gained_ - damping_loss_) : 0.0;
}

bool Substep::Ledger::suspended() const {
    constexpr double min_force = 0.1;  // relative to its weight
    const double fall = step_->h_ * step_->h_ * detail::length(step_->acceleration_);
    return near_ == Scratch::Nearest::None && !pinned_ && fall > 0.0 &&
           detail::length(solver_momentum_) > min_force * mass_ * fall;
}

Substep::Ledger Substep::ledger_of(const Plan::Chain& chain) const {
    Ledger ledger(*this, scratch_.body_near[chain.body]);
    add_chain(ledger, chain);
    return ledger;
}

void Substep::add_chain(Ledger& ledger, const Plan::Chain& chain) const {
    Ledger sums = ledger;  // nothing else refers to it: its sums stay in registers
    for (std::uint32_t k = 0; k <= chain.links; ++k) sums.add_particle(plan_.nodes[chain.first_node + k]);
    for (std::uint32_t k = 0; k < chain.links; ++k) sums.add_link(chain.first_link + k);
    ledger = sums;
    ledger.add_bending(chain);
}

/// Whether a link of tied bodies, by its number in the part, is a grid's.
bool Substep::tied_in_grid(const Plan::Island& part, std::size_t link) const {
    return part.tied != 0 && plan_.tied[part.tied - 1].link_blocks[link] == Plan::no_block;
}

void Substep::add_part(Ledger& ledger, const Plan::Island& part) const {
    each_particle_of(part, [&](std::size_t i) { ledger.add_particle(i); });
    const bool direct = state_.settings.solver == Solver::Direct;
    if (direct && part.grid != 0) return ledger.add_cloth(scratch_.cloths[part.grid - 1]);
    const Plan::Range grids = direct && part.tied != 0 ? plan_.tied[part.tied - 1].grids : Plan::Range{};
    for (std::uint32_t g = 0; g < grids.count; ++g) ledger.add_cloth(scratch_.cloths[grids.first + g]);
    if (direct && part.tied != 0)
        for (const Plan::Chain& chain : Plan::part(plan_.chains, part.chains)) ledger.add_bending(chain);
    const std::span<const std::uint32_t> links = Plan::part(plan_.links, part.links);
    for (std::size_t k = 0; k < links.size(); ++k)
        if (!direct || !tied_in_grid(part, k)) ledger.add_link(links[k]);
}

Substep::Ledger Substep::ledger_of(const Plan::Island& part) const {
    Scratch::Nearest near = Scratch::Nearest::None;
    for (const std::uint32_t body : Plan::part(plan_.bodies, part.bodies))
        near = std::max(near, scratch_.body_near[body]);
    Ledger ledger(*this, near);
    add_part(ledger, part);
    return ledger;
}

/// Reports a body's loss and limits its gain.
Substep::Slowdown Substep::limit_gain(const Ledger& ledger) {
    report_.contact_loss += ledger.contact_loss();
    if (ledger.suspended()) ++report_.suspended;
    return state_.settings.solver == Solver::Direct || ledger.bounds_relaxation() ? ledger.slowdown()
                                                                                  : Slowdown{};
}

/// Limits each part of an island by itself, and bodies that contacts join together: one gains the energy that
/// another loses.
void Substep::limit_energy() {
    const std::span<const Plan::Island> parts = plan_.parts_of(island_);
    local_.part_slowdown.assign(parts.size(), {});
    std::span<const std::uint32_t> groups;
    if (island_.contacts != 0) groups = BodyContacts(*this).group_bodies(BodyContacts::Joined::Touching);
    const auto group_of = [&](std::uint32_t body) {
        return groups.empty() ? body : scratch_.body_group[body];
    };
    const auto each_part = [&](auto visit, auto visit_chain) {
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const Plan::Range& chains = parts[k].chains;
            if (!parts[k].isolated) visit(k, group_of(plan_.bodies[parts[k].bodies.first]));
            for (std::uint32_t r = chains.first; parts[k].isolated && r < chains.first + chains.count; ++r)
                visit_chain(r, group_of(plan_.chains[r].body));
        }
    };
    const auto alone = [&](std::uint32_t group) {
        return !std::binary_search(groups.begin(), groups.end(), group);
    };
    each_part(
        [&](std::size_t k, std::uint32_t group) {
            if (alone(group)) local_.part_slowdown[k] = limit_gain(ledger_of(parts[k]));
        },
        [&](std::uint32_t r, std::uint32_t group) {
            if (alone(group) && !scratch_.chain_slowdown[r])
                scratch_.chain_slowdown[r] = limit_gain(ledger_of(plan_.chains[r]));
        });
    for (const std::uint32_t group : groups) {
        Scratch::Nearest near = Scratch::Nearest::None;
        for (const std::uint32_t body : Plan::part(plan_.bodies, island_.bodies))
            if (group_of(body) == group) near = std::max(near, scratch_.body_near[body]);
        Ledger ledger(*this, near);
        each_part(
            [&](std::size_t k, std::uint32_t of) {
                if (of == group) add_part(ledger, parts[k]);
            },
            [&](std::uint32_t r, std::uint32_t of) {
                if (of == group) add_chain(ledger, plan_.chains[r]);
            });
        const Slowdown slowdown = limit_gain(ledger);
        each_part(
            [&](std::size_t k, std::uint32_t of) {
                if (of == group) local_.part_slowdown[k] = slowdown;
            },
            [&](std::uint32_t r, std::uint32_t of) {
                if (of == group) scratch_.chain_slowdown[r] = slowdown;
            });
    }
}

/// Scales velocities and the tension of elastic links; positions stay.
void Substep::apply_slowdown() {
    const auto slow = [&](std::size_t i, const Slowdown& slowdown) {
        if (scratch_.weight[i] == 0.0) return;
        dvec3& by = state_.displacement[i];
        by = slowdown.mean_factor * slowdown.mean + slowdown.relative_factor * (by - slowdown.mean);
    };
    const auto scale_tension = [&](Link& link, const Slowdown& slowdown, bool grid) {
        if (grid || detail::compliance(state_.settings, link) > 0.0)
            link.tension *= static_cast<float>(slowdown.tension_factor);
    };
    const std::span<const Plan::Island> parts = plan_.parts_of(island_);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const Slowdown& slowdown = local_.part_slowdown[k];
        if (!slowdown.any()) continue;
        each_particle_of(parts[k], [&](std::size_t i) { slow(i, slowdown); });
        const std::span<const std::uint32_t> links = Plan::part(plan_.links, parts[k].links);
        for (std::size_t i = 0; i < links.size(); ++i)
            scale_tension(state_.links[links[i]], slowdown, parts[k].grid != 0 || tied_in_grid(parts[k], i));
    }
    for (std::uint32_t r = island_.chains.first; r < island_.chains.first + island_.chains.count; ++r) {
        const std::optional<Slowdown> balanced = std::exchange(scratch_.chain_slowdown[r], std::nullopt);
        if (!balanced || !balanced->any()) continue;
        const Slowdown& slowdown = *balanced;
        const Plan::Chain& chain = plan_.chains[r];
        for (std::uint32_t k = 0; k <= chain.links; ++k) slow(plan_.nodes[chain.first_node + k], slowdown);
        for (std::uint32_t k = 0; k < chain.links; ++k)
            scale_tension(state_.links[chain.first_link + k], slowdown, false);
    }
}

}  // namespace tendril::rope
