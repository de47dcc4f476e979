// A symmetric system of 3 x 3 blocks over a grid of particles, and its solution by conjugate gradients. Not
// installed.
//
//     (D_i x_i) - sum over links ij of H_ij x_j = r_i
//
// H_ij is symmetric and positive semidefinite, and D_i is the sum of the H_ij of its links, plus something
// that is positive definite. Links lead to the neighbours of a particle and to the next but one in its row
// and column. The preconditioner is one multigrid cycle, V(1,1), with damped block Jacobi as smoother: 2 x 2
// particles make one of the next level, whose blocks are sums of theirs, so the number of iterations hardly
// grows with the grid (W. Briggs, V. Henson, S. McCormick, "A Multigrid Tutorial", 2000; Y. Notay, "An
// aggregation-based algebraic multigrid method", 2010).
//
// Numbers are kept in single precision, each component of a block in an array of its own. Every vector unit
// gives the same bits: nothing is fused, and sums are taken in an order that does not depend on its width.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "math/fork_join.hpp"

namespace tendril::rope::detail {

/// To the other end of a link. A coarser level has the first four only.
struct GridStep {
    int column, row;
};
inline constexpr std::array<GridStep, 6> grid_steps{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}}};
inline constexpr std::size_t fine_steps = grid_steps.size(), coarse_steps = 4;

/// Rows and arrays are whole registers of so many numbers.
inline constexpr std::size_t grid_lanes = 8;

inline std::size_t grid_stride(std::size_t columns) {
    return (columns + grid_lanes - 1) / grid_lanes * grid_lanes;
}

using GridVector = std::array<float*, 3>;
/// xx, xy, xz, yy, yz, zz
using GridBlocks = std::array<float*, 6>;

/// One level. Its cells are numbered by row * stride + column. What lies beyond the columns, and before and
/// behind the cells for as far as a link reaches, can be read; it has no links.
struct GridLevel {
    std::size_t columns = 0, rows = 0, stride = 0, steps = fine_steps;
    float* free = nullptr;  ///< 1: a cell that moves, 0: one that is pinned, or none
    GridBlocks diagonal{};
    GridBlocks factor{};  ///< of the diagonal: 1 / d of L d L^T, and below the diagonal of L
    std::array<GridBlocks, fine_steps> links{};
    GridVector right{}, x{}, product{};

    std::size_t cells() const { return rows * stride; }
    std::ptrdiff_t step(std::size_t s) const {
        return grid_steps[s].column + grid_steps[s].row * static_cast<std::ptrdiff_t>(stride);
    }
};

/// From the first up to the end: cells, by whole registers, or rows.
struct GridRange {
    std::size_t first = 0, end = 0;
};

/// Of so many cells a dot product is summed up in single precision.
inline constexpr std::size_t dot_cells = 8 * grid_lanes;

/// Of a level that threads share: with less they wait longer for each other than they help.
inline constexpr std::size_t min_shared_cells = 8192;

/// What is done to a part of a level, compiled for each vector unit. Parts can be done side by side.
struct GridUnit {
    /// Of the diagonal, where no pivot is less than `floor`.
    void (*factorize)(const GridLevel&, float floor, GridRange cells) = nullptr;
    /// The blocks of the next level and which of its cells are free, for rows of that.
    void (*coarsen)(const GridLevel&, const GridLevel&, GridRange rows) = nullptr;
    /// product = A x, of any two vectors
    void (*multiply)(const GridLevel&, const GridVector& x, const GridVector& product,
                     GridRange cells) = nullptr;
    /// x = damping D^-1 right
    void (*smooth_first)(const GridLevel&, GridRange cells) = nullptr;
    /// x += damping D^-1 (right - product)
    void (*smooth)(const GridLevel&, GridRange cells) = nullptr;
    /// The next level's right side: sums of right - product, for rows of that level.
    void (*restrict_to)(const GridLevel&, const GridLevel&, GridRange rows) = nullptr;
    /// x += the next level's, where it is free, from rows of that level.
    void (*prolong)(const GridLevel&, const GridLevel&, GridRange rows) = nullptr;
    /// One sum for each dot_cells, which the range begins with a multiple of.
    void (*dot)(const GridVector&, const GridVector&, double* sums, GridRange cells) = nullptr;
    /// to += factor from
    void (*add)(float factor, const GridVector& from, const GridVector& to, GridRange cells) = nullptr;
    /// to = from + factor to
    void (*scale_and_add)(float factor, const GridVector& from, const GridVector& to,
                          GridRange cells) = nullptr;
};
/// As vector_unit().
GridUnit grid_unit(std::string_view name) noexcept;

class GridSystem {
  public:
    /// Takes memory for a grid, all zero, and for `others`, arrays like those of its finest level.
    void resize(std::size_t columns, std::size_t rows, std::span<float*> others = {});
    /// To be filled: `free`, the diagonal, the blocks of links and the right side; of a cell that is not
    /// free the diagonal is 1 and all else 0, blocks of its links too. solve() changes the right side.
    GridLevel& finest() { return levels_.front(); }

    struct Solved {
        int iterations = 0;
        bool converged = false;
    };
    /// Until the residual, in the norm of the preconditioner, is `tolerance` of what it was. `floor`: the
    /// least eigenvalue that a block of the diagonal can have. `loops`: who may help, which changes no bit.
    Solved solve(const GridUnit& unit, float floor, double tolerance, int iterations,
                 tendril::detail::ForkJoin& loops);
    const GridVector& solution() const { return solution_; }

  private:
    class Loops;
    void precondition(const Loops& loops, std::size_t level);

    std::vector<float> memory_;
    std::vector<double> sums_;  ///< of a dot product
    std::vector<GridLevel> levels_;
    GridVector solution_{}, direction_{}, product_{};
};

}  // namespace tendril::rope::detail
