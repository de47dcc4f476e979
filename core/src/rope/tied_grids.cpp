// Solves grids, and the bodies tied to them, as one system. The unknowns are the displacements x of all
// particles and the forces t of the ties that end on a grid:
//
//     A x + J^T t = right        J x - C t = -gap
//
// J x is how far the ties' ends separate, C the ties' compliance.
//
// Conjugate gradients iterate over the grids only. The preconditioner solves the same system with each grid's
// A replaced by its multilevel approximation (grid_system.hpp). Other bodies are eliminated exactly, which
// leaves a small dense system for t (N. Gould, M. Hribar, J. Nocedal, "On the Solution of Equality
// Constrained Quadratic Programming Problems Arising in Optimization", 2001). Stiff ties therefore cost no
// extra iterations, and their stiffness never enters single precision.
#include <algorithm>
#include <cmath>

#include "rope/geometry.hpp"
#include "rope/grid_system.hpp"
#include "rope/scratch.hpp"
#include "rope/tied_solver.hpp"

namespace tendril::rope {
namespace detail {
namespace {

/// The coarser level's cell that contains a cell.
std::size_t part_of_cell(const GridLevel& fine, const GridLevel& coarse, std::size_t cell) {
    return cell / fine.stride / 2 * coarse.stride + cell % fine.stride / 2;
}
void add_at(const GridVector& vector, std::size_t cell, const dvec3& value) {
    vector[0][cell] += static_cast<float>(value.x);
    vector[1][cell] += static_cast<float>(value.y);
    vector[2][cell] += static_cast<float>(value.z);
}
/// The smoother's response to a force on one cell.
dvec3 smoothed(const GridLevel& level, std::size_t cell, const dvec3& right) {
    const auto of = [&](std::size_t k) { return static_cast<double>(level.factor[k][cell]); };
    const double y = right.y - of(1) * right.x, z = right.z - of(2) * right.x - of(4) * y;
    const double to_z = of(5) * z, to_y = of(3) * y - of(4) * to_z;
    const double part = static_cast<double>(grid_damping);
    return {part * (of(0) * right.x - of(1) * to_y - of(2) * to_z), part * to_y, part * to_z};
}

}  // namespace

void GridSystem::factorize(const GridUnit& unit, float floor) {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const GridLevel& level = levels_[i];
        if (i > 0) unit.coarsen(levels_[i - 1], level, {0, level.rows});
        unit.factorize(level, floor, {0, level.cells()});
        for (float* each : level.product) std::fill_n(each, level.cells(), 0.0f);
    }
    factorize_coarsest();
    for (float* each : solution_) std::fill_n(each, finest().cells(), 0.0f);
    for (float* each : direction_) std::fill_n(each, finest().cells(), 0.0f);
    known_.assign(levels_.back().cells(), 0);
    inverse_.resize(translations() * translations());
}

double GridSystem::dot(const GridUnit& unit, const GridVector& a, const GridVector& b) {
    unit.dot(a, b, sums_.data(), {0, finest().cells()});
    double all = 0.0;
    for (const double sum : sums_) all += sum;
    return all;
}

void GridSystem::spread(const GridUnit& unit) {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const GridLevel& level = levels_[i];
        if (i > 0) unit.restrict_to(levels_[i - 1], level, {0, level.rows});
        if (i + 1 < levels_.size())
            unit.smooth_first(level, {0, level.cells()});
        else
            solve_coarsest(translations());
    }
}

dvec3 GridSystem::spread_at(std::size_t cell) const {
    dvec3 sum = value_at(levels_.front().x, cell);
    for (std::size_t i = 1; i < levels_.size(); ++i) {
        cell = part_of_cell(levels_[i - 1], levels_[i], cell);
        sum += value_at(levels_[i].x, cell);
    }
    return sum;
}

void GridSystem::push(std::size_t cell, const dvec3& force) {
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
        add_at(levels_[i].x, cell, smoothed(levels_[i], cell, force));
        cell = part_of_cell(levels_[i], levels_[i + 1], cell);
    }
    const std::size_t n = translations();
    for (std::size_t c = 0; c < 3; ++c) {
        const double *const column = inverse_column(cell, c), by = force[static_cast<glm::length_t>(c)];
        for (std::size_t i = 0; i < n; ++i) coarsest_x_[i] += by * column[i];
    }
}

