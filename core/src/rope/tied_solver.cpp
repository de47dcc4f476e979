#include "rope/tied_solver.hpp"

#include <algorithm>
#include <cmath>

#include "rope/build.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope {
namespace {

using detail::Symmetric3;
using glm::dvec3;

/// Maximum stiffness of a link or tie, relative to the mean mass of its ends, over h^2. A metre of rope, 64
/// segments, carrying a hundred times its weight stretches by some millionths.
constexpr double max_stiffness_between = 1e7;
/// Stiffness of a contact, relative to the mean mass of a particle.
constexpr double contact_stiffness = 1e6;
constexpr int max_steps = 16, steps_near_colliders = 3;
constexpr double turn_tolerance = 1e-3;  ///< below it, the next step changes lengths by under a millionth
/// After this many steps a larger turn is accepted, which leaves lengths right to 0.05 %.
constexpr int strict_steps = 3;
constexpr double late_turn_tolerance = 0.03;
constexpr double checked_turn = 0.05;  ///< above it, the step is checked
constexpr int max_halvings = 8;
/// For cloth that is a grid, as in cloth_solver.cpp.
constexpr double accepted_strain = 0.007, relative_residual = 0.1;
constexpr int min_grid_steps = 2, max_grid_steps = 8;
constexpr double single_rounding = 1e-6;  ///< error of a potential: grids are in single precision

/// along n n^T + across (I - n n^T)
Symmetric3 stiffness_along(const dvec3& n, double along, double across) {
    const double by = along - across;
    return {by * n.x * n.x + across, by * n.x * n.y, by * n.x * n.z,
            by * n.y * n.y + across, by * n.y * n.z, by * n.z * n.z + across};
}

Symmetric3 scaled(const Symmetric3& m, double by) {
    return {by * m.xx, by * m.xy, by * m.xz, by * m.yy, by * m.yz, by * m.zz};
}

}  // namespace

TiedSolver::TiedSolver(const IslandStep& step)
    : ImplicitStep(step), tied_(plan_.tied[island_.tied - 1]), system_(scratch_.tied[island_.tied - 1]) {
    double whole = 0.0;
    each_particle([&](std::size_t i) { whole += state_.mass[i]; });
    mass_ = whole / island_.particles;
    stiffness_ = contact_stiffness;
    if (tied_.grids.count > 0) measure_grids();
}

TiedSolver::Cloth::Cloth(const TiedSolver& island, std::uint32_t grid) : ClothSolver(island, grid) {
    mass_ = island.mass_;
    unit_ = mass_ / (h_ * h_);
    stiffness_ = island.stiffness_;
    shortest_ = island.shortest_;
}

/// Measures the grids. They and contacts are as stiff as a single cloth of the total weight.
void TiedSolver::measure_grids() {
    double weight = mass_ * island_.particles * detail::length(detail::acceleration(state_.settings));
    for (const Plan::Grid& grid : Plan::part(plan_.grids, tied_.grids)) {
        double shortest = 1e30, longest = 0.0;
        for (const Plan::GridLink& each : Plan::part(plan_.grid_links, grid.links)) {
            const Link& link = state_.links[each.link];
            if (link.kind != Link::Kind::Stretch || !(link.rest > 0.0f)) continue;
            shortest = std::min(shortest, static_cast<double>(link.rest));
            longest = std::max(longest, static_cast<double>(link.rest));
        }
        if (longest == 0.0) continue;
        weight += (grid.columns - 1.0) * (grid.rows - 1.0) * shortest * longest *
                  detail::wind_pressure(state_.settings);
        shortest_ = std::min(shortest_, shortest);
    }
    double lightest = mass_;
    for (const Plan::Grid& grid : Plan::part(plan_.grids, tied_.grids)) {
        const Body& body = state_.bodies[grid.body];
        for (std::size_t i = body.first; i < body.first + body.count; ++i)
            lightest = std::min(lightest, static_cast<double>(state_.mass[i]));
    }
    lightest_ = std::max(static_cast<float>(lightest / mass_), 1e-12f);
    stiffness_ = Cloth::link_stiffness(weight, shortest_, mass_ / (h_ * h_));
}

std::uint32_t TiedSolver::grid_of_particle(std::uint32_t particle) const {
    std::uint32_t found = 0;
    each_grid([&](std::uint32_t number) {
        const Body& body = state_.bodies[plan_.grids[number - 1].body];
        if (particle - body.first < body.count) found = number;
    });
    return found;
}

