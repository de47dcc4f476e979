#include "rope/grid_system.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tendril::rope::detail {
namespace {

/// Size of the coarsest level, which is solved exactly.
constexpr std::size_t coarsest = 4;
/// Minimum pivot of a rotation, relative to its diagonal.
constexpr double min_pivot = 1e-3;

/// Distributes one block of memory over the arrays of levels; with null it only counts.
class Arrays {
  public:
    explicit Arrays(float* memory) : next_(memory) {}

    void of(GridLevel& level) {
        take(level, level.free);
        take(level, level.diagonal);
        take(level, level.factor);
        for (std::size_t s = 0; s < level.steps; ++s) take(level, level.links[s]);
        for (GridVector* vector : {&level.right, &level.x, &level.product}) take(level, *vector);
    }
    void take(const GridLevel& level, std::span<float*> arrays) {
        for (float*& each : arrays) take(level, each);
    }
    std::size_t taken() const { return taken_; }

  private:
    void take(const GridLevel& level, float*& array) {
        // A register may begin a link before the first cell or after the last.
        const std::size_t around = 2 * level.stride + 4 * grid_lanes;
        if (next_ != nullptr) array = next_ + taken_ + around;
        taken_ += level.cells() + 2 * around;
    }

    float* next_;
    std::size_t taken_ = 0;
};

}  // namespace

void GridSystem::resize(std::size_t columns, std::size_t rows, std::span<float*> others) {
    levels_.clear();
    couplings_.clear();
    for (;;) {
        GridLevel level;
        level.columns = columns, level.rows = rows;
        level.stride = grid_stride(columns);
        level.steps = levels_.empty() ? fine_steps : coarse_steps;
        levels_.push_back(level);
        if (std::max(columns, rows) <= coarsest) break;
        columns = (columns + 1) / 2, rows = (rows + 1) / 2;
    }
    const auto weight = [&](float* memory) {
        Arrays arrays(memory);
        for (GridLevel& level : levels_) arrays.of(level);
        for (GridVector* vector : {&solution_, &direction_, &product_}) arrays.take(levels_.front(), *vector);
        arrays.take(levels_.front(), others);
        return arrays.taken();
    };
    sums_.resize((levels_.front().cells() + dot_cells - 1) / dot_cells);
    constexpr std::size_t line = 16;
    memory_.assign(weight(nullptr) + line, 0.0f);
    const std::size_t off = reinterpret_cast<std::uintptr_t>(memory_.data()) / sizeof(float) % line;
    weight(memory_.data() + (line - off) % line);
}

/// Runs operations on levels, in parts if threads help.
class GridSystem::Loops {
  public:
    Loops(const GridUnit& of, tendril::detail::ForkJoin& loops) : unit(of), loops_(loops) {}

    template <class Work>
    void cells(const GridLevel& level, Work work) const {
        in_parts(loops_, level.cells(), part_cells, level.cells() >= min_shared_cells, work);
    }
    /// Over rows of the next level; each of its cells is four of this level's.
    template <class Work>
    void rows(const GridLevel& next, Work work) const {
        in_parts(loops_, next.rows, std::max<std::size_t>(1, part_cells / 4 / next.stride),
                 4 * next.cells() >= min_shared_cells, work);
    }
    void multiply(const GridLevel& level, const GridVector& x, const GridVector& product) const {
        cells(level, [&](GridRange part) { unit.multiply(level, x, product, part); });
    }

    const GridUnit& unit;

  private:
    tendril::detail::ForkJoin& loops_;
};