void GridSystem::gather(const GridUnit& unit) {
    store_coarsest();
    for (std::size_t i = levels_.size() - 1; i-- > 0;)
        unit.prolong(levels_[i], levels_[i + 1], {0, levels_[i + 1].rows});
}

std::array<dvec3, 3> GridSystem::preconditioner_block(std::size_t a, std::size_t b) {
    constexpr std::array<dvec3, 3> units{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    std::array<dvec3, 3> columns{};
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
        if (a == b)
            for (std::size_t c = 0; c < 3; ++c) columns[c] += smoothed(levels_[i], a, units[c]);
        a = part_of_cell(levels_[i], levels_[i + 1], a), b = part_of_cell(levels_[i], levels_[i + 1], b);
    }
    const std::size_t at = number_of_coarsest(a);
    for (std::size_t c = 0; c < 3; ++c) {
        const double* const column = inverse_column(b, c);
        columns[c] += dvec3(column[at], column[at + 1], column[at + 2]);
    }
    return columns;
}

/// The first unknown of a cell of the coarsest level.
std::size_t GridSystem::number_of_coarsest(std::size_t cell) const {
    const GridLevel& level = levels_.back();
    return 3 * (cell / level.stride * level.columns + cell % level.stride);
}

const double* GridSystem::inverse_column(std::size_t cell, std::size_t component) {
    const std::size_t n = translations(), first = number_of_coarsest(cell);
    if (known_[cell] == 0)
        for (std::size_t c = first; c < first + 3; ++c) {
            double* const column = inverse_.data() + c * n;
            std::fill_n(column, n, 0.0);
            column[c] = 1.0;
            coarsest_.solve(column, n);
        }
    known_[cell] = 1;
    return inverse_.data() + (first + component) * n;
}

void GridSystem::update_direction(const GridUnit& unit, float by) {
    const GridLevel& level = finest();
    unit.scale_and_add(by, level.x, direction_, {0, level.cells()});
    unit.multiply(level, direction_, product_, {0, level.cells()});
}
void GridSystem::add_to_product(std::size_t cell, const dvec3& force) {
    add_at(product_, cell, force);
}
void GridSystem::advance(const GridUnit& unit, float part) {
    const GridLevel& level = finest();
    unit.add(part, direction_, solution_, {0, level.cells()});
    unit.add(-part, product_, level.right, {0, level.cells()});
}
void GridSystem::add_x(const GridUnit& unit) {
    unit.add(1.0f, finest().x, solution_, {0, finest().cells()});
}

}  // namespace detail

using glm::dvec3;

void TieForces::resize(std::size_t ties, std::size_t nodes) {
    ends.resize(ties);
    system.resize(3 * ties);
    flat.resize(3 * ties);
    for (auto* each : {&gap, &now, &direction, &total}) each->resize(ties);
    local.resize(nodes);
}

