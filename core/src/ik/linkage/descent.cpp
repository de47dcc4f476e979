// Descent: moves the freedoms that closures leave towards targets, or towards drivers that stopped.
#include <algorithm>
#include <array>
#include <cmath>

#include "ik/linkage/solve.hpp"

namespace tendril::ik::detail {
namespace {

constexpr double shortest_step = 1e-10;  ///< radians or sizes; a shorter one ends the descent
constexpr double retry_damping = 1e-3;   ///< minimum damping after a rejected step

double largest_of(std::span<const double> step) noexcept {
    double largest = 0.0;
    for (const double each : step) largest = std::max(largest, std::abs(each));
    return largest;
}

}  // namespace

double LinkageSolve::target_weight(const LinkTarget& target) const noexcept {
    if (target.exact != (aim_ == Aim::ExactTargets)) return 0.0;
    return max_weight_ > 0.0 ? target.weight / max_weight_ : 0.0;
}

void LinkageSolve::add_equation(std::span<double> row, double error, double weight) noexcept {
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (work_.held[i]) row[i] = 0.0;
        work_.force[i] += weight * row[i] * error;
    }
    const double before = norm_of(row);
    work_.basis.remove_from(row);
    if (!(norm_of(row) > 1e-9 * before)) return;  // rounding
    const std::size_t count = work_.columns;
    for (std::size_t i = 0; i < count; ++i) {
        if (row[i] == 0.0) continue;
        const double by = weight * row[i];
        work_.gradient[i] += by * error;
        for (std::size_t k = 0; k <= i; ++k) work_.square[i * count + k] += by * row[k];
    }
}

void LinkageSolve::find_equations() noexcept {
    for (std::vector<double>* const each : {&work_.square, &work_.gradient, &work_.force, &work_.curvature})
        std::ranges::fill(*each, 0.0);
    if (aim_ == Aim::Closures) {
        for (std::size_t i = 0; i < work_.linkage.closures.size(); ++i) {
            const LinkageWork::Block block = work_.closure_block(i);
            for (std::size_t r = 0; r < block.count; ++r) add_equation(work_.row(r), block.errors[r], 1.0);
            work_.add_closure_curvature(i, {-block.errors[0], -block.errors[1], -block.errors[2]});
        }
    } else if (aim_ == Aim::Drivers) {
        for (const LinkDriver& each : goals_.drivers) {
            const std::span<double> row = work_.row(0);
            std::ranges::fill(row, 0.0);
            row[work_.column[each.link]] = work_.size;
            add_equation(row, work_.size * work_.driver_error(each), 1.0);
        }
    } else {
        for (const LinkTarget& each : goals_.targets) {
            const double weight = target_weight(each);
            if (weight == 0.0) continue;
            const LinkageWork::Block block = work_.target_block(each);
            for (std::size_t r = 0; r < block.count; ++r) add_equation(work_.row(r), block.errors[r], weight);
            work_.add_point_curvature(each.point, times(work_.target_gap(each), -weight));
        }
    }
    find_curvature();
}

/// Adds the constraints' second derivatives, times their multipliers; projects onto the freedoms left.
void LinkageSolve::find_curvature() noexcept {
    work_.basis.multipliers(work_.force, work_.multiplier);
    for (std::size_t k = 0; k < work_.basis.rank();) {
        // The rows of one block are consecutive.
        const std::size_t block = work_.row_origin[k] / 6;
        std::array<double, 6> by{};
        for (; k < work_.basis.rank() && work_.row_origin[k] / 6 == block; ++k)
            by[work_.row_origin[k] % 6] = work_.multiplier[k];
        const glm::dvec3 along{by[0], by[1], by[2]};
        const std::size_t closures = work_.linkage.closures.size();
        if (block < closures)
            work_.add_closure_curvature(block, along);
        else if (block - closures < goals_.targets.size())
            work_.add_point_curvature(goals_.targets[block - closures].point, along);
    }
    const std::size_t count = work_.columns;
    double* c = work_.curvature.data();
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < count; ++k)
            if (work_.held[i] || work_.held[k]) c[i * count + k] = 0.0;
    for (int side = 0; side < 2; ++side) {
        for (std::size_t i = 0; i < count; ++i) work_.basis.remove_from({c + i * count, count});
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < i; ++k) std::swap(c[i * count + k], c[k * count + i]);
    }
}