/// The rows of rotations follow in the same matrix; balance() fills them.
void GridSystem::factorize_coarsest() {
    const GridLevel& level = levels_.back();
    const std::size_t columns = level.columns, cells = columns * level.rows, n = 3 * cells + rotations;
    constexpr std::size_t part[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    coarsest_.resize(n);
    std::vector<double>& a = coarsest_.matrix;
    a.assign(n * n, 0.0);
    coarsest_x_.assign(n, 0.0);
    const auto put = [&](std::size_t i, std::size_t j, const GridBlocks& blocks, std::size_t cell,
                         double by) {
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c)
                a[(3 * i + r) * n + 3 * j + c] += by * static_cast<double>(blocks[part[r][c]][cell]);
    };
    for (std::size_t row = 0; row < level.rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t cell = row * level.stride + column, i = row * columns + column;
            put(i, i, level.diagonal, cell, 1.0);
            for (std::size_t s = 0; s < level.steps; ++s) {
                const auto there = static_cast<std::ptrdiff_t>(column) + grid_steps[s].column;
                const std::size_t below = row + static_cast<std::size_t>(grid_steps[s].row);
                if (there < 0 || static_cast<std::size_t>(there) >= columns || below >= level.rows) continue;
                const std::size_t j = below * columns + static_cast<std::size_t>(there);
                put(std::max(i, j), std::min(i, j), level.links[s], cell, -1.0);
            }
        }
    const std::size_t shift = levels_.size() - 1, stride = finest().stride;
    for (const GridCoupling& coupling : couplings_)
        for (std::size_t p = 0; p < 4; ++p)
            for (std::size_t q = 0; q < 4; ++q) {
                const auto row_of = [&](std::uint32_t cell) {
                    return 3 * ((cell / stride >> shift) * columns + (cell % stride >> shift));
                };
                const std::size_t i = row_of(coupling.cells[p]), j = row_of(coupling.cells[q]);
                if (j > i) continue;
                const auto weight = static_cast<double>(coupling.weights[p] * coupling.weights[q]);
                for (std::size_t r = 0; r < 3; ++r)
                    for (std::size_t c = 0; c < 3; ++c) {
                        const float beyond =
                            (coupling.along - coupling.across) * coupling.normal[r] * coupling.normal[c];
                        a[(i + r) * n + j + c] +=
                            weight * static_cast<double>(beyond + (r == c ? coupling.across : 0.0f));
                    }
            }
    coarsest_.factorize(3 * cells);
}

void GridSystem::multiply(const Loops& loops, const GridVector& x) {
    loops.multiply(finest(), x, product_);
    for (const GridCoupling& coupling : couplings_) {
        std::array<float, 3> by{};
        for (std::size_t p = 0; p < 4; ++p)
            for (std::size_t c = 0; c < 3; ++c) by[c] += coupling.weights[p] * x[c][coupling.cells[p]];
        const float beyond =
            (coupling.along - coupling.across) *
            (coupling.normal[0] * by[0] + coupling.normal[1] * by[1] + coupling.normal[2] * by[2]);
        for (std::size_t p = 0; p < 4; ++p)
            for (std::size_t c = 0; c < 3; ++c)
                product_[c][coupling.cells[p]] +=
                    coupling.weights[p] * (beyond * coupling.normal[c] + coupling.across * by[c]);
    }
}

/// Calls `visit` with the component and the cell of each unknown of the coarsest level.
template <class Visit>
void GridSystem::each_coarsest(Visit visit) {
    const GridLevel& level = levels_.back();
    for (std::size_t i = 0; i < translations(); ++i)
        visit(i, i % 3, i / 3 / level.columns * level.stride + i / 3 % level.columns);
}

/// Solves for the first `n` unknowns.
void GridSystem::solve_coarsest(std::size_t n) {
    const GridLevel& level = levels_.back();
    each_coarsest([&](std::size_t i, std::size_t c, std::size_t cell) {
        coarsest_x_[i] = static_cast<double>(level.right[c][cell]);
    });
    coarsest_.solve(coarsest_x_.data(), n);
    store_coarsest();
}

void GridSystem::store_coarsest() {
    const GridLevel& level = levels_.back();
    each_coarsest([&](std::size_t i, std::size_t c, std::size_t cell) {
        level.x[c][cell] = static_cast<float>(coarsest_x_[i]);
    });
}

/// Sums of a vector over each cell of the coarsest level, to its right side.
void GridSystem::project(const Loops& loops, const GridVector& vector) {
    GridLevel level = finest();
    level.right = vector;
    for (std::size_t i = 1; i < levels_.size(); ++i) {
        loops.rows(levels_[i], [&](GridRange part) { loops.unit.restrict_to(level, levels_[i], part); });
        level = levels_[i];
    }
}

