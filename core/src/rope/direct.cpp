// The direct solver: whole runs at once, as many side by side as a vector register has lanes.
//
// A run that nothing else is linked to first takes in the tension that it had, then one or two passes make
// its lengths right. Where it moves too fast for that (a whip cracks), or would gain energy, it begins again
// with what tension was found, pulling along where its links will be: that converges, and costs energy.
//
// Colliders push last. So what tension draws into them shows as depth, and friction is bounded by it: a rope
// around a post holds as Euler and Eytelwein have it. The lengths that this costs are made good in the next
// substep.
#include <algorithm>
#include <array>
#include <cmath>

#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using detail::Block;
using detail::Order;
using detail::Row;
using glm::dvec3;

constexpr double arrived = 1e-7;        ///< relative length error that is made no better
constexpr double good_enough = 1e-4;    ///< a run with more begins again
constexpr double shared_enough = 1e-3;  ///< the same where runs share particles
constexpr double hopeless = 0.02;       ///< a run with more in the end is relaxed instead
constexpr int beginnings = 6, rescue_passes = 16;
/// Passes that runs which share particles take at least while something pushes them.
constexpr int pushed_passes = 4;
/// A run that others pull at may be asked for lengths that it cannot have, straight between two pins: its
/// system is damped (Levenberg, Marquardt), or it would fling its particles about.
constexpr double shared_damping = 2e-2;
/// Of a perfect pull along the mean so much is left out: it takes the jitter of single particles away within
/// a second, and from a pendulum of a second's period a few percent of its energy in a minute.
constexpr double least_backward = 0.01;

}  // namespace

/// Runs that are solved side by side: `count` of them from `run` on, in the lanes of a block.
struct Substep::Batch {
    std::uint32_t run = 0, count = 1;
    bool single = false;
};

int Substep::direct() {
    for (const std::uint32_t i : plan_.soft) scratch_.pull[i] = 0.0;
    for (const World::Plan::Run& run : plan_.runs) {
        if (!run.alone) std::fill_n(scratch_.pull.begin() + run.first_link, run.links, 0.0);
    }
    const bool pushed = !scratch_.near.empty();
    const int most = passes_allowed();
    int passes = 0;
    bool settled = false;
    while (!settled && passes < most) {
        report_.work += state_.links.size();
        satisfy_soft();
        double worst = 0.0;
        for (const World::Plan::Group& group : plan_.groups)
            worst = std::max(worst, solve_group(group, passes));
        measure();
        push_out(passes == 0);
        ++passes;
        settled = plan_.all_alone || (worst <= shared_enough && (!pushed || passes >= pushed_passes));
    }
    if (!settled && most < state_.settings.iterations) ++report_.shortened;
    rescue();
    limit_energy();
    return passes;
}

/// A body that could not be solved (or cannot be: it is asked for the impossible) is relaxed: that always
/// ends somewhere sensible.
void Substep::rescue() {
    bool any = false;
    std::fill(scratch_.body_lost.begin(), scratch_.body_lost.end(), std::uint8_t{0});
    for (std::uint32_t r = 0; r < plan_.runs.size(); ++r) {
        if (scratch_.run_worst[r] <= hopeless) continue;  // not so where it is no number
        any = true;
        scratch_.body_lost[plan_.runs[r].body] = 1;
    }
    if (!any) return;
    for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
        if (scratch_.body_lost[b] == 0) continue;
        const Body& body = state_.bodies[b];
        for (std::size_t i = body.first; i < body.first + body.count; ++i) {
            scratch_.place[i] = scratch_.base[i];
            scratch_.touch[i].push = dvec3(0.0);
        }
    }
    for (int pass = 0; pass < rescue_passes; ++pass) {
        report_.work += state_.links.size();
        for (const World::Plan::Run& run : plan_.runs) {
            if (scratch_.body_lost[run.body] == 0) continue;
            for (std::uint32_t k = run.first_link; k < run.first_link + run.links; ++k) {
                scratch_.pull[k] = 0.0;  // whatever it was, it is not what held the run
                satisfy(k, 0.0);
            }
        }
        if (pass + 1 == rescue_passes) measure();
        push_out(pass == 0);
    }
}