double LinkageSolve::cost() noexcept {
    double sum = 0.0;
    if (aim_ == Aim::Closures) {
        for (const Closure& each : work_.linkage.closures) sum += work_.squared_gap(each);
    } else if (aim_ == Aim::Drivers) {
        for (const LinkDriver& each : goals_.drivers) {
            const double error = work_.size * work_.driver_error(each);
            sum += error * error;
        }
    } else {
        for (const LinkTarget& each : goals_.targets) {
            const double weight = target_weight(each);
            if (weight == 0.0) continue;
            const glm::dvec3 gap = work_.target_gap(each);
            sum += weight * dot(gap, gap);
        }
    }
    return sum;
}

/// Adds (square + curvature + damping * their largest diagonal entry * I)^-1 gradient to the step, by
/// Cholesky's decomposition. False, and nothing is added, if the matrix is not positive definite.
bool LinkageSolve::solve_equations(double damping, bool curved) noexcept {
    const std::size_t count = work_.columns;
    double* a = work_.factor.data();
    double largest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k <= i; ++k)
            a[i * count + k] = work_.square[i * count + k] + (curved ? work_.curvature[i * count + k] : 0.0);
        largest = std::max({largest, work_.square[i * count + i], std::abs(a[i * count + i])});
    }
    std::ranges::fill(work_.solution, 0.0);
    if (!(largest > 0.0)) return true;
    double* x = work_.solution.data();
    for (std::size_t i = 0; i < count; ++i) {
        a[i * count + i] += damping * largest;
        for (std::size_t k = 0; k <= i; ++k) {
            double sum = a[i * count + k];
            for (std::size_t j = 0; j < k; ++j) sum -= a[i * count + j] * a[k * count + j];
            if (k < i) {
                a[i * count + k] = sum / a[k * count + k];
                continue;
            }
            if (curved && !(sum > 0.5 * damping * largest)) return false;
            a[i * count + i] = std::sqrt(std::max(sum, 1e-300));
        }
        double sum = work_.gradient[i];
        for (std::size_t j = 0; j < i; ++j) sum -= a[i * count + j] * x[j];
        x[i] = sum / a[i * count + i];
    }
    for (std::size_t i = count; i-- > 0;) {
        for (std::size_t j = i + 1; j < count; ++j) x[i] -= a[j * count + i] * x[j];
        x[i] /= a[i * count + i];
        work_.step[i] += x[i];
    }
    return true;
}

/// Metres by which a step along the gradient would move the targets' points.
double LinkageSolve::move_along_gradient() const noexcept {
    const std::size_t count = work_.columns;
    double slope = 0.0, square = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        slope += work_.gradient[i] * work_.gradient[i];
        for (std::size_t k = 0; k < i; ++k)
            square += 2.0 * work_.gradient[i] * work_.gradient[k] * work_.square[i * count + k];
        square += work_.gradient[i] * work_.gradient[i] * work_.square[i * count + i];
    }
    return square > 0.0 ? slope / std::sqrt(square) : 0.0;
}

/// Finds Newton's step, or a Gauss-Newton step where Newton's leads to no minimum.
void LinkageSolve::find_descent(double damping) noexcept {
    find_equations();
    convex_ = !gauss_newton_ && solve_equations(damping, true);
    if (!convex_) static_cast<void>(solve_equations(damping, false));
    const std::size_t count = work_.columns;
    predicted_gain_ = 0.0;
    for (std::size_t i = 0; i < count; ++i) predicted_gain_ += work_.gradient[i] * work_.solution[i];
    if (initial_move_ < 0.0 && aims_at_targets()) initial_move_ = move_along_gradient();
    if (convex_) return;
    double bend = 0.0;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < count; ++k)
            bend += work_.step[i] * work_.step[k] *
                    (work_.curvature[i * count + k] + work_.square[i < k ? k * count + i : i * count + k]);
    negative_curvature_ = bend < 0.0;
}

bool LinkageSolve::at_bound(std::size_t link, double by) const noexcept {
    const Link& each = work_.linkage.links[link];
    const double unit = work_.unit_of(link), value = work_.joints[link].value;
    return by < 0.0 ? value <= each.minimum + bound_width * unit : value >= each.maximum - bound_width * unit;
}