double TiedSolver::tie_stiffness(const Tie& tie) const {
    return 0.5 * max_stiffness_between * (state_.mass[tie.a] + state_.mass[tie.b]) / mass_;
}

/// Calls `visit` with the spring of each tie and of each link outside grids, and the multiplier that it
/// leaves.
template <class Visit>
void TiedSolver::each_spring(Visit visit) {
    const double per_mass = 1.0 / mass_, per_square = 1.0 / (h_ * h_);
    const std::span<const std::uint32_t> links = Plan::part(plan_.links, island_.links);
    for (std::size_t k = 0; k < links.size(); ++k) {
        if (tied_.link_blocks[k] == Plan::no_block) continue;
        const Link& link = state_.links[links[k]];
        const double compliance = detail::compliance(state_.settings, link) * per_square;
        const double hard = 0.5 * max_stiffness_between * (state_.mass[link.a] + state_.mass[link.b]);
        const bool stiff = compliance * hard <= 1.0;
        double& multiplier = scratch_.multiplier[links[k]];
        visit(Spring{link.a, link.b, tied_.link_blocks[k], link.rest,
                     (stiff ? hard : 1.0 / compliance) * per_mass, multiplier * per_mass, stiff},
              multiplier);
    }
    const std::span<const std::uint32_t> ties = Plan::part(plan_.ties, island_.ties);
    for (std::size_t k = 0; k < ties.size(); ++k) {
        const Tie& tie = state_.ties[ties[k]];
        double& multiplier = scratch_.tie_multiplier[ties[k]];
        visit(Spring{tie.a, tie.b, tied_.tie_blocks[k], detail::enforced_length(tie, h_), tie_stiffness(tie),
                     multiplier * per_mass, true, tied_.tie_blocks[k] == Plan::no_block},
              multiplier);
    }
}

void TiedSolver::add(std::uint32_t particle, const Symmetric3& matrix, const dvec3& force) {
    if (scratch_.weight[particle] == 0.0) return;
    const std::uint32_t x = plan_.system_index[particle];
    Symmetric3& at = system_.diagonal[x];
    at.xx += matrix.xx, at.xy += matrix.xy, at.xz += matrix.xz;
    at.yy += matrix.yy, at.yz += matrix.yz, at.zz += matrix.zz;
    system_.x[x] += force;
}

/// Builds the system at the current positions. The first step uses the previous substep's tension: links
/// between particles that fell together show none yet.
void TiedSolver::assemble(bool first) {
    system_.clear();
    for (const std::uint32_t number : Plan::part(plan_.bodies, island_.bodies)) {
        const Body& body = state_.bodies[number];
        if (plan_.grid_of[number] > 0) continue;
        for (std::size_t i = body.first; i < body.first + body.count; ++i) {
            const std::uint32_t x = plan_.system_index[i];
            const bool pinned = scratch_.weight[i] == 0.0;
            const double mass = pinned ? 1.0 : state_.mass[i] / mass_;
            system_.diagonal[x] = {mass, 0.0, 0.0, mass, 0.0, mass};
            if (!pinned) system_.x[x] = mass * (scratch_.base[i] - scratch_.x[i]);
        }
    }
    each_grid([&](std::uint32_t number) {
        Cloth cloth(*this, number);
        cloth.in_cells([&](detail::GridRange cells) {
            scratch_.cloth_unit.cells(cloth.level_, cloth.cloth_.arrays, cells);
        });
    });
    each_spring([&](const Spring& spring, double&) {
        if (spring.block == Plan::no_block) return;
        const dvec3 apart = scratch_.x[spring.b] - scratch_.x[spring.a];
        const double length = detail::length(apart);
        Symmetric3 matrix;
        dvec3 force;
        if (spring.rest > 0.0) {
            const dvec3 along = length > 1e-30 ? (1.0 / length) * apart : dvec3(1.0, 0.0, 0.0);
            const double pull = spring.stiffness * (length - spring.rest);
            const double taut = std::max(first ? spring.multiplier : pull, 0.0);
            const double across = std::min(taut / std::max(length, 1e-9), spring.stiffness);
            matrix = stiffness_along(along, spring.stiffness, across);
            force = pull * along;
        } else {
            matrix = {spring.stiffness, 0.0, 0.0, spring.stiffness, 0.0, spring.stiffness};
            force = spring.stiffness * apart;
        }
        add(spring.a, matrix, force);
        add(spring.b, matrix, -force);
        if (scratch_.weight[spring.a] > 0.0 && scratch_.weight[spring.b] > 0.0)
            system_.blocks[spring.block].subtract(matrix);
    });
}

