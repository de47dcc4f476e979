// A symmetric system of 3 x 3 blocks over a grid of particles, solved by conjugate gradients. Not installed.
//
//     (D_i x_i) - sum over links ij of H_ij x_j = r_i
//
// H_ij is symmetric and positive semidefinite, and D_i is the sum of the H_ij of its links plus a positive
// definite block. Links lead to a particle's neighbours, and to the next but one in its row and column. The
// preconditioner is one multigrid cycle, V(1,1), with damped block Jacobi as smoother. 2 x 2 particles form
// one of the next level, whose blocks are sums of theirs, so the number of iterations hardly grows with the
// grid (W. Briggs, V. Henson, S. McCormick, "A Multigrid Tutorial", 2000; Y. Notay, "An aggregation-based
// algebraic multigrid method", 2010).
//
// The residual after an early end is balanced: it is made orthogonal to the translations of large parts and
// to the rotations of the whole (deflation by rigid modes: T. Jonsthovel, M. van Gijzen, S. MacLachlan, C.
// Vuik, A. Scarpas, "Comparison of the deflated preconditioned conjugate gradient method and algebraic
// multigrid for composite materials", 2012). Otherwise small errors of the same sign add up to a turn.
//
// Numbers are in single precision, each component of a block in an array of its own. Every vector unit gives
// the same bits: nothing is fused, and the order of sums does not depend on the unit's width.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "math/fork_join.hpp"
#include "rope/elimination.hpp"

namespace tendril::rope::detail {

/// The offset to the other end of a link. Coarser levels have only the first four.
struct GridStep {
    int column, row;
};
inline constexpr std::array<GridStep, 6> grid_steps{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}}};
inline constexpr std::size_t fine_steps = grid_steps.size(), coarse_steps = 4;
inline constexpr float grid_damping = 0.6f;  ///< damping of the smoother

/// Rows and arrays are padded to a multiple of this.
inline constexpr std::size_t grid_lanes = 8;

inline std::size_t grid_stride(std::size_t columns) {
    return (columns + grid_lanes - 1) / grid_lanes * grid_lanes;
}

using GridVector = std::array<float*, 3>;
inline dvec3 value_at(const GridVector& vector, std::size_t cell) {
    return {vector[0][cell], vector[1][cell], vector[2][cell]};
}
/// xx, xy, xz, yy, yz, zz
using GridBlocks = std::array<float*, 6>;

/// One level. Cell index: row * stride + column. Memory beyond the columns, and before and after the cells as
/// far as a link reaches, is readable and has no links.
struct GridLevel {
    std::size_t columns = 0, rows = 0, stride = 0, steps = fine_steps;
    float* free = nullptr;  ///< 1: a cell that moves; 0: pinned, or no cell
    GridBlocks diagonal{};
    GridBlocks factor{};  ///< factors of the diagonal: 1 / d of L d L^T, and L below its diagonal
    std::array<GridBlocks, fine_steps> links{};
    GridVector right{}, x{}, product{};

    std::size_t cells() const { return rows * stride; }
    std::ptrdiff_t step(std::size_t s) const {
        return grid_steps[s].column + grid_steps[s].row * static_cast<std::ptrdiff_t>(stride);
    }
};

/// Couples up to four cells anywhere: a spring between two of their means, with stiffness `along` in its
/// direction and `across` sideways.
struct GridCoupling {
    std::array<std::uint32_t, 4> cells{};
    std::array<float, 4> weights{};  ///< 0 for a cell that is not free
    std::array<float, 3> normal{};
    float along = 0.0f, across = 0.0f;
};

/// A half-open range: of cells, in whole registers, or of rows.
struct GridRange {
    std::size_t first = 0, end = 0;
};

/// A dot product is summed in single precision over this many cells.
inline constexpr std::size_t dot_cells = 8 * grid_lanes;

/// Minimum size of a level that threads share: on smaller ones waiting costs more than sharing gains.
inline constexpr std::size_t min_shared_cells = 8192;

/// The unit of work that threads share in a loop.
inline constexpr std::size_t part_cells = 16 * dot_cells;

/// Calls `work` with ranges of up to `size` out of `count`, in parallel if the level is large and threads
/// help.
template <class Work>
void in_parts(tendril::detail::ForkJoin& loops, std::size_t count, std::size_t size, bool large, Work work) {
    constexpr std::size_t max_parts = tendril::detail::ForkJoin::max_parts;
    if (!large || !loops.shared() || count > max_parts * size) return work(GridRange{0, count});
    const auto parts = static_cast<std::uint32_t>((count + size - 1) / size);
    loops.run(parts, [&](std::uint32_t part) {
        const std::size_t first = part * size;
        work(GridRange{first, first + size < count ? first + size : count});
    });
}