/// Takes one damped step and projects to the closures. If it gains nothing, undoes it and returns false.
bool LinkageSolve::descent_step(double damping) noexcept {
    work_.release();
    std::ranges::fill(work_.step, 0.0);
    for (bool again = true; again;) {
        clear_step();
        find_correction();
        find_descent(damping);
        // The active set: joints at the end of their range that the step presses against it.
        again = false;
        for (std::size_t i = 0; i < work_.joints.size(); ++i) {
            const std::size_t col = work_.column[i];
            if (!work_.ranged(i) || work_.held[col] || work_.blocked[i]) continue;
            const bool ball = work_.linkage.links[i].joint == LinkJoint::Ball;
            const double by = work_.step[col];
            if (ball ? !work_.pushes_outward(i) : (by == 0.0 || !at_bound(i, by))) continue;
            (ball ? work_.blocked[i] : work_.held[col]) = 1;
            if (!ball) work_.step[col] = 0.0;
            again = true;
        }
    }
    store_active();
    if (!(largest_of(work_.step) > shortest_step)) return false;
    // With negative curvature the gradient starts small and grows, so take a long step.
    constexpr double long_step = 0.1;
    const double turn = work_.max_turn();
    const bool lengthen = !convex_ && negative_curvature_ && damping < retry_damping;
    double part = std::min(lengthen ? std::max(1.0, long_step / turn) : 1.0, max_turn_step / turn);
    for (std::size_t i = 0; i < work_.joints.size(); ++i) {
        const Link& link = work_.linkage.links[i];
        const double by = work_.step[work_.column[i]];
        if (link.joint == LinkJoint::Ball || !work_.ranged(i) || by == 0.0) continue;
        const double to_bound =
            ((by < 0.0 ? link.minimum : link.maximum) - work_.joints[i].value) / work_.unit_of(i);
        if (part * std::abs(by) > std::abs(to_bound)) part = std::abs(to_bound / by);
    }
    const double before = cost(), predicted = part * norm_of(work_.step);
    work_.before_step = work_.joints;
    work_.take_step(part);
    work_.move_links();
    ++iterations_;
    const bool projected = !closes_ || project_to_closures(0.5 * predicted + 1e-9);
    // The last step may gain less than rounding.
    const double after = cost();
    if (projected && (after < before || (at_minimum(before) && after <= before * (1.0 + 1e-13)))) {
        was_nonconvex_ = was_nonconvex_ || (!convex_ && negative_curvature_ && aims_at_targets());
        return true;
    }
    restore(work_.before_step);
    return false;
}

/// A small step that the closures allow.
bool LinkageSolve::perturb() noexcept {
    std::uint64_t random = 1;
    work_.release();
    std::ranges::fill(work_.step, 0.0);
    find_correction();
    work_.randomize_step(random, 0.02);
    work_.basis.remove_from(work_.step);
    work_.before_step = work_.joints;
    work_.take_step(1.0);
    work_.move_links();
    if (!closes_ || project_to_closures(0.1)) return true;
    restore(work_.before_step);
    return false;
}

/// Returns whether it took a step.
bool LinkageSolve::descend_from_here() noexcept {
    const double min_cost = 1e-20 * work_.size * work_.size;
    double damping = 1e-9, before = cost();
    bool moved = false;
    gauss_newton_ = false;
    for (int slow = 0; before > min_cost && damping < 1e9 && slow < 3;) {
        if (iterations_ >= options_.max_iterations) {
            out_of_iterations_ = true;
            break;
        }
        if (!descent_step(damping)) {
            if (!(largest_of(work_.step) > shortest_step) || at_minimum(before)) break;
            // Near dependent closures Newton's step may fail where a Gauss-Newton step works.
            gauss_newton_ = convex_;
            if (!gauss_newton_) damping = std::max(damping * 16.0, retry_damping);
            continue;
        }
        moved = true;
        gauss_newton_ = false;
        if (at_minimum(before)) break;
        damping = std::max(damping * 0.25, 1e-9);
        const double after = cost();
        slow = before - after <= 1e-10 * before ? slow + 1 : 0;
        before = after;
    }
    return moved;
}

void LinkageSolve::descend(Aim aim) noexcept {
    aim_ = aim;
    max_weight_ = 0.0;
    for (const LinkTarget& each : goals_.targets)
        if (each.exact == (aim == Aim::ExactTargets)) max_weight_ = std::max(max_weight_, each.weight);
    const double start = cost();
    descended_ = descend_from_here();
    if (descended_ || convex_ || out_of_iterations_ || start <= 1e-12 * work_.size * work_.size) return;
    // Collinear with the target: no descent direction.
    work_.saved = work_.joints;
    if (perturb()) {
        descended_ = descend_from_here() && cost() < 0.999 * start;
        if (descended_) return;
        restore(work_.saved);
    }
    descent_step(1.0);
}

}  // namespace tendril::ik::detail
