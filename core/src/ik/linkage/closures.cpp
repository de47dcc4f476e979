// The closures: the rows of their equations, Newton's steps back to them, and the assembly of a linkage.
#include <algorithm>
#include <array>
#include <functional>

#include "ik/linkage/solve.hpp"
#include "tendril/elementary.hpp"

namespace tendril::ik::detail {

bool LinkageSolve::closed() const noexcept {
    if (!(work_.largest_gap() <= tolerance_)) return false;
    if (!keeps_exact_) return true;
    for (std::size_t i = 0; i < goals_.targets.size(); ++i) {
        const LinkTarget& each = goals_.targets[i];
        if (!each.exact) continue;
        const LinkPoint& point = work_.linkage.points[each.point];
        glm::dvec3 gap = minus(work_.exact_positions[i], work_.point_of(point.link, point.at));
        if (work_.planar) gap = across(gap, work_.normal);
        if (!(length(gap) <= tolerance_)) return false;
    }
    return true;
}

double LinkageSolve::add_row(std::span<double> row, double error, double scale, std::size_t origin) noexcept {
    for (std::size_t i = 0; i < row.size(); ++i) {
        error -= row[i] * work_.step[i];
        if (work_.held[i]) row[i] = 0.0;
    }
    const double size = work_.basis.add(row, scale);
    if (size == 0.0) return 0.0;
    work_.row_origin[work_.basis.rank() - 1] = origin;
    const double by = error / size;
    for (std::size_t i = 0; i < row.size(); ++i) work_.step[i] += by * row[i];
    return size / scale;
}

void LinkageSolve::add_rows(const LinkageWork::Block& block, std::size_t equations,
                            std::size_t origin) noexcept {
    double scale = 0.0;
    for (std::size_t r = 0; r < block.count; ++r) scale = std::max(scale, norm_of(work_.row(r)));
    std::array<double, 6> margins{};
    for (std::size_t r = 0; r < block.count; ++r)
        margins[r] = add_row(work_.row(r), block.errors[r], scale, 6 * origin + r);
    std::sort(margins.begin(), margins.end(), std::greater<>());
    rank_margin_ = std::min(rank_margin_, margins[equations - 1]);
}

void LinkageSolve::find_correction() noexcept {
    work_.basis.clear();
    rank_margin_ = 1.0;
    for (std::size_t i = 0; i < work_.joints.size(); ++i) {
        if (!work_.blocked[i]) continue;
        // A ball at its maximum may not turn further outward: this row removes that direction only.
        const std::span<double> row = work_.row(0);
        std::ranges::fill(row, 0.0);
        const glm::dvec3 outward = work_.outward_of(i);
        for (std::size_t k = 0; k < 3; ++k) row[work_.column[i] + k] = outward[static_cast<int>(k)];
        if (work_.basis.add(row, 1.0) > 0.0)
            work_.row_origin[work_.basis.rank() - 1] = static_cast<std::size_t>(-1);
    }
    if (!closes_) return;
    for (std::size_t i = 0; i < work_.linkage.closures.size(); ++i) {
        add_rows(work_.closure_block(i), work_.equations_of(work_.linkage.closures[i]), i);
    }
    min_rank_margin_ = std::min(min_rank_margin_, rank_margin_);
    if (!keeps_exact_) return;
    for (std::size_t i = 0; i < goals_.targets.size(); ++i) {
        if (!goals_.targets[i].exact) continue;
        LinkTarget target = goals_.targets[i];
        target.to = work_.exact_positions[i];
        add_rows(work_.target_block(target), work_.planar ? 2 : 3, work_.linkage.closures.size() + i);
    }
}

void LinkageSolve::clear_step() noexcept {
    for (std::size_t i = 0; i < work_.columns; ++i)
        if (!work_.held[i]) work_.step[i] = 0.0;
}

bool LinkageSolve::update_active_set() noexcept {
    bool changed = false;
    for (std::size_t i = 0; i < work_.joints.size(); ++i) {
        const std::size_t col = work_.column[i];
        if (!work_.ranged(i) || work_.held[col]) continue;
        const Link& link = work_.linkage.links[i];
        if (link.joint == LinkJoint::Ball) {
            if (work_.blocked[i] || !work_.pushes_outward(i)) continue;
            work_.blocked[i] = 1;
            changed = true;
            continue;
        }
        const double unit = work_.unit_of(i), value = work_.joints[i].value,
                     to = value + unit * work_.step[col];
        if (to >= link.minimum && to <= link.maximum) continue;
        work_.held[col] = 1;
        work_.step[col] = ((to < link.minimum ? link.minimum : link.maximum) - value) / unit;
        changed = true;
    }
    return changed;
}

bool LinkageSolve::project_to_closures(double allowed) noexcept {
    constexpr int max_steps = 12;
    work_.release();
    std::ranges::fill(work_.moved, 0.0);
    for (int i = 0;; ++i) {
        if (closed()) return true;
        if (i == max_steps || work_.columns == 0) return false;
        ++iterations_;
        std::ranges::fill(work_.step, 0.0);
        do {
            clear_step();
            find_correction();
        } while (update_active_set());
        for (std::size_t k = 0; k < work_.columns; ++k) work_.moved[k] += work_.step[k];
        // Rejects NaN too.
        if (!(norm_of(work_.moved) <= allowed)) return false;
        work_.take_step(std::min(1.0, max_turn_step / work_.max_turn()));
        work_.move_links();
    }
}

void LinkageSolve::assemble() noexcept {
    constexpr int restarts = 16;
    work_.nearest = work_.joints;
    if (project_to_closures(1e9)) return;
    restore(work_.nearest);
    if (close_from_here()) return;
    // The pose has not changed since the last solve, or iterations ran out: the next solve continues.
    if (!descended_ || out_of_iterations_) return;
    work_.nearest = work_.joints;
    double least_cost = cost();
    bool cut_short = false;  // the nearest pose's descent ran out of iterations
    std::uint64_t random = 1;
    for (int i = 0; i < restarts && !out_of_iterations_; ++i) {
        work_.randomize_step(random, math::pi);
        work_.take_step(1.0);
        work_.move_links();
        if (close_from_here()) {
            out_of_iterations_ = false;
            return;
        }
        if (cost() >= 0.999 * least_cost) continue;
        least_cost = cost();
        work_.nearest = work_.joints;
        cut_short = out_of_iterations_;
    }
    out_of_iterations_ = cut_short;
    restore(work_.nearest);
}

bool LinkageSolve::close_from_here() noexcept {
    closes_ = false;
    descend(Aim::Closures);
    closes_ = true;
    if (closed()) return true;
    work_.before_step = work_.joints;
    // Newton's steps only help if a closed pose is near.
    if (cost() < 1e-4 * work_.size * work_.size && project_to_closures(0.1)) return true;
    restore(work_.before_step);
    return false;
}

void LinkageSolve::restore(const std::vector<JointPlace>& joints) noexcept {
    work_.joints = joints;
    work_.move_links();
}

std::size_t LinkageSolve::closure_rank() noexcept {
    std::ranges::fill(work_.step, 0.0);
    keeps_exact_ = false;
    find_correction();
    return work_.basis.rank();
}

std::size_t LinkageSolve::free_columns() const noexcept {
    return static_cast<std::size_t>(std::ranges::count(work_.held, std::uint8_t{0}));
}

}  // namespace tendril::ik::detail