/// Operations on part of a level, compiled for each vector unit. Parts can be processed in parallel.
struct GridUnit {
    /// Factorizes the diagonal; no pivot is below `floor`.
    void (*factorize)(const GridLevel&, float floor, GridRange cells) = nullptr;
    /// Computes the next level's blocks and free cells, for rows of that level.
    void (*coarsen)(const GridLevel&, const GridLevel&, GridRange rows) = nullptr;
    /// product = A x
    void (*multiply)(const GridLevel&, const GridVector& x, const GridVector& product,
                     GridRange cells) = nullptr;
    /// x = damping D^-1 right
    void (*smooth_first)(const GridLevel&, GridRange cells) = nullptr;
    /// x += damping D^-1 (right - product)
    void (*smooth)(const GridLevel&, GridRange cells) = nullptr;
    /// The next level's right side: sums of right - product, for rows of that level.
    void (*restrict_to)(const GridLevel&, const GridLevel&, GridRange rows) = nullptr;
    /// x += the next level's x on free cells, for rows of that level.
    void (*prolong)(const GridLevel&, const GridLevel&, GridRange rows) = nullptr;
    /// One sum per dot_cells; the range begins at a multiple of it.
    void (*dot)(const GridVector&, const GridVector&, double* sums, GridRange cells) = nullptr;
    /// to += factor from
    void (*add)(float factor, const GridVector& from, const GridVector& to, GridRange cells) = nullptr;
    /// to = from + factor to
    void (*scale_and_add)(float factor, const GridVector& from, const GridVector& to,
                          GridRange cells) = nullptr;
};
/// Selected by name like vector_unit().
GridUnit grid_unit(std::string_view name) noexcept;

class GridSystem {
  public:
    /// Allocates a grid, all zero, and `others`: arrays like its finest level's.
    void resize(std::size_t columns, std::size_t rows, std::span<float*> others = {});
    /// The caller fills `free`, the diagonal, the blocks of links and the right side. For a cell that is not
    /// free the diagonal is 1 and everything else 0, including the blocks of its links. solve() changes the
    /// right side.
    GridLevel& finest() { return levels_.front(); }
    /// Couplings that solve() adds to the blocks. The preconditioner has them only on the coarsest level, so
    /// their stiffness should not exceed some hundred times the smallest on the diagonal.
    std::vector<GridCoupling>& couplings() { return couplings_; }

    struct Solved {
        int iterations = 0;
        bool converged = false;
    };
    /// Residual in the preconditioner's norm: its square, or relative to its initial value.
    struct Tolerance {
        double square = 0.0, relative = 0.0;
    };
    /// Iterates until the residual is within either tolerance. `floor`: lower bound of the eigenvalues of the
    /// diagonal's blocks. `position`: the cells' positions; null leaves rotations out of the balance.
    /// `loops`: threads that may help; changes no bit.
    Solved solve(const GridUnit& unit, float floor, const Tolerance& tolerance, int iterations,
                 const GridVector* position, tendril::detail::ForkJoin& loops);
    const GridVector& solution() const { return solution_; }

    // For solving several grids together with the bodies tied to them (tied_grids.cpp). Its preconditioner is
    // the sum of the inverse blocks of all levels (J. Bramble, J. Pasciak, J. Xu, "Parallel Multilevel
    // Preconditioners", 1990), whose block between any two cells can be computed.
    void factorize(const GridUnit& unit, float floor);
    void spread(const GridUnit& unit);                ///< computes x of each level from the residual, `right`
    dvec3 spread_at(std::size_t cell) const;          ///< the sum over the levels, after spread()
    void push(std::size_t cell, const dvec3& force);  ///< adds to the residual, after spread()
    void gather(const GridUnit& unit);                ///< sums x over the levels
    std::array<dvec3, 3> preconditioner_block(std::size_t a, std::size_t b);  ///< the preconditioner's block
    /// direction = x + by direction; then product = A direction.
    void update_direction(const GridUnit& unit, float by);
    void add_to_product(std::size_t cell, const dvec3& force);
    double residual_dot_x(const GridUnit& unit) { return dot(unit, finest().right, finest().x); }
    double direction_dot_product(const GridUnit& unit) { return dot(unit, direction_, product_); }
    /// solution += part * direction, residual -= part * product
    void advance(const GridUnit& unit, float part);
    void add_x(const GridUnit& unit);  ///< adds to the solution

  private:
    class Loops;
    static constexpr std::size_t rotations = 3;

    void precondition(const Loops& loops, std::size_t level);
    void factorize_coarsest();
    void multiply(const Loops& loops, const GridVector& x);  ///< to `product_`
    void solve_coarsest(std::size_t n);
    void project(const Loops& loops, const GridVector& vector);
    void balance(const Loops& loops, const GridVector* position);
    double dot(const Loops& loops, const GridVector& a, const GridVector& b);
    double dot(const GridUnit& unit, const GridVector& a, const GridVector& b);
    template <class Visit>
    void each_coarsest(Visit visit);
    void store_coarsest();
    /// Unknowns of the coarsest level without rotations.
    std::size_t translations() const { return coarsest_.size - rotations; }
    const double* inverse_column(std::size_t cell, std::size_t component);
    std::size_t number_of_coarsest(std::size_t cell) const;

    std::vector<float> memory_;
    std::vector<double> sums_;  ///< partial sums of a dot product
    std::vector<GridLevel> levels_;
    std::vector<GridCoupling> couplings_;
    /// Factor and solution of the coarsest level, then of the rotations.
    DenseSystem coarsest_;
    std::vector<double> coarsest_x_;
    // The inverse of the coarsest level: columns, and by cell, whether they are known.
    std::vector<double> inverse_;
    std::vector<std::uint8_t> known_;
    GridVector solution_{}, direction_{}, product_{};
};

}  // namespace tendril::rope::detail
