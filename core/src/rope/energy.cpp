// The energy bound. A solve that falls short, or depenetration, can leave a body with more energy than it
// had; its velocity is then scaled down until the gain is gone. The direct solver always keeps the bound; the
// others keep it near a collider that strikes the body, or while its links hold their lengths. Slowing cannot
// remove a gain by bending; the step is shortened instead (direct.cpp).
#include <algorithm>
#include <cmath>

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

/// Takes the gain out of motion relative to the rigid motion of the whole, so a free body keeps falling and
/// turning. Near a collider, out of motion relative to the mean, then out of the mean too. A pin takes
/// momentum, so with a pin all motion is scaled alike. Any gain left is stretch, as when a collider appears
/// inside a body: tensions are scaled down, so the links cannot return it as motion.
Substep::Slowdown Substep::Ledger::slowdown() const {
    Slowdown slowdown;
    if (!gains_over(rounding)) return slowdown;
    double remaining_gain = gained_;
    if (pinned_) {
        slowdown.whole_factor = slowdown.relative_factor =
            velocity_scale(kinetic_, gravity_work_ + elastic_release_, remaining_gain);
        remaining_gain -= energy_removed(kinetic_, gravity_work_ + elastic_release_, slowdown.whole_factor);
    } else {
        const auto moved = [&](std::size_t i) { return step_->scratch_.x[i] - step_->state_.position[i]; };
        const bool free = near_ == Scratch::Nearest::None;
        slowdown.whole = step_->rigid_motion(group_, step_->scratch_.x, moved, free ? 1e9 : 0.0);
        const double whole = slowdown.whole.energy / (step_->h_ * step_->h_);
        const double apart = std::max(0.0, kinetic_ - whole);
        slowdown.relative_factor = velocity_scale(apart, elastic_release_, remaining_gain);
        remaining_gain -= energy_removed(apart, elastic_release_, slowdown.relative_factor);
        if (!free) {
            slowdown.whole_factor = velocity_scale(whole, gravity_work_, remaining_gain);
            remaining_gain -= energy_removed(whole, gravity_work_, slowdown.whole_factor);
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

void Substep::add_chain(Ledger& ledger, const Plan::Chain& chain) const {
    Ledger sums = ledger;  // nothing else refers to it: its sums stay in registers
    for (std::uint32_t k = 0; k <= chain.links; ++k) sums.add_particle(plan_.nodes[chain.first_node + k]);
    for (std::uint32_t k = 0; k < chain.links; ++k) sums.add_link(chain.first_link + k);
    ledger = sums;
    ledger.add_bending(chain);
}

/// Whether a link of tied bodies, given by its number in the part, belongs to a grid.
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

Substep::Ledger Substep::ledger_of(Group group) const {
    Ledger ledger(*this, group);
    for (const Member& each : group) {
        if (each.chain == Member::no_chain)
            add_part(ledger, plan_.parts_of(island_)[each.part]);
        else
            add_chain(ledger, plan_.chains[each.chain]);
    }
    return ledger;
}

/// Reports a body's loss and limits its gain.
Substep::Slowdown Substep::limit_gain(const Ledger& ledger) {
    report_.contact_loss += ledger.contact_loss();
    if (ledger.suspended()) ++report_.suspended;
    return state_.settings.solver == Solver::Direct || ledger.bounds_relaxation() ? ledger.slowdown()
                                                                                  : Slowdown{};
}

/// Limits each group as a whole: in contact, one body gains the energy that another loses.
void Substep::limit_energy() {
    each_group([&](std::span<Member> group) {
        if (group.front().slowdown) return;
        const Slowdown slowdown = limit_gain(ledger_of(group));
        for (Member& each : group) each.slowdown = slowdown;
    });
}

/// Scales velocities and the tension of elastic links; positions stay.
void Substep::apply_slowdown() {
    const auto scale_tension = [&](Link& link, const Slowdown& slowdown, bool grid) {
        if (grid || detail::compliance(state_.settings, link) > 0.0)
            link.tension *= static_cast<float>(slowdown.tension_factor);
    };
    for (const Member& each : local_.members) {
        const Slowdown& slowdown = *each.slowdown;
        if (!slowdown.any()) continue;
        each_particle_of({&each, 1}, [&](std::size_t i) {
            if (scratch_.weight[i] == 0.0) return;
            dvec3& by = state_.displacement[i];
            const dvec3 whole = slowdown.whole.at(state_.position[i]);
            by = slowdown.whole_factor * whole + slowdown.relative_factor * (by - whole);
        });
        if (each.chain != Member::no_chain) {
            const Plan::Chain& chain = plan_.chains[each.chain];
            for (std::uint32_t k = 0; k < chain.links; ++k)
                scale_tension(state_.links[chain.first_link + k], slowdown, false);
            continue;
        }
        const Plan::Island& part = plan_.parts_of(island_)[each.part];
        const std::span<const std::uint32_t> links = Plan::part(plan_.links, part.links);
        for (std::size_t i = 0; i < links.size(); ++i)
            scale_tension(state_.links[links[i]], slowdown, part.grid != 0 || tied_in_grid(part, i));
    }
}

}  // namespace tendril::rope
