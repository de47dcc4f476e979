#include "rope/grid_system.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tendril::rope::detail {
namespace {

/// Size of the coarsest level.
constexpr std::size_t coarsest = 2;
constexpr int coarsest_passes = 6;
/// The unit of work that threads share in a loop.
constexpr std::size_t part_cells = 16 * dot_cells;

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
    for (;;) {
        GridLevel level;
        level.columns = columns, level.rows = rows;
        level.stride = grid_stride(columns);
        level.steps = levels_.empty() ? fine_steps : coarse_steps;
        levels_.push_back(level);
        if (std::max(columns, rows) <= coarsest) break;
        columns = (columns + 1) / 2, rows = (rows + 1) / 2;
    }
    const auto share = [&](float* memory) {
        Arrays arrays(memory);
        for (GridLevel& level : levels_) arrays.of(level);
        for (GridVector* vector : {&solution_, &direction_, &product_}) arrays.take(levels_.front(), *vector);
        arrays.take(levels_.front(), others);
        return arrays.taken();
    };
    sums_.resize((levels_.front().cells() + dot_cells - 1) / dot_cells);
    constexpr std::size_t line = 16;
    memory_.assign(share(nullptr) + line, 0.0f);
    const std::size_t off = reinterpret_cast<std::uintptr_t>(memory_.data()) / sizeof(float) % line;
    share(memory_.data() + (line - off) % line);
}

/// Runs operations on levels, in parts if threads help.
class GridSystem::Loops {
  public:
    Loops(const GridUnit& of, tendril::detail::ForkJoin& loops) : unit(of), loops_(loops) {}

    template <class Work>
    void cells(const GridLevel& level, Work work) const {
        run(level.cells(), part_cells, level.cells() >= min_shared_cells, work);
    }
    /// Over rows of the next level; each of its cells is four of this level's.
    template <class Work>
    void rows(const GridLevel& next, Work work) const {
        run(next.rows, std::max<std::size_t>(1, part_cells / 4 / next.stride),
            4 * next.cells() >= min_shared_cells, work);
    }
    void multiply(const GridLevel& level, const GridVector& x, const GridVector& product) const {
        cells(level, [&](GridRange part) { unit.multiply(level, x, product, part); });
    }

    const GridUnit& unit;

  private:
    template <class Work>
    void run(std::size_t count, std::size_t size, bool large, Work work) const {
        constexpr std::size_t most = tendril::detail::ForkJoin::max_parts;
        if (!large || !loops_.shared() || count > most * size) return work(GridRange{0, count});
        const auto parts = static_cast<std::uint32_t>((count + size - 1) / size);
        loops_.run(parts, [&](std::uint32_t part) {
            const std::size_t first = part * size;
            work(GridRange{first, std::min(count, first + size)});
        });
    }

    tendril::detail::ForkJoin& loops_;
};

/// One cycle: computes x from the right side.
void GridSystem::precondition(const Loops& loops, std::size_t index) {
    const GridUnit& unit = loops.unit;
    const GridLevel& level = levels_[index];
    loops.cells(level, [&](GridRange part) { unit.smooth_first(level, part); });
    const auto smooth = [&] {
        loops.multiply(level, level.x, level.product);
        loops.cells(level, [&](GridRange part) { unit.smooth(level, part); });
    };
    if (index + 1 == levels_.size()) {
        for (int pass = 0; pass < coarsest_passes; ++pass) smooth();
        return;
    }
    const GridLevel& next = levels_[index + 1];
    loops.multiply(level, level.x, level.product);
    loops.rows(next, [&](GridRange part) { unit.restrict_to(level, next, part); });
    precondition(loops, index + 1);
    loops.rows(next, [&](GridRange part) { unit.prolong(level, next, part); });
    smooth();
}

GridSystem::Solved GridSystem::solve(const GridUnit& unit, float floor, const Tolerance& tolerance,
                                     int iterations, tendril::detail::ForkJoin& with) {
    const Loops loops(unit, with);
    const GridLevel& fine = finest();
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const GridLevel& level = levels_[i];
        if (i > 0) loops.rows(level, [&](GridRange part) { unit.coarsen(levels_[i - 1], level, part); });
        loops.cells(level, [&](GridRange part) { unit.factorize(level, floor, part); });
    }
    for (float* array : solution_) std::fill_n(array, fine.cells(), 0.0f);
    for (float* array : direction_) std::fill_n(array, fine.cells(), 0.0f);
    const auto dot = [&](const GridVector& a, const GridVector& b) {
        loops.cells(fine, [&](GridRange part) { unit.dot(a, b, sums_.data(), part); });
        double all = 0.0;
        for (const double sum : sums_) all += sum;
        return all;
    };
    Solved solved;
    double enough = 0.0, before = 0.0;
    for (;; ++solved.iterations) {
        precondition(loops, 0);
        const double now = dot(fine.right, fine.x);
        if (solved.iterations == 0)
            enough = std::max(tolerance.square, tolerance.relative * tolerance.relative * now);
        if (!std::isfinite(now)) return solved;
        solved.converged = now <= enough;
        if (solved.converged || solved.iterations >= iterations) return solved;
        const float kept = solved.iterations == 0 ? 0.0f : static_cast<float>(now / before);
        loops.cells(fine, [&](GridRange part) { unit.scale_and_add(kept, fine.x, direction_, part); });
        before = now;
        loops.multiply(fine, direction_, product_);
        const double curvature = dot(direction_, product_);
        if (!(curvature > 0.0)) return solved;
        const auto length = static_cast<float>(now / curvature);
        loops.cells(fine, [&](GridRange part) {
            unit.add(length, direction_, solution_, part);
            unit.add(-length, product_, fine.right, part);
        });
    }
}

}  // namespace tendril::rope::detail