/// Calls `visit` with each place where a rope resists bending, in the units of springs, and its curvature.
template <class Visit>
void TiedSolver::each_bend(Visit visit) const {
    for (const Plan::Tied::Bend& at : tied_.bends) {
        detail::ChainBend bend = detail::bend_between(state_, state_.bodies[at.body],
                                                      state_.links[at.link - 1], state_.links[at.link]);
        bend.stiffness /= mass_;
        visit(at, bend,
              bend.curvature(scratch_.x[at.points[0]], scratch_.x[at.points[1]], scratch_.x[at.points[2]]));
    }
}

void TiedSolver::add_bends() {
    each_bend([&](const Plan::Tied::Bend& at, const detail::ChainBend& bend, const dvec3& curvature) {
        const auto scalar = [](double by) { return Symmetric3{by, 0.0, 0.0, by, 0.0, by}; };
        const std::array<double, 3> shares{bend.before, -bend.before - bend.after, bend.after};
        for (std::size_t i = 0; i < 3; ++i) {
            add(at.points[i], scalar(bend.stiffness * shares[i] * shares[i]),
                -bend.stiffness * shares[i] * curvature);
            const std::size_t j = (i + 1) % 3, block = at.blocks[i];
            if (scratch_.weight[at.points[i]] > 0.0 && scratch_.weight[at.points[j]] > 0.0)
                system_.blocks[block].subtract(scalar(-bend.stiffness * shares[i] * shares[j]));
        }
    });
}

void TiedSolver::add_contacts() {
    for (ClothContact& each : local_.cloth_contacts) {
        apply_friction(each);
        const std::uint32_t grid = plan_.grid_of[plan_.chunks[local_.near[each.near].chunk].body];
        if (grid > 0) {
            Cloth(*this, grid).add_contact(each);
            continue;
        }
        const dvec3& n = each.normal;
        const double to_b = each.t, to_a = 1.0 - to_b;
        const Symmetric3 stiff = stiffness_along(n, stiffness_, each.drag);
        const dvec3 force = -stiffness_ * each.gap * n - each.drag * each.slip;
        add(each.a, scaled(stiff, to_a * to_a), to_a * force);
        if (!each.is_link()) continue;
        add(each.b, scaled(stiff, to_b * to_b), to_b * force);
        if (scratch_.weight[each.a] == 0.0 || scratch_.weight[each.b] == 0.0) continue;
        system_.blocks[tied_.order.block(plan_.system_index[each.a], plan_.system_index[each.b])].subtract(
            scaled(stiff, -to_a * to_b));
    }
}

void TiedSolver::move_by(double part) {
    each_particle([&](std::size_t i) { scratch_.x[i] += part * scratch_.tied_step[i]; });
}

/// Stores the tension of links and ties: to first order over the step, or exactly at its end.
void TiedSolver::store_tensions(bool exact) {
    double turn = 0.0;  // squared
    each_spring([&](const Spring& spring, double& multiplier) {
        const dvec3 apart = scratch_.x[spring.b] - scratch_.x[spring.a];
        const dvec3 by = scratch_.tied_step[spring.b] - scratch_.tied_step[spring.a];
        if (scratch_.weight[spring.a] + scratch_.weight[spring.b] == 0.0) {
            multiplier = 0.0;
        } else if (spring.rest > 0.0) {
            const double length = detail::length(apart);
            const dvec3 along = length > 1e-30 ? (1.0 / length) * apart : dvec3(1.0, 0.0, 0.0);
            const double longer = length - spring.rest + (exact ? 0.0 : detail::dot(along, by));
            if (!spring.across) multiplier = mass_ * spring.stiffness * longer;
            if (!spring.stiff) return;
            const double reach = std::max(spring.rest, length);
            if (detail::dot(by, by) > turn * reach * reach) turn = detail::dot(by, by) / (reach * reach);
        } else if (!spring.across) {
            multiplier = mass_ * spring.stiffness * detail::length(exact ? apart : apart + by);
        }
    });
    turn_ = std::sqrt(turn);
}

/// Twice the incremental potential at `x`, over the mean mass and times h^2.
double TiedSolver::potential() {
    double sum = 0.0;
    each_particle([&](std::size_t i) {
        const dvec3 beside = scratch_.x[i] - scratch_.base[i];
        sum += state_.mass[i] / mass_ * detail::dot(beside, beside);
    });
    each_spring([&](const Spring& spring, double&) {
        const double longer = detail::length(scratch_.x[spring.b] - scratch_.x[spring.a]) - spring.rest;
        sum += spring.stiffness * longer * longer;
    });
    each_bend([&](const Plan::Tied::Bend&, const detail::ChainBend& bend, const dvec3& curvature) {
        sum += bend.stiffness * detail::dot(curvature, curvature);
    });
    each_grid([&](std::uint32_t number) { sum = Cloth(*this, number).add_links(sum); });
    for (const ClothContact& each : local_.cloth_contacts) sum += potential_of(each);
    return sum;
}

