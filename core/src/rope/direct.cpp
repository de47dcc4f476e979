// The direct solver: solves whole chains at once, side by side in the lanes of a vector register.
//
// An isolated chain first moves by its previous tension, applied implicitly; then one or two passes correct
// its lengths. If it moves too fast for that (a whip cracks), or would gain energy, it is solved again from
// that result: twice as before, then with tension along the links' new directions, which converges and costs
// energy.
//
// A chain that touches colliders is solved with its contacts, by Newton's method (chain_newton.hpp). A cloth
// that is a grid is one system with its contacts (cloth_solver.hpp), and so are bodies that ties join
// (tied_solver.hpp). If chains share particles in another way, as in hair, contacts are resolved last: the
// depth to which tension pulls a particle into a collider bounds friction. The next substep corrects the
// length errors that remain.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "rope/body_contacts.hpp"
#include "rope/build.hpp"
#include "rope/chain_newton.hpp"
#include "rope/cloth_solver.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"
#include "rope/tied_solver.hpp"

namespace tendril::rope {
namespace {

using detail::Block;
using detail::Row;
using detail::SolveJob;
using glm::dvec3;

constexpr double length_tolerance = 1e-7;       ///< relative length error that needs no correction
constexpr double accepted_error = 1e-4;         ///< a chain with more is solved again
constexpr double accepted_shared_error = 1e-3;  ///< the same if chains share particles
constexpr double fallback_error = 0.02;         ///< above it a chain's body is relaxed
constexpr double accepted_gain = 1e-3;          ///< a result that gains more energy is rejected
constexpr int max_restarts = 8, mean_restarts = 2, fallback_passes = 16, max_step_halvings = 10;
/// Minimum passes of chains that share particles, while near a collider.
constexpr int min_contact_passes = 4;
/// Rounds in which contacts are projected, and their accepted error, relative to the thickness.
constexpr int projection_rounds = 8;
constexpr double projection_tolerance = 1e-3;
/// A chain that shares particles may have impossible lengths, as when straight between two pins. Its system
/// is damped (Levenberg, Marquardt), or it would fling its particles about.
constexpr double shared_damping = 2e-2;
/// The part of tension that acts along the new direction rather than the mean, for each second of a substep,
/// and its maximum. It damps the jitter of single particles within a second; in longer substeps more of it
/// would stop a swing.
constexpr double backward_rate = 2.4, max_backward = 0.01;

}  // namespace

/// Chains solved side by side: `count` of them from `chain` on, in the lanes of a block.
struct Substep::Batch {
    std::uint32_t chain = 0, count = 1;
    bool single = false;
};

double Substep::backward() const {
    return std::min(max_backward, backward_rate * h_);
}

/// Solves chains that share nothing. A chain that touches something is solved with its contacts, any other as
/// if in the air; if it then ends inside a collider, or fails, it is solved again with contacts.
int Substep::direct_isolated() {
    ChainNewton newton(state_, plan_, island_, scratch_, local_);
    const std::uint32_t first = island_.chains.first, end = first + island_.chains.count;
    const auto near = [&](std::uint32_t r) { return is_near(plan_.chains[r].body); };
    const auto bends = [&](std::uint32_t r) {
        return detail::bends(state_, state_.bodies[plan_.chains[r].body]);
    };
    const auto solve = [&](std::uint32_t r) {
        newton.solve();
        const bool falls = acceleration_ != dvec3(0.0);
        if (falls && !bends(r) && ledger_of(std::array{Member{.chain = r}}).gains_over(accepted_gain))
            scale_correction(plan_.chains[r]);
    };
    for (std::uint32_t r = first; r < end; ++r) {
        if (scratch_.chain_solved[r] != 0) continue;
        const bool found = (bends(r) || near(r)) && newton.find(r);
        if (!bends(r) && !(found && newton.touches())) continue;
        scratch_.chain_solved[r] = 1;
        solve(r);
    }
    report_.work += island_.links.count;
    for (const Plan::Group& group : Plan::part(plan_.groups, island_.groups)) solve_group(group, 0);
    for (std::uint32_t r = first; r < end; ++r) {
        if (scratch_.chain_solved[r] != 0) continue;
        const bool failed = !(scratch_.chain_error[r] <= fallback_error);
        const bool found = (failed || near(r)) && newton.find(r);
        if (failed || (found && newton.inside())) solve(r);
    }
    measure();
    return 1;
}

/// Shortens the steps of chains that resist bending, unless they touch others and may gain energy from them.
void Substep::shorten_steps() {
    std::span<const std::uint32_t> together;
    if (island_.contacts != 0) together = scratch_.body_contacts[island_.contacts - 1].chains;
    bool found = false;
    const std::uint32_t first = island_.chains.first, end = first + island_.chains.count;
    for (std::uint32_t r = first; r < end; ++r) {
        const Plan::Chain& chain = plan_.chains[r];
        if (!chain.isolated || !detail::bends(state_, state_.bodies[chain.body])) continue;
        if (std::binary_search(together.begin(), together.end(), r)) continue;
        if (!std::exchange(found, true)) find_near();
        shorten_step(r);
    }
    if (found) restore_momentum();
}

/// Cuts a step that gains energy, ends in a collider, or did not converge. Scaling velocities would not
/// remove a gain by bending. If halving fails, particles stay or step back, which gains nothing.
void Substep::shorten_step(std::uint32_t number) {
    const Plan::Chain& chain = plan_.chains[number];
    // A moving collider must take the chain along.
    if (scratch_.body_near[chain.body] == Scratch::Nearest::Moving) return;
    const std::array<Member, 1> alone{Member{.chain = number}};
    const bool failed = !(scratch_.chain_error[number] <= fallback_error);
    const auto stretch = [&](const std::vector<dvec3>& at) {
        double worst = 0.0;
        for (std::uint32_t k = 0; k < chain.links; ++k) {
            const Link& link = state_.links[chain.first_link + k];
            const double rest = std::max(static_cast<double>(link.rest), 1e-9);
            worst = std::max(worst, std::abs(detail::length(at[link.b] - at[link.a]) - rest) / rest);
        }
        return worst;
    };
    const double max_stretch = failed ? fallback_error + stretch(state_.position) : 0.0;
    double deepest = -1.0;
    const auto is_bad = [&] {
        if (failed && !(stretch(scratch_.x) <= max_stretch)) return true;
        const Ledger ledger = ledger_of(alone);
        if (ledger.leaves_gain(accepted_gain)) return true;
        if (ledger.gains_over(accepted_gain) && correction_scale(chain) < 1.0) return true;
        if (depth_of(chain, scratch_.x) <= penetration_slop) return false;
        if (deepest < 0.0) deepest = std::max(penetration_slop, depth_of(chain, state_.position));
        return depth_of(chain, scratch_.x) > deepest;
    };
    const auto each = [&](auto move) {
        for (std::uint32_t k = 0; k <= chain.links; ++k) {
            const std::uint32_t i = plan_.nodes[chain.first_node + k];
            if (scratch_.weight[i] > 0.0) scratch_.x[i] = move(i);
        }
    };
    if (!is_bad()) return;
    ++report_.fallbacks;
    for (int i = 0; i < max_step_halvings && is_bad(); ++i)
        each([&](std::uint32_t p) { return 0.5 * (state_.position[p] + scratch_.x[p]); });
    for (const double back : {0.0, 0.5, 1.0}) {
        if (!is_bad()) break;
        each([&](std::uint32_t p) { return state_.position[p] - back * state_.displacement[p]; });
    }
}

/// Factor that limits a chain's correction to correction_speed or the speed of its fastest particle.
double Substep::correction_scale(const Plan::Chain& chain) const {
    double largest = 0.0, limit = correction_speed * h_;
    for (std::uint32_t k = 0; k <= chain.links; ++k) {
        const std::uint32_t i = plan_.nodes[chain.first_node + k];
        largest = std::max(largest, detail::length(scratch_.x[i] - scratch_.base[i]));
        limit = std::max(limit, detail::length(scratch_.base[i] - state_.position[i]));
    }
    return largest > limit ? limit / largest : 1.0;
}

/// Scales down a solve that would throw a chain.
void Substep::scale_correction(const Plan::Chain& chain) {
    const double part = correction_scale(chain);
    if (part == 1.0) return;
    ++report_.fallbacks;
    for (std::uint32_t k = 0; k <= chain.links; ++k) {
        const std::uint32_t i = plan_.nodes[chain.first_node + k];
        scratch_.x[i] = scratch_.base[i] + part * (scratch_.x[i] - scratch_.base[i]);
    }
}

int Substep::direct_grid() {
    ClothSolver cloth(*this);
    const int allowed = passes_allowed(), passes = cloth.solve(allowed);
    report_.work += static_cast<std::uint64_t>(passes) * island_.links.count;
    if (!cloth.converged() && allowed < state_.settings.iterations) report_.shortened = 1;
    if (cloth.step_scale() < 1.0) ++report_.fallbacks;
    measure();
    return passes;
}

int Substep::direct_tied() {
    TiedSolver tied(*this);
    const int steps = tied.solve(passes_allowed());
    if (!tied.converged()) ++report_.unconverged;
    if (tied.shortened()) ++report_.fallbacks;
    measure();
    return steps;
}

int Substep::direct() {
    const auto solved = scratch_.chain_solved.begin() + island_.chains.first;
    std::fill(solved, solved + island_.chains.count, std::uint8_t{0});
    if (island_.contacts != 0) BodyContacts(*this).solve();
    if (island_.parts.count == 0) {
        const int passes = direct_part();
        if (island_.contacts != 0) project_contacts();
        return passes;
    }
    int passes = 0;
    for (const Plan::Island& part : Plan::part(plan_.parts, island_.parts)) {
        Substep step(*this, part);
        step.find_near();
        passes = std::max(passes, step.direct_part());
    }
    find_near();
    project_contacts();
    return passes;
}

/// Projects the contacts that were not solved with lengths, alternating with colliders and lengths.
void Substep::project_contacts() {
    BodyContacts(*this).begin_projection(false);
    for (int pass = 0; pass < projection_rounds; ++pass) {
        if (BodyContacts(*this).project(false) <= projection_tolerance) break;
        resolve_contacts(false);
        if (pass + 1 == projection_rounds) break;
        for (const std::uint32_t i : Plan::part(plan_.links, island_.links))
            if (state_.links[i].kind == Link::Kind::Stretch)
                satisfy(i, detail::compliance(state_.settings, state_.links[i]));
    }
}

int Substep::direct_part() {
    if (island_.isolated) return direct_isolated();
    if (island_.grid != 0) return direct_grid();
    if (island_.tied != 0) return direct_tied();
    for (const std::uint32_t i : Plan::part(plan_.soft, island_.soft)) scratch_.multiplier[i] = 0.0;
    for (const Plan::Chain& chain : Plan::part(plan_.chains, island_.chains)) {
        if (!chain.isolated) std::fill_n(scratch_.multiplier.begin() + chain.first_link, chain.links, 0.0);
    }
    const bool contact = !local_.near.empty();
    const int max_passes = passes_allowed();
    int passes = 0;
    bool converged = false;
    while (!converged && passes < max_passes) {
        report_.work += island_.links.count;
        satisfy_soft();
        double worst = 0.0;
        for (const Plan::Group& group : Plan::part(plan_.groups, island_.groups))
            worst = std::max(worst, solve_group(group, passes));
        measure();
        resolve_contacts(passes == 0);
        ++passes;
        converged = island_.isolated ||
                    (worst <= accepted_shared_error && (!contact || passes >= min_contact_passes));
    }
    if (!converged && max_passes < state_.settings.iterations) report_.shortened = 1;
    relax_failed_bodies();
    return passes;
}

/// The fallback if chains share particles: relaxes a body that did not converge or whose lengths are
/// impossible.
void Substep::relax_failed_bodies() {
    bool any = false;
    const std::span<const std::uint32_t> bodies = Plan::part(plan_.bodies, island_.bodies);
    for (const std::uint32_t b : bodies) scratch_.body_failed[b] = 0;
    const std::uint32_t first_chain = island_.chains.first, end_chain = first_chain + island_.chains.count;
    for (std::uint32_t r = first_chain; r < end_chain; ++r) {
        if (scratch_.chain_error[r] <= fallback_error) continue;  // false for NaN
        any = true;
        std::uint8_t& failed = scratch_.body_failed[plan_.chains[r].body];
        report_.fallbacks += failed == 0 ? 1 : 0;
        failed = 1;
    }
    if (!any) return;
    for (const std::uint32_t b : bodies) {
        if (scratch_.body_failed[b] == 0) continue;
        const Body& body = state_.bodies[b];
        for (std::size_t i = body.first; i < body.first + body.count; ++i) {
            scratch_.x[i] = scratch_.base[i];
            scratch_.touch[i].displacement = dvec3(0.0);
            scratch_.touch[i].shares = {};
        }
    }
    // Bodies that no link joins to these are already solved.
    std::erase_if(local_.near, [&](const IslandScratch::Near& near) {
        return scratch_.body_failed[plan_.chunks[near.chunk].body] == 0;
    });
    for (int pass = 0; pass < fallback_passes; ++pass) {
        report_.work += island_.links.count;
        for (const Plan::Chain& chain : Plan::part(plan_.chains, island_.chains)) {
            if (scratch_.body_failed[chain.body] == 0) continue;
            for (std::uint32_t k = chain.first_link; k < chain.first_link + chain.links; ++k) {
                scratch_.multiplier[k] = 0.0;  // its value did not solve the chain
                satisfy(k, 0.0);
            }
        }
        if (pass + 1 == fallback_passes) measure();
        resolve_contacts(pass == 0);
    }
}

double Substep::solve_group(const Plan::Group& group, int iteration) {
    double worst = 0.0;
    const auto lanes = static_cast<std::uint32_t>(scratch_.unit.lanes);
    for (std::uint32_t done = 0; done < group.chains;) {
        if (scratch_.chain_solved[group.first_chain + done] != 0) {
            ++done;
            continue;
        }
        std::uint32_t left = 1;
        while (done + left < group.chains && scratch_.chain_solved[group.first_chain + done + left] == 0)
            ++left;
        // A few chains are faster one by one than in a mostly empty register.
        const bool single = left < 2 || lanes == 1;
        const std::uint32_t count = single ? 1 : std::min(left, lanes);
        worst = std::max(worst, solve_batch({group.first_chain + done, count, single}, iteration));
        done += count;
    }
    return worst;
}

double Substep::solve_batch(const Batch& batch, int iteration) {
    const Plan::Chain& first = plan_.chains[batch.chain];
    Block block{local_.block.data() + local_.block_offset, first.links,
                batch.single ? 1 : scratch_.unit.lanes};
    SolveJob job;
    gather(block, batch);
    job.implicit = first.isolated && iteration == 0;
    for (std::uint32_t lane = 0; lane < detail::max_lanes; ++lane) {
        // Chains that share particles partly undo each other's corrections, and contacts leave initial length
        // errors: there the new direction alone works best.
        const std::uint32_t body = plan_.chains[batch.chain + std::min(lane, batch.count - 1)].body;
        const bool contact = has_fallback_contact(body);
        job.backward[lane] = first.isolated && !contact ? backward() : 1.0;
        const int max_passes = !first.isolated ? 1 : contact ? 4 : 2;
        job.passes[lane] = std::min(max_passes, state_.settings.iterations);
    }
    if (!first.isolated) job.damping = shared_damping;
    job.tolerance = length_tolerance;
    (batch.single ? scratch_.unit.single : scratch_.unit.solve)(block, job);
    double worst = 0.0;
    for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
        const std::uint32_t chain = batch.chain + lane;
        scratch_.chain_error[chain] = job.worst[lane];
        scatter(block, lane, chain);
    }
    for (std::uint32_t chain = batch.chain; chain < batch.chain + batch.count; ++chain) {
        if (first.isolated && iteration == 0) solve_again(chain);
        worst = std::max(worst, scratch_.chain_error[chain]);
    }
    return worst;
}

