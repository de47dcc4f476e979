#include "rope/grid_system.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tendril::rope::detail {
namespace {

/// Of a level that is not made coarser.
constexpr std::size_t coarsest = 2;
constexpr int coarsest_passes = 6;

/// Gives arrays for levels out of one memory; first it only counts.
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
        // What a register, begun a link before the first cell or behind the last, reads.
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
    constexpr std::size_t line = 16;
    memory_.assign(share(nullptr) + line, 0.0f);
    const std::size_t off = reinterpret_cast<std::uintptr_t>(memory_.data()) / sizeof(float) % line;
    share(memory_.data() + (line - off) % line);
}

/// One cycle: x from the right side.
void GridSystem::precondition(const GridUnit& unit, std::size_t index) {
    const GridLevel& level = levels_[index];
    unit.smooth_first(level);
    if (index + 1 == levels_.size()) {
        for (int pass = 0; pass < coarsest_passes; ++pass) {
            unit.multiply(level, level.x, level.product);
            unit.smooth(level);
        }
        return;
    }
    const GridLevel& next = levels_[index + 1];
    unit.multiply(level, level.x, level.product);
    unit.restrict_to(level, next);
    precondition(unit, index + 1);
    unit.prolong(level, next);
    unit.multiply(level, level.x, level.product);
    unit.smooth(level);
}

GridSystem::Solved GridSystem::solve(const GridUnit& unit, float floor, double tolerance, int iterations) {
    const GridLevel& fine = finest();
    const std::size_t cells = fine.cells();
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        if (i > 0) unit.coarsen(levels_[i - 1], levels_[i]);
        unit.factorize(levels_[i], floor);
    }
    for (float* array : solution_) std::fill_n(array, cells, 0.0f);
    for (float* array : direction_) std::fill_n(array, cells, 0.0f);
    Solved solved;
    double first = 0.0, before = 0.0;
    for (;; ++solved.iterations) {
        precondition(unit, 0);
        const double now = unit.dot(cells, fine.right, fine.x);
        if (solved.iterations == 0) first = now;
        if (!std::isfinite(now)) return solved;
        solved.converged = now <= tolerance * tolerance * first;
        if (solved.converged || solved.iterations >= iterations) return solved;
        unit.scale_and_add(cells, solved.iterations == 0 ? 0.0f : static_cast<float>(now / before), fine.x,
                           direction_);
        before = now;
        unit.multiply(fine, direction_, product_);
        const double curvature = unit.dot(cells, direction_, product_);
        if (!(curvature > 0.0)) return solved;
        const auto length = static_cast<float>(now / curvature);
        unit.add(cells, length, direction_, solution_);
        unit.add(cells, -length, product_, fine.right);
    }
}

}  // namespace tendril::rope::detail
