#include "rope/cloth_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "rope/build.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// Strain of a link that carries the weight of the whole cloth.
constexpr double strain_by_weight = 2e-3;
/// Range of a link's stiffness, in m / h^2.
constexpr double min_stiffness = 1e4, max_stiffness = 1e6;
/// Steps of Newton's method: the minimum, then more until the strain of every stretch link and the depth in
/// colliders are accepted. No step needs an exact solution: it only linearises the lengths.
constexpr int min_newton_steps = 2, max_newton_steps = 8;
constexpr double accepted_strain = 0.007;
constexpr double accepted_depth = 0.01;  ///< relative to the shortest stretch link
/// A step is solved once its residual falls to this part of its initial value or, in later steps, of the
/// forces on free particles, and then below what strains a single link. A tenth of the forces bends a swing.
constexpr double relative_residual = 0.1, force_residual = 0.03;
constexpr double residual_strain = 1e-3;
constexpr double max_predicted_move = 0.05;  ///< displacement by forces in a substep, relative to a link
constexpr int max_halvings = 6;
constexpr std::size_t links_per_sum = 4096;  ///< summed by one thread at a time

}  // namespace

void detail::Cloth::resize(std::size_t columns, std::size_t rows) {
    std::array<float*, 3 * fine_steps + 10> all{};
    system.resize(columns, rows, all);
    auto next = all.begin();
    for (auto* links : {&arrays.rest, &arrays.stiffness, &arrays.pull})
        for (float*& each : *links) each = *next++;
    for (GridVector* vector : {&arrays.position, &arrays.rounding, &arrays.lag})
        for (float*& each : *vector) each = *next++;
    arrays.mass = *next;
    parts.resize((system.finest().cells() + dot_cells - 1) / dot_cells);
}

ClothSolver::ClothSolver(const IslandStep& step, std::uint32_t grid)
    : ImplicitStep(step),
      grid_(plan_.grids[(grid == 0 ? island_.grid : grid) - 1]),
      cloth_(scratch_.cloths[(grid == 0 ? island_.grid : grid) - 1]),
      level_(cloth_.system.finest()),
      cells_(Plan::part(plan_.grid_cells, grid_.cells)),
      first_(state_.bodies[grid_.body].first) {}

ClothSolver::ClothSolver(const IslandStep& step) : ClothSolver(step, 0) {
    const std::size_t count = state_.bodies[grid_.body].count;
    double whole = 0.0, longest = 0.0, lightest = state_.mass[first_];
    for (std::size_t i = first_; i < first_ + count; ++i) {
        whole += state_.mass[i];
        lightest = std::min(lightest, state_.mass[i]);
    }
    for (const std::uint32_t i : Plan::part(plan_.links, island_.links)) {
        const Link& link = state_.links[i];
        if (link.kind == Link::Kind::Stretch && link.rest > 0.0f) {
            shortest_ = std::min(shortest_, static_cast<double>(link.rest));
            longest = std::max(longest, static_cast<double>(link.rest));
        }
    }
    mass_ = whole / static_cast<double>(count);
    unit_ = mass_ / (h_ * h_);
    lightest_ = std::max(static_cast<float>(lightest / mass_), 1e-12f);
    const double area = (grid_.columns - 1.0) * (grid_.rows - 1.0) * shortest_ * longest;
    const double weight = whole * detail::length(detail::acceleration(state_.settings)) +
                          area * detail::wind_pressure(state_.settings);
    stiffness_ = link_stiffness(weight, shortest_, unit_);
}

double ClothSolver::link_stiffness(double weight, double shortest, double unit) {
    return std::clamp(weight / (strain_by_weight * shortest * unit), min_stiffness, max_stiffness);
}

/// Calls `visit` with each particle and its cell.
template <class Visit>
void ClothSolver::each_cell(Visit visit) const {
    in_parts(cells_.size(), detail::part_cells, [&](detail::GridRange part) {
        for (std::size_t i = part.first; i < part.end; ++i) visit(first_ + i, cells_[i]);
    });
}