double Substep::solve_group(const World::Plan::Group& group, int iteration) {
    double worst = 0.0;
    const auto lanes = static_cast<std::uint32_t>(scratch_.unit.lanes);
    for (std::uint32_t done = 0; done < group.runs;) {
        const std::uint32_t left = group.runs - done;
        // A few runs are quicker one by one than in a register that is mostly empty.
        const bool single = left < 2 || lanes == 1;
        const std::uint32_t count = single ? 1 : std::min(left, lanes);
        worst = std::max(worst, solve_batch({group.first_run + done, count, single}, iteration));
        done += count;
    }
    return worst;
}

double Substep::solve_batch(const Batch& batch, int iteration) {
    const World::Plan::Run& first = plan_.runs[batch.run];
    Block block{scratch_.block.data() + scratch_.block_offset, first.links,
                batch.single ? 1 : scratch_.unit.lanes};
    Order order;
    gather(block, batch);
    order.implicit = first.alone && iteration == 0;
    for (std::uint32_t lane = 0; lane < detail::most_lanes; ++lane) {
        // Runs that share particles undo part of what the others did, and what colliders pushed has wrong
        // lengths to begin with: there the plain direction serves best.
        const std::uint32_t body = plan_.runs[batch.run + std::min(lane, batch.count - 1)].body;
        const bool pushed = scratch_.body_near[body] != 0;
        order.backward[lane] = first.alone && !pushed ? least_backward : 1.0;
        const int most = !first.alone ? 1 : pushed ? 4 : 2;
        order.passes[lane] = std::min(most, state_.settings.iterations);
    }
    if (!first.alone) order.damping = shared_damping;
    order.tolerance = arrived;
    (batch.single ? scratch_.unit.single : scratch_.unit.solve)(block, order);
    double worst = 0.0;
    for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
        const std::uint32_t run = batch.run + lane;
        scratch_.run_worst[run] = order.worst[lane];
        scatter(block, lane, run);
    }
    for (std::uint32_t run = batch.run; run < batch.run + batch.count; ++run) {
        scratch_.run_gain[run] = energy_gained(run);
        if (first.alone && iteration == 0) again(run);
        worst = std::max(worst, scratch_.run_worst[run]);
    }
    return worst;
}

void Substep::again(std::uint32_t run) {
    const double enough = scratch_.body_near[plan_.runs[run].body] != 0 ? 10.0 * good_enough : good_enough;
    if (scratch_.run_worst[run] <= enough && !gains_energy(run, 1e-4)) return;
    const World::Plan::Run& it = plan_.runs[run];
    Block block{scratch_.block.data() + scratch_.block_offset, it.links, 1};
    const int most = std::min(beginnings, state_.settings.iterations);
    for (std::uint32_t k = it.first_link; k < it.first_link + it.links; ++k) {
        scratch_.pull[k] = static_cast<double>(state_.links[k].tension) * (h_ * h_);
    }
    for (int i = 0; i < most; ++i) {
        Order order;
        gather(block, {run, 1, true});
        order.implicit = true;
        order.backward[0] = 1.0;
        order.passes[0] = i + 1 < most ? 2.0 : 8.0;
        order.tolerance = arrived;
        scratch_.unit.single(block, order);
        scratch_.run_worst[run] = order.worst[0];
        scatter(block, 0, run);
        if (order.worst[0] <= enough) break;
    }
    scratch_.run_gain[run] = energy_gained(run);
}

void Substep::gather(const Block& block, const Batch& batch) const {
    const World::Plan::Run& first = plan_.runs[batch.run];
    const auto put = [](double* at, const dvec3& value, std::size_t lanes) {
        at[0] = value.x, at[lanes] = value.y, at[2 * lanes] = value.z;
    };
    std::array<const World::Plan::Run*, detail::most_lanes> lane_runs{};
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
        lane_runs[lane] = &plan_.runs[batch.run + std::min<std::size_t>(lane, batch.count - 1)];
    }
    const double per_square = 1.0 / (h_ * h_);
    for (std::uint32_t k = 0; k <= first.links; ++k) {
        for (std::size_t lane = 0; lane < block.lanes; ++lane) {
            const World::Plan::Run& run = *lane_runs[lane];
            const std::uint32_t i = plan_.nodes[run.first_node + k];
            double* const node = block.at(k, 0) + lane;
            const auto row = [&](std::size_t which) -> double* { return node + which * block.lanes; };
            put(row(Row::X), scratch_.place[i], block.lanes);
            put(row(Row::OldX), state_.position[i] - state_.moved[i], block.lanes);
            *row(Row::Weight) = scratch_.weight[i];
            put(row(Row::BaseX), scratch_.base[i], block.lanes);
            if (k == run.links) continue;
            const Link& link = state_.links[run.first_link + k];
            *row(Row::Rest) = link.rest;
            *row(Row::Give) = compliance_of(link) * per_square;
            *row(Row::Pull) = scratch_.pull[run.first_link + k];
        }
    }
}