void TiedSolver::evaluate_grids() {
    strain_ = 0.0;
    each_grid([&](std::uint32_t number) {
        Cloth cloth(*this, number);
        cloth.evaluate();
        strain_ = std::max(strain_, cloth.strain_);
    });
}

/// Solves for a step and stores it by particle.
void TiedSolver::find_step(const detail::GridSystem::Tolerance& tolerance, int iterations) {
    if (tied_.grids.count == 0) {
        system_.factorize(tied_.order);
        system_.substitute(tied_.order, system_.x, 0);
    } else {
        each_grid([&](std::uint32_t number) { Cloth(*this, number).pin(); });
        solve_with_grids(tolerance, iterations);
    }
    for (const std::uint32_t number : Plan::part(plan_.bodies, island_.bodies)) {
        const Body& body = state_.bodies[number];
        const std::uint32_t grid = plan_.grid_of[number];
        for (std::size_t i = body.first; i < body.first + body.count; ++i) {
            const std::uint32_t x = plan_.system_index[i];
            scratch_.tied_step[i] =
                grid == 0 ? system_.x[x] : detail::value_at(scratch_.cloths[grid - 1].system.solution(), x);
        }
    }
}

/// A step of Newton's method. If it turns links far, or strains grids, it is halved until the potential does
/// not rise.
void TiedSolver::step(bool first, int iterations, double max_residual) {
    assemble(first);
    add_bends();
    add_contacts();
    find_step({first ? 0.0 : max_residual, relative_residual}, iterations);
    local_.done.work += island_.links.count;
    store_tensions(false);
    move_by(1.0);
    evaluate_grids();
    step_scale_ = 1.0;
    if (turn_ <= checked_turn && strain_ <= accepted_strain) return;
    move_by(-1.0);
    const double turn = turn_, limit = potential() * (1.0 + (tied_.grids.count > 0 ? single_rounding : 0.0));
    move_by(1.0);
    for (int i = 0; i < max_halvings && !(potential() <= limit); ++i) {
        step_scale_ *= 0.5;
        move_by(-step_scale_);
    }
    if (step_scale_ == 1.0 && turn_ <= checked_turn) return;
    if (step_scale_ < 1.0) evaluate_grids();
    store_tensions(true);
    turn_ = turn;
}

/// Initial guess: unchanged velocities. At rest a single step then suffices.
void TiedSolver::predict() {
    for (const std::uint32_t number : Plan::part(plan_.bodies, island_.bodies)) {
        const Body& body = state_.bodies[number];
        if (plan_.grid_of[number] > 0) continue;
        for (std::size_t i = body.first; i < body.first + body.count; ++i)
            if (scratch_.weight[i] > 0.0) scratch_.x[i] = state_.position[i] + state_.displacement[i];
    }
}

int TiedSolver::solve(int iterations) {
    const bool has_grids = tied_.grids.count > 0;
    const int step_limit = std::min(max_steps, iterations);
    const int min_steps = !local_.near.empty() ? steps_near_colliders : !has_grids ? 1 : min_grid_steps;
    double max_residual = 0.0;
    predict();
    each_grid([&](std::uint32_t number) {
        Cloth cloth(*this, number);
        cloth.load();
        max_residual += cloth.predict();
        strain_ = std::max(strain_, cloth.strain_);
    });
    int taken = 0;
    for (converged_ = false; taken < step_limit && !converged_;) {
        find_contacts(taken == 0);
        step(taken == 0, iterations, max_residual);
        for (ClothContact& each : local_.cloth_contacts) {
            const dvec3 moved = contact_point(each, scratch_.x) - each.at;
            each.force = -stiffness_ * (each.gap + detail::dot(each.normal, moved));
        }
        ++taken;
        converged_ = taken >= min_steps &&
                     turn_ <= (taken < strict_steps ? turn_tolerance : late_turn_tolerance) &&
                     (strain_ <= accepted_strain || taken >= max_grid_steps);
    }
    each_grid([&](std::uint32_t number) { Cloth(*this, number).finish(); });
    push_colliders(local_.cloth_contacts);
    return taken;
}

}  // namespace tendril::rope