/// Whether an isolated chain's lengths are within `tolerance`; `bounded`: and it gained no energy.
bool Substep::accepts(std::uint32_t chain, double tolerance, bool bounded) {
    if (!(scratch_.chain_error[chain] <= tolerance)) return false;
    if (!bounded) return true;
    const std::array<Member, 1> alone{Member{.chain = chain}};
    const Ledger ledger = ledger_of(alone);
    if (ledger.gains_over(1e-4)) return false;
    // Nothing else moves the chain in this substep, so this ledger balances it.
    const bool untouched = scratch_.body_near[plan_.chains[chain].body] == Scratch::Nearest::None;
    if (untouched && island_.isolated && island_.contacts == 0 && !is_free(alone))
        local_.members[chain - island_.chains.first].slowdown = limit_gain(ledger);
    return true;
}

void Substep::solve_again(std::uint32_t chain) {
    const Plan::Chain& it = plan_.chains[chain];
    const double tolerance = has_fallback_contact(it.body) ? 10.0 * accepted_error : accepted_error;
    if (accepts(chain, tolerance, true)) return;
    Block block{local_.block.data() + local_.block_offset, it.links, 1};
    const int restarts = std::min(max_restarts, state_.settings.iterations);
    for (int i = 0; i < restarts; ++i) {
        const bool mean = i < mean_restarts;
        if (i == 0 || i == mean_restarts)
            for (std::uint32_t k = it.first_link; k < it.first_link + it.links; ++k)
                scratch_.multiplier[k] = static_cast<double>(state_.links[k].tension) * (h_ * h_);
        SolveJob job;
        gather(block, {chain, 1, true});
        job.implicit = true;
        job.backward[0] = mean ? backward() : 1.0;
        job.passes[0] = i + 1 < restarts ? 2.0 : 8.0;
        job.tolerance = length_tolerance;
        scratch_.unit.single(block, job);
        scratch_.chain_error[chain] = job.worst[0];
        scatter(block, 0, chain);
        if (accepts(chain, tolerance, mean)) break;
    }
}