/// The sum of `visit` over the links, by their number in the grid.
template <class Visit>
double ClothSolver::sum_of_links(Visit visit) const {
    std::vector<double>& sums = cloth_.sums;
    sums.assign((grid_.links.count + links_per_sum - 1) / links_per_sum, 0.0);
    in_parts(sums.size(), 1, [&](detail::GridRange parts) {
        for (std::size_t part = parts.first; part < parts.end; ++part) {
            const std::size_t first = part * links_per_sum;
            const std::size_t end = std::min<std::size_t>(first + links_per_sum, grid_.links.count);
            for (std::size_t i = first; i < end; ++i) sums[part] += visit(i);
        }
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double ClothSolver::stiffness_of(const Link& link) const {
    const double compliance = detail::compliance(state_.settings, link) * unit_;
    return compliance * stiffness_ > 1.0 ? 1.0 / compliance : stiffness_;
}

/// Loads the data that do not change between solves.
void ClothSolver::load() {
    detail::ClothArrays& to = cloth_.arrays;
    const std::size_t cells = level_.cells();
    std::fill_n(to.mass, cells, 1.0f);
    std::fill_n(level_.free, cells, 0.0f);
    each_cell([&](std::size_t i, std::size_t cell) {
        to.mass[cell] = static_cast<float>(state_.mass[i] / mass_);
        level_.free[cell] = scratch_.weight[i] == 0.0 ? 0.0f : 1.0f;
    });
    for (float* each : to.stiffness) std::fill_n(each, cells, 0.0f);
    const std::span<const Plan::GridLink> links = Plan::part(plan_.grid_links, grid_.links);
    const double elastic = sum_of_links([&](std::size_t i) {
        const Plan::GridLink& each = links[i];
        const Link& link = state_.links[each.link];
        const double stiffness = stiffness_of(link), tension = link.tension;
        to.rest[each.step][each.cell] = link.rest;
        to.stiffness[each.step][each.cell] = static_cast<float>(stiffness);
        return 0.5 * tension * tension / (stiffness * unit_);
    });
    double rests = 0.0;
    for (const Plan::GridLink& each : links) rests += static_cast<double>(state_.links[each.link].rest);
    cloth_.energy = {.length = rests / (grid_.columns + grid_.rows), .gained = -elastic};
}

/// Computes the blocks of links at the current positions, their maximum strain, and twice the potential of
/// inertia and links, over the mean mass and times h^2.
void ClothSolver::evaluate() {
    detail::ClothArrays& to = cloth_.arrays;
    const dvec3 origin = scratch_.x[first_];
    each_cell([&](std::size_t i, std::size_t cell) {
        const dvec3 position = scratch_.x[i] - origin, lag = scratch_.base[i] - scratch_.x[i];
        for (int c = 0; c < 3; ++c) {
            const auto k = static_cast<std::size_t>(c);
            const float rounded = to.position[k][cell] = static_cast<float>(position[c]);
            to.rounding[k][cell] = static_cast<float>(position[c] - static_cast<double>(rounded));
            to.lag[k][cell] = static_cast<float>(lag[c]);
        }
    });
    in_cells([&](detail::GridRange cells) {
        scratch_.cloth_unit.links(level_, to, static_cast<float>(stiffness_), cloth_.parts.data(), cells);
    });
    strain_ = potential_ = 0.0;
    for (const detail::ClothPart& part : cloth_.parts) {
        strain_ = std::max(strain_, static_cast<double>(part.strain));
        potential_ += part.potential;
    }
}

/// Takes pinned particles out of the system.
void ClothSolver::pin() {
    for (std::size_t i = first_; i < first_ + state_.bodies[grid_.body].count; ++i) {
        if (scratch_.weight[i] != 0.0) continue;
        const std::size_t cell = cell_of(i);
        for (std::size_t k = 0; k < 6; ++k)
            level_.diagonal[k][cell] = k == 0 || k == 3 || k == 5 ? 1.0f : 0.0f;
        for (float* each : level_.right) each[cell] = 0.0f;
        for (std::size_t s = 0; s < detail::fine_steps; ++s)
            for (float* each : level_.links[s]) {
                each[cell] = 0.0f;
                *(each + cell - level_.step(s)) = 0.0f;  // memory extends before the first cell
            }
    }
}

/// A step of Newton's method. If it strains links, it is halved until the potential does not rise; the first
/// one is halved towards free motion.
int ClothSolver::step(int iterations, bool first, double max_residual) {
    const detail::GridSystem::Tolerance tolerance{first ? 0.0 : max_residual, relative_residual};
    in_cells([&](detail::GridRange cells) { scratch_.cloth_unit.cells(level_, cloth_.arrays, cells); });
    add_contacts();
    add_self_contacts();
    pin();
    // The first step is never the last, so it need not conserve angular momentum.
    const detail::GridVector* position = first ? nullptr : &cloth_.arrays.position;
    const auto solved =
        cloth_.system.solve(scratch_.grid_unit, lightest_, tolerance, iterations, position, local_.loops);
    converged_ = solved.converged;
    const detail::GridVector& by = cloth_.system.solution();
    if (first)
        each_cell([&](std::size_t i, std::size_t cell) {
            const dvec3 free = scratch_.base[i] - scratch_.x[i];
            scratch_.x[i] = scratch_.base[i];
            by[0][cell] -= static_cast<float>(free.x), by[1][cell] -= static_cast<float>(free.y);
            by[2][cell] -= static_cast<float>(free.z);
        });
    const auto move = [&](float part) {
        each_cell([&](std::size_t i, std::size_t cell) {
            scratch_.x[i] += dvec3(part * by[0][cell], part * by[1][cell], part * by[2][cell]);
        });
    };
    double before = potential();
    move(1.0f);
    evaluate();
    step_scale_ = 1.0;
    decrease_ = before - potential();
    if (strain_ <= accepted_strain) return solved.iterations;
    if (first) {
        move(-1.0f);
        evaluate();
        before = potential();
        move(1.0f);
        evaluate();
    }
    float part = 1.0f;
    for (int i = 0; i < max_halvings && !(potential() <= before); ++i) {
        part *= 0.5f;
        move(-part);
        evaluate();
    }
    if (!(potential() <= before)) {
        move(-part);
        evaluate();
        part = 0.0f;
    }
    decrease_ = before - potential();
    step_scale_ = part;
    return solved.iterations;
}

/// Twice the incremental potential at `position`.
double ClothSolver::potential() const {
    double sum = potential_;
    for (const ClothContact& each : local_.cloth_contacts) sum += potential_of(each);
    return sum + self_contact_potential();
}

double ClothSolver::add_links(double sum) const {
    for (const Plan::GridLink& each : Plan::part(plan_.grid_links, grid_.links)) {
        const Link& link = state_.links[each.link];
        const double longer = detail::length(scratch_.x[link.b] - scratch_.x[link.a]) - link.rest;
        sum += stiffness_of(link) * longer * longer;
    }
    return sum;
}

/// Stores the multipliers of links, and their energy.
void ClothSolver::finish() {
    const std::span<const Plan::GridLink> links = Plan::part(plan_.grid_links, grid_.links);
    const double elastic = sum_of_links([&](std::size_t i) {
        const Plan::GridLink& each = links[i];
        const Link& link = state_.links[each.link];
        const double longer = detail::length(scratch_.x[link.b] - scratch_.x[link.a]) - link.rest;
        const double pull = static_cast<double>(cloth_.arrays.stiffness[each.step][each.cell]) * longer;
        scratch_.multiplier[each.link] = mass_ * pull;
        return pull * longer;
    });
    cloth_.energy.elastic = 0.5 * unit_ * elastic;
    cloth_.energy.gained += cloth_.energy.elastic;
}

double ClothSolver::predict() {
    const double far = max_predicted_move * shortest_;
    double driven = 0.0, farthest = 0.0;
    const auto unchanged = [&](std::size_t i) { return state_.position[i] + state_.displacement[i]; };
    const std::size_t end = first_ + state_.bodies[grid_.body].count;
    for (std::size_t i = first_; i < end; ++i) {
        if (scratch_.weight[i] == 0.0) continue;
        const dvec3 by = scratch_.base[i] - unchanged(i);
        const double square = detail::dot(by, by);
        driven += state_.mass[i] / mass_ * square;
        farthest = std::max(farthest, square);
    }
    for (std::size_t i = first_; i < end && farthest < far * far; ++i)
        if (scratch_.weight[i] > 0.0) scratch_.x[i] = unchanged(i);
    forcing_ = driven;
    evaluate();
    const double small = residual_strain * shortest_;
    return std::min(force_residual * force_residual * driven, small * small * stiffness_);
}

/// Whether a collider or pin moves and may do work.
bool ClothSolver::is_driven() const {
    if (scratch_.body_near[grid_.body] == Scratch::Nearest::Moving) return true;
    for (std::size_t i = first_; i < first_ + state_.bodies[grid_.body].count; ++i)
        if (scratch_.weight[i] == 0.0 && scratch_.base[i] != state_.position[i]) return true;
    return false;
}

int ClothSolver::solve(int iterations) {
    load();
    const double max_residual = predict();
    const bool driven = is_driven();
    int max_taken = 0;
    for (int steps = 0;; ++steps) {
        find_contacts(steps == 0);
        find_self_contacts();
        // Unconverged residuals become motion in the next substep. The energy bound removes it, unless a
        // collider or pin drives the body.
        const bool settled = driven ? std::abs(decrease_) <= forcing_ && deepest() <= penetration_slop
                                    : deepest() <= accepted_depth * shortest_;
        const bool good = settled && strain_ <= accepted_strain;
        if (steps == max_newton_steps || (good && steps >= min_newton_steps)) break;
        max_taken = std::max(max_taken, step(iterations, steps == 0, max_residual));
        store_forces();
    }
    finish();
    push_colliders(local_.earlier_contacts);
    return max_taken;
}

}  // namespace tendril::rope