void TieForces::solve() {
    for (std::size_t i = 0; i < ends.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) flat[3 * i + c] = now[i][static_cast<glm::length_t>(c)];
    system.solve(flat.data(), flat.size());
    for (std::size_t i = 0; i < ends.size(); ++i) now[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
}

namespace {

constexpr double max_compliance_across = 1e3;  ///< for a slack tie: no sideways resistance

}  // namespace

/// Loads the ends, gap and compliance of each tie.
void TiedSolver::load_ties() {
    TieForces& forces = scratch_.tie_forces[island_.tied - 1];
    const std::size_t n = 3 * forces.ends.size();
    std::fill(forces.system.matrix.begin(), forces.system.matrix.end(), 0.0);
    for (std::size_t i = 0; i < forces.ends.size(); ++i) {
        const std::uint32_t number = tied_.across[i];
        const Tie& tie = state_.ties[number];
        const auto end = [&](std::uint32_t particle, double sign) {
            const std::uint32_t grid = grid_of_particle(particle);
            using Of = TieForces::End::Of;
            const Of of = scratch_.weight[particle] == 0.0 ? Of::Pinned : grid > 0 ? Of::Grid : Of::Node;
            return TieForces::End{of, grid > 0 ? grid - 1 - tied_.grids.first : 0,
                                  plan_.system_index[particle], sign};
        };
        forces.ends[i] = {end(tie.a, -1.0), end(tie.b, 1.0)};
        const dvec3 apart = scratch_.x[tie.b] - scratch_.x[tie.a];
        const double rest = detail::enforced_length(tie, h_), length = detail::length(apart);
        const double along = 1.0 / tie_stiffness(tie);
        double across = along;
        dvec3 n_of(1.0, 0.0, 0.0);
        forces.gap[i] = apart;
        if (rest > 0.0) {
            if (length > 1e-30) n_of = (1.0 / length) * apart;
            forces.gap[i] = (length - rest) * n_of;
            const double taut = std::max(scratch_.tie_multiplier[number], 0.0) / mass_;
            across = std::clamp(std::max(length, 1e-9) / std::max(taut, 1e-30), along, max_compliance_across);
        }
        for (glm::length_t r = 0; r < 3; ++r)
            for (glm::length_t c = 0; c < 3; ++c)
                forces.system
                    .matrix[(3 * i + static_cast<std::size_t>(r)) * n + 3 * i + static_cast<std::size_t>(c)] =
                    (r == c ? across : 0.0) + (along - across) * n_of[r] * n_of[c];
    }
}

/// Adds to the matrix how each tie's force moves the ends of all ties.
void TiedSolver::add_responses() {
    TieForces& forces = scratch_.tie_forces[island_.tied - 1];
    using Of = TieForces::End::Of;
    const std::size_t n = 3 * forces.ends.size();
    for (std::size_t j = 0; j < forces.ends.size(); ++j) {
        for (const TieForces::End& b : forces.ends[j]) {
            if (b.of != Of::Grid) continue;
            detail::GridSystem& system = scratch_.cloths[tied_.grids.first + b.grid].system;
            for (std::size_t i = j; i < forces.ends.size(); ++i)
                for (const TieForces::End& a : forces.ends[i]) {
                    if (a.of != Of::Grid || a.grid != b.grid) continue;
                    const std::array<dvec3, 3> columns = system.preconditioner_block(a.at, b.at);
                    for (std::size_t c = 0; c < 3; ++c)
                        for (std::size_t r = 0; r < 3; ++r)
                            forces.system.matrix[(3 * i + r) * n + 3 * j + c] +=
                                a.sign * b.sign * columns[c][static_cast<glm::length_t>(r)];
                }
        }
        const auto rest = [](const TieForces::End& end) { return end.of == Of::Node; };
        if (std::none_of(forces.ends[j].begin(), forces.ends[j].end(), rest)) continue;
        const std::uint32_t late = tied_.order.late;
        for (std::size_t c = 0; c < 3; ++c) {
            std::fill(forces.local.begin() + late, forces.local.end(), dvec3(0.0));
            for (const TieForces::End& b : forces.ends[j])
                if (rest(b)) forces.local[b.at][static_cast<glm::length_t>(c)] = b.sign;
            system_.eliminate(tied_.order, forces.local, late);
            system_.substitute(tied_.order, forces.local, late);
            for (std::size_t i = j; i < forces.ends.size(); ++i)
                for (const TieForces::End& a : forces.ends[i])
                    for (std::size_t r = 0; rest(a) && r < 3; ++r)
                        forces.system.matrix[(3 * i + r) * n + 3 * j + c] +=
                            a.sign * forces.local[a.at][static_cast<glm::length_t>(r)];
        }
    }
}

/// Solves the system that assemble() built. Grids store their own solutions; the rest is in system_.x.
void TiedSolver::solve_with_grids(const detail::GridSystem::Tolerance& tolerance, int iterations) {
    using Of = TieForces::End::Of;
    TieForces& forces = scratch_.tie_forces[island_.tied - 1];
    const detail::GridUnit& unit = scratch_.grid_unit;
    const std::uint32_t late = tied_.order.late;
    const auto each_grid = [&](auto visit) {
        for (std::uint32_t g = 0; g < tied_.grids.count; ++g)
            visit(scratch_.cloths[tied_.grids.first + g].system);
    };
    const auto each_end = [&](Of of, auto visit) {
        for (std::size_t i = 0; i < forces.ends.size(); ++i)
            for (const TieForces::End& end : forces.ends[i])
                if (end.of == of) visit(i, end);
    };
    const auto grid_of = [&](const TieForces::End& end) -> detail::GridSystem& {
        return scratch_.cloths[tied_.grids.first + end.grid].system;
    };
    load_ties();
    system_.factorize(tied_.order);
    each_grid([&](detail::GridSystem& grid) { grid.factorize(unit, lightest_); });
    add_responses();
    forces.system.factorize(forces.system.size);

    // Displacements of the other bodies without these ties.
    std::copy(system_.x.begin() + late, system_.x.end(), forces.local.begin() + late);
    system_.substitute(tied_.order, forces.local, late);
    forces.now = forces.gap;
    each_end(Of::Node, [&](std::size_t i, const TieForces::End& end) {
        forces.now[i] += end.sign * forces.local[end.at];
    });
    /// Solves for the grids' residuals and the gaps in `now`, which become forces.
    const auto precondition = [&] {
        each_grid([&](detail::GridSystem& grid) { grid.spread(unit); });
        each_end(Of::Grid, [&](std::size_t i, const TieForces::End& end) {
            forces.now[i] += end.sign * grid_of(end).spread_at(end.at);
        });
        forces.solve();
        each_end(Of::Grid, [&](std::size_t i, const TieForces::End& end) {
            grid_of(end).push(end.at, -end.sign * forces.now[i]);
        });
        each_grid([&](detail::GridSystem& grid) { grid.gather(unit); });
    };
    const auto update_direction = [&](float by) {
        each_grid([&](detail::GridSystem& grid) { grid.update_direction(unit, by); });
        for (std::size_t i = 0; i < forces.ends.size(); ++i)
            forces.direction[i] = forces.now[i] + static_cast<double>(by) * forces.direction[i];
        each_end(Of::Grid, [&](std::size_t i, const TieForces::End& end) {
            grid_of(end).add_to_product(end.at, end.sign * forces.direction[i]);
        });
    };
    const auto advance = [&](float part) {
        each_grid([&](detail::GridSystem& grid) { grid.advance(unit, part); });
        for (std::size_t i = 0; i < forces.ends.size(); ++i)
            forces.total[i] += static_cast<double>(part) * forces.direction[i];
    };
    precondition();
    double size = 0.0;  // size of the residual, less the ties' part
    each_grid([&](detail::GridSystem& grid) { size += grid.residual_dot_x(unit); });
    each_end(Of::Grid, [&](std::size_t i, const TieForces::End& end) {
        size -= end.sign * detail::dot(forces.now[i], detail::value_at(grid_of(end).finest().x, end.at));
    });
    const double max_residual = std::max(tolerance.square, tolerance.relative * tolerance.relative * size);
    std::fill(forces.total.begin(), forces.total.end(), dvec3(0.0));
    std::fill(forces.direction.begin(), forces.direction.end(), dvec3(0.0));
    update_direction(0.0f);
    advance(1.0f);
    double before = 1.0;
    for (int i = 0;; ++i) {
        std::fill(forces.now.begin(), forces.now.end(), dvec3(0.0));
        precondition();
        double now = 0.0, curvature = 0.0;
        each_grid([&](detail::GridSystem& grid) { now += grid.residual_dot_x(unit); });
        if (now <= max_residual || i >= iterations || !std::isfinite(now)) break;
        update_direction(i == 0 ? 0.0f : static_cast<float>(now / before));
        before = now;
        each_grid([&](detail::GridSystem& grid) { curvature += grid.direction_dot_product(unit); });
        if (!(curvature > 0.0)) break;
        advance(static_cast<float>(now / curvature));
    }
    // One more preconditioned correction by the final residual.
    each_grid([&](detail::GridSystem& grid) { grid.add_x(unit); });
    for (std::size_t i = 0; i < forces.ends.size(); ++i) forces.total[i] += forces.now[i];

    std::fill(forces.local.begin() + late, forces.local.end(), dvec3(0.0));
    each_end(Of::Node, [&](std::size_t i, const TieForces::End& end) {
        forces.local[end.at] -= end.sign * forces.total[i];
    });
    system_.eliminate(tied_.order, forces.local, late);
    for (std::size_t i = late; i < system_.x.size(); ++i) system_.x[i] += forces.local[i];
    system_.substitute(tied_.order, system_.x, 0);
    for (std::size_t i = 0; i < forces.ends.size(); ++i) {
        const Tie& tie = state_.ties[tied_.across[i]];
        const dvec3& force = forces.total[i];
        const dvec3 apart = scratch_.x[tie.b] - scratch_.x[tie.a];
        scratch_.tie_multiplier[tied_.across[i]] =
            mass_ * (detail::enforced_length(tie, h_) > 0.0 ? detail::dot(force, detail::unit(apart))
                                                            : detail::length(force));
    }
}

}  // namespace tendril::rope