void Substep::scatter(const Block& block, std::uint32_t lane, std::uint32_t number) {
    const World::Plan::Run& run = plan_.runs[number];
    for (std::uint32_t k = 0; k <= run.links; ++k) {
        const std::uint32_t i = plan_.nodes[run.first_node + k];
        const double* const node = block.at(k, 0) + lane;
        const auto row = [&](std::size_t which) { return node[which * block.lanes]; };
        if (scratch_.weight[i] > 0.0) scratch_.place[i] = {row(Row::X), row(Row::Y), row(Row::Z)};
        if (k < run.links) scratch_.pull[run.first_link + k] = row(Row::Pull);
    }
}

/// Joules that a run has more of than before the substep: kinetic energy by the displacements, potential, and
/// what is in its links; nothing where something else than gravity has worked on it.
double Substep::energy_gained(std::uint32_t number) const {
    const World::Plan::Run& run = plan_.runs[number];
    if (!run.alone || scratch_.body_near[run.body]) return 0.0;
    const double per_square = 1.0 / (h_ * h_);
    double gained = 0.0;
    for (std::uint32_t k = 0; k <= run.links; ++k) {
        const std::uint32_t i = plan_.nodes[run.first_node + k];
        const dvec3 now = scratch_.place[i] - state_.position[i], then = state_.moved[i];
        if (scratch_.weight[i] == 0.0) {
            if (now != dvec3(0.0)) return 0.0;
            continue;
        }
        const double kinetic = detail::dot(now, now) - detail::dot(then, then);
        gained += 0.5 * state_.mass[i] * (kinetic * per_square - detail::dot(acceleration_, now + then));
    }
    for (std::uint32_t k = run.first_link; k < run.first_link + run.links; ++k) {
        const Link& link = state_.links[k];
        const double half = 0.5 * compliance_of(link);
        if (half == 0.0) continue;
        // Like the rest by what is halfway between substeps; what it was two ago is known from the lengths.
        const dvec3 then_by = state_.position[link.b] - state_.position[link.a];
        const dvec3 old_by = then_by - (state_.moved[link.b] - state_.moved[link.a]);
        const double now = scratch_.pull[k] * per_square, then = link.tension;
        const double old = then - (detail::length(then_by) - detail::length(old_by)) / compliance_of(link);
        gained += 0.5 * half * (now * now - old * old);
    }
    return gained;
}

/// Whether a run gained more than that part of what energy it has to do with.
bool Substep::gains_energy(std::uint32_t run, double part) const {
    const double gained = scratch_.run_gain[run];
    return gained > 0.0 && gained > part * energy_scale(run);
}

/// What energy a run has to do with: its weight times its length.
double Substep::energy_scale(std::uint32_t number) const {
    const World::Plan::Run& run = plan_.runs[number];
    double mass = 0.0, length = 0.0;
    for (std::uint32_t k = 0; k < run.links; ++k) {
        mass += state_.mass[plan_.nodes[run.first_node + k]];
        length += state_.links[run.first_link + k].rest;
    }
    return mass * length * detail::length(acceleration_);
}

/// A run that gained energy for all that moves on a little slower.
void Substep::limit_energy() {
    for (std::uint32_t r = 0; r < plan_.runs.size(); ++r) {
        if (!gains_energy(r, 1e-9)) continue;
        double kinetic = 0.0;
        const World::Plan::Run& run = plan_.runs[r];
        for (std::uint32_t k = 0; k <= run.links; ++k) {
            const std::uint32_t i = plan_.nodes[run.first_node + k];
            if (scratch_.weight[i] == 0.0) continue;
            const dvec3 now = scratch_.place[i] - state_.position[i];
            kinetic += 0.5 * state_.mass[i] * detail::dot(now, now) / (h_ * h_);
        }
        if (kinetic > 0.0)
            scratch_.run_scale[r] = std::sqrt(std::max(0.0, 1.0 - scratch_.run_gain[r] / kinetic));
    }
}

}  // namespace tendril::rope