/// Makes the residual orthogonal to translations of each cell of the coarsest level and, if positions are
/// given, to rotations of the whole: however early the iteration ended, large parts keep their momentum, and
/// the whole its angular momentum.
void GridSystem::balance(const Loops& loops, const GridVector* position) {
    if (levels_.size() == 1) return;  // solved exactly
    const GridLevel &fine = finest(), &coarse = levels_.back();
    const std::size_t n = coarsest_.size, first = translations();
    for (const GridLevel& level : levels_)
        for (float* each : level.product) std::fill_n(each, level.cells(), 0.0f);
    // Positions relative to the middle of the grid, and their negatives.
    const GridVector &from = direction_, &opposite = fine.x;
    float* const none = fine.product[0];
    const GridVector about[rotations] = {
        {none, opposite[2], from[1]}, {from[2], none, opposite[0]}, {opposite[1], from[0], none}};
    const std::size_t middle = fine.rows / 2 * fine.stride + fine.columns / 2;
    for (std::size_t c = 0; c < 3 && position != nullptr; ++c) {
        const float* const all = (*position)[c];
        for (std::size_t i = 0; i < fine.cells(); ++i) {
            from[c][i] = fine.free[i] * (all[i] - all[middle]);
            opposite[c][i] = -from[c][i];
        }
    }
    for (std::size_t k = 0; k < rotations && position != nullptr; ++k) {
        double* const row = coarsest_.matrix.data() + (first + k) * n;
        multiply(loops, about[k]);
        project(loops, product_);
        each_coarsest([&](std::size_t i, std::size_t c, std::size_t cell) {
            row[i] = static_cast<double>(coarse.right[c][cell]);
        });
        for (std::size_t j = 0; j <= k; ++j) row[first + j] = dot(loops, about[j], product_);
        coarsest_x_[first + k] = dot(loops, about[k], fine.right);
        // Drops a rotation about an axis through all free particles.
        if (!(coarsest_.factorize_row(first + k) > min_pivot)) coarsest_.drop_row(first + k);
    }
    project(loops, fine.right);
    solve_coarsest(position != nullptr ? n : first);
    for (std::size_t k = 0; k < rotations && position != nullptr; ++k) {
        const auto angle = static_cast<float>(coarsest_x_[first + k]);
        loops.cells(fine, [&](GridRange part) { loops.unit.add(angle, about[k], solution_, part); });
    }
    for (std::size_t i = levels_.size() - 1; i-- > 0;) {
        const GridLevel &level = levels_[i], &next = levels_[i + 1];
        for (float* each : level.x) std::fill_n(each, level.cells(), 0.0f);
        loops.rows(next, [&](GridRange part) { loops.unit.prolong(level, next, part); });
    }
    loops.cells(fine, [&](GridRange part) { loops.unit.add(1.0f, fine.x, solution_, part); });
}

double GridSystem::dot(const Loops& loops, const GridVector& a, const GridVector& b) {
    loops.cells(finest(), [&](GridRange part) { loops.unit.dot(a, b, sums_.data(), part); });
    double all = 0.0;
    for (const double sum : sums_) all += sum;
    return all;
}

/// One cycle: computes x from the right side.
void GridSystem::precondition(const Loops& loops, std::size_t index) {
    const GridUnit& unit = loops.unit;
    const GridLevel& level = levels_[index];
    if (index + 1 == levels_.size()) return solve_coarsest(translations());
    loops.cells(level, [&](GridRange part) { unit.smooth_first(level, part); });
    const GridLevel& next = levels_[index + 1];
    loops.multiply(level, level.x, level.product);
    loops.rows(next, [&](GridRange part) { unit.restrict_to(level, next, part); });
    precondition(loops, index + 1);
    loops.rows(next, [&](GridRange part) { unit.prolong(level, next, part); });
    loops.multiply(level, level.x, level.product);
    loops.cells(level, [&](GridRange part) { unit.smooth(level, part); });
}

GridSystem::Solved GridSystem::solve(const GridUnit& unit, float floor, const Tolerance& tolerance,
                                     int iterations, const GridVector* position,
                                     tendril::detail::ForkJoin& with) {
    const Loops loops(unit, with);
    const GridLevel& fine = finest();
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const GridLevel& level = levels_[i];
        if (i > 0) loops.rows(level, [&](GridRange part) { unit.coarsen(levels_[i - 1], level, part); });
        loops.cells(level, [&](GridRange part) { unit.factorize(level, floor, part); });
    }
    factorize_coarsest();
    for (float* array : solution_) std::fill_n(array, fine.cells(), 0.0f);
    for (float* array : direction_) std::fill_n(array, fine.cells(), 0.0f);
    Solved solved;
    double max_residual = 0.0, before = 0.0;
    for (;; ++solved.iterations) {
        precondition(loops, 0);
        const double now = dot(loops, fine.right, fine.x);
        if (solved.iterations == 0)
            max_residual = std::max(tolerance.square, tolerance.relative * tolerance.relative * now);
        if (!std::isfinite(now)) return solved;
        solved.converged = now <= max_residual;
        if (solved.converged || solved.iterations >= iterations) {
            balance(loops, position);
            return solved;
        }
        const float beta = solved.iterations == 0 ? 0.0f : static_cast<float>(now / before);
        loops.cells(fine, [&](GridRange part) { unit.scale_and_add(beta, fine.x, direction_, part); });
        before = now;
        multiply(loops, direction_);
        const double curvature = dot(loops, direction_, product_);
        if (!(curvature > 0.0)) return solved;
        const auto length = static_cast<float>(now / curvature);
        loops.cells(fine, [&](GridRange part) {
            unit.add(length, direction_, solution_, part);
            unit.add(-length, product_, fine.right, part);
        });
    }
}

}  // namespace tendril::rope::detail