void Substep::gather(const Block& block, const Batch& batch) const {
    const Plan::Chain& first = plan_.chains[batch.chain];
    const auto put = [](double* at, const dvec3& value, std::size_t lanes) {
        at[0] = value.x, at[lanes] = value.y, at[2 * lanes] = value.z;
    };
    std::array<const Plan::Chain*, detail::max_lanes> lane_chains{};
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
        lane_chains[lane] = &plan_.chains[batch.chain + std::min<std::size_t>(lane, batch.count - 1)];
    }
    const double per_square = 1.0 / (h_ * h_);
    for (std::uint32_t k = 0; k <= first.links; ++k) {
        for (std::size_t lane = 0; lane < block.lanes; ++lane) {
            const Plan::Chain& chain = *lane_chains[lane];
            const std::uint32_t i = plan_.nodes[chain.first_node + k];
            double* const node = block.at(k, 0) + lane;
            const auto row = [&](std::size_t index) -> double* { return node + index * block.lanes; };
            put(row(Row::X), scratch_.x[i], block.lanes);
            put(row(Row::OldX), state_.position[i] - state_.displacement[i], block.lanes);
            *row(Row::Weight) = scratch_.weight[i];
            put(row(Row::BaseX), scratch_.base[i], block.lanes);
            if (k == chain.links) continue;
            const Link& link = state_.links[chain.first_link + k];
            *row(Row::Rest) = link.rest;
            *row(Row::Compliance) = detail::compliance(state_.settings, link) * per_square;
            *row(Row::Multiplier) = scratch_.multiplier[chain.first_link + k];
        }
    }
}

void Substep::scatter(const Block& block, std::uint32_t lane, std::uint32_t number) {
    const Plan::Chain& chain = plan_.chains[number];
    for (std::uint32_t k = 0; k <= chain.links; ++k) {
        const std::uint32_t i = plan_.nodes[chain.first_node + k];
        const double* const node = block.at(k, 0) + lane;
        const auto row = [&](std::size_t index) { return node[index * block.lanes]; };
        if (scratch_.weight[i] > 0.0) scratch_.x[i] = {row(Row::X), row(Row::Y), row(Row::Z)};
        if (k < chain.links) scratch_.multiplier[chain.first_link + k] = row(Row::Multiplier);
    }
}

}  // namespace tendril::rope
