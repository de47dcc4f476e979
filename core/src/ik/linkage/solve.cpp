#include "ik/linkage/solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "math/elementary.hpp"

namespace tendril::ik::detail {
namespace {

// In radians, or sizes of the linkage.
constexpr double widest_step = 0.5;  ///< of a joint in one step, radians: the tangent says little beyond
/// Where a driver counts as stopped. A joint near a dead point is off it by the root of this; the closures'
/// tolerance must be far finer, so as not to lose the side.
constexpr double finest_substep = 1e-7;
constexpr double bound_width = 1e-9;     ///< a joint so near to the end of its range is at it
constexpr double shortest_step = 1e-10;  ///< of a descent: it has ended
constexpr double reached = 1e-6;         ///< a driver's or target's tolerance

/// As a multiple of whole turns, radians.
double whole_turns(double radians) noexcept {
    return 2.0 * math::pi * std::round(radians / (2.0 * math::pi));
}
double norm_of(std::span<const double> step) noexcept {
    double sum = 0.0;
    for (const double each : step) sum += each * each;
    return std::sqrt(sum);
}
double largest_of(std::span<const double> step) noexcept {
    double largest = 0.0;
    for (const double each : step) largest = std::max(largest, std::abs(each));
    return largest;
}

}  // namespace

LinkageSolve::LinkageSolve(LinkageWork& work, const LinkageGoals& goals,
                           const LinkageOptions& options) noexcept
    : work_(work),
      goals_(goals),
      options_(options),
      tolerance_(options.tolerance.value_or(std::max(1e-10 * work.size, work.rounding))) {
    std::ranges::fill(work_.driven, std::uint8_t{0});
    work_.release();
    work_.active.clear();
    work_.open.clear();
}

void LinkageSolve::hold_drivers() noexcept {
    for (const LinkDriver& each : goals_.drivers) work_.driven[work_.column[each.link]] = 1;
}

// ------------------------------------------------------------------------------------------- the closures

bool LinkageSolve::closed() const noexcept {
    if (!(work_.largest_gap() <= tolerance_)) return false;
    if (!keeps_exact_) return true;
    for (std::size_t i = 0; i < goals_.targets.size(); ++i) {
        const LinkTarget& each = goals_.targets[i];
        if (!each.exact) continue;
        const LinkPoint& point = work_.linkage.points[each.point];
        glm::dvec3 gap = minus(work_.exact_places[i], work_.point_of(point.link, point.at));
        if (work_.planar) gap = across(gap, work_.normal);
        if (!(length(gap) <= tolerance_)) return false;
    }
    return true;
}

double LinkageSolve::take_row(std::span<double> row, double error, double scale) noexcept {
    for (std::size_t i = 0; i < row.size(); ++i) {
        error -= row[i] * work_.step[i];
        if (work_.held[i]) row[i] = 0.0;
    }
    const double size = work_.basis.add(row, scale);
    if (size == 0.0) return 0.0;
    const double by = error / size;
    for (std::size_t i = 0; i < row.size(); ++i) work_.step[i] += by * row[i];
    return size / scale;
}

void LinkageSolve::take_rows(const LinkageWork::Block& block, std::size_t equations) noexcept {
    double scale = 0.0;
    for (std::size_t r = 0; r < block.count; ++r) scale = std::max(scale, norm_of(work_.row(r)));
    std::array<double, 6> left{};
    for (std::size_t r = 0; r < block.count; ++r) left[r] = take_row(work_.row(r), block.errors[r], scale);
    std::sort(left.begin(), left.end(), std::greater<>());
    least_left_ = std::min(least_left_, left[equations - 1]);
}

void LinkageSolve::find_return() noexcept {
    work_.basis.clear();
    least_left_ = 1.0;
    for (std::size_t i = 0; i < work_.joints.size(); ++i) {
        if (!work_.blocked[i]) continue;
        // A ball at its maximum turns no further outward: its columns stay free, but for this direction.
        const std::span<double> row = work_.row(0);
        std::ranges::fill(row, 0.0);
        const glm::dvec3 outward = work_.outward_of(i);
        for (std::size_t k = 0; k < 3; ++k) row[work_.column[i] + k] = outward[static_cast<int>(k)];
        work_.basis.add(row, 1.0);
    }
    if (!closes_) return;
    for (std::size_t i = 0; i < work_.linkage.closures.size(); ++i) {
        take_rows(work_.closure_block(i), work_.equations_of(work_.linkage.closures[i]));
    }
    if (!keeps_exact_) return;
    for (std::size_t i = 0; i < goals_.targets.size(); ++i) {
        if (!goals_.targets[i].exact) continue;
        LinkTarget kept = goals_.targets[i];
        kept.to = work_.exact_places[i];
        take_rows(work_.target_block(kept), work_.planar ? 2 : 3);
    }
}

void LinkageSolve::clear_step() noexcept {
    for (std::size_t i = 0; i < work_.columns; ++i)
        if (!work_.held[i]) work_.step[i] = 0.0;
}

bool LinkageSolve::at_bound(std::size_t link, double by) const noexcept {
    const Link& each = work_.linkage.links[link];
    const double unit = work_.unit_of(link), value = work_.joints[link].value;
    return by < 0.0 ? value <= each.minimum + bound_width * unit : value >= each.maximum - bound_width * unit;
}

bool LinkageSolve::hold_overstepped() noexcept {
    bool changed = false;
    for (std::size_t i = 0; i < work_.joints.size(); ++i) {
        const std::size_t col = work_.column[i];
        if (!work_.ranged(i) || work_.held[col]) continue;
        const Link& link = work_.linkage.links[i];
        if (link.joint == LinkJoint::Ball) {
            if (work_.blocked[i] || !work_.presses_outward(i)) continue;
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

bool LinkageSolve::return_to_closures(double allowed) noexcept {
    constexpr int enough = 12;
    work_.release();
    std::ranges::fill(work_.moved, 0.0);
    for (int i = 0;; ++i) {
        if (closed()) return true;
        if (i == enough || work_.columns == 0) return false;
        ++iterations_;
        std::ranges::fill(work_.step, 0.0);
        do {
            clear_step();
            find_return();
        } while (hold_overstepped());
        for (std::size_t k = 0; k < work_.columns; ++k) work_.moved[k] += work_.step[k];
        // NaN is not within either.
        if (!(norm_of(work_.moved) <= allowed)) return false;
        work_.take_step(std::min(1.0, widest_step / work_.widest()));
        work_.move_links();
    }
}

void LinkageSolve::assemble() noexcept {
    constexpr int restarts = 16;
    work_.nearest = work_.joints;
    if (return_to_closures(1e9)) return;
    put_back(work_.nearest);
    if (close_from_here()) return;
    // Where the last solve left it: nothing new to find. Cut short: the next one goes on.
    if (!descended_ || out_of_iterations_) return;
    work_.nearest = work_.joints;
    double least = cost();
    bool cut_short = false;  // the descent to the nearest pose
    std::uint64_t random = 1;
    for (int i = 0; i < restarts && !out_of_iterations_; ++i) {
        work_.scatter(random, math::pi);
        work_.take_step(1.0);
        work_.move_links();
        if (close_from_here()) {
            out_of_iterations_ = false;
            return;
        }
        if (cost() >= 0.999 * least) continue;
        least = cost();
        work_.nearest = work_.joints;
        cut_short = out_of_iterations_;
    }
    out_of_iterations_ = cut_short;
    put_back(work_.nearest);
}

bool LinkageSolve::close_from_here() noexcept {
    closes_ = false;
    descend(Aim::Closures);
    closes_ = true;
    if (closed()) return true;
    work_.kept = work_.joints;
    // Where no pose closes it, Newton's steps lead nowhere.
    if (cost() < 1e-4 * work_.size * work_.size && return_to_closures(0.1)) return true;
    put_back(work_.kept);
    return false;
}

void LinkageSolve::put_back(const std::vector<JointPlace>& joints) noexcept {
    work_.joints = joints;
    work_.move_links();
}

// -------------------------------------------------------------------------------------------- the drivers

double LinkageSolve::driver_distance(const LinkDriver& driver) const noexcept {
    const Link& link = work_.linkage.links[driver.link];
    const double to = std::clamp(driver.value, link.minimum, link.maximum);
    return (to - work_.driver_starts[driver.link]) / work_.unit_of(driver.link);
}

/// As the joints last moved; false if the drivers want another direction than that, or its reverse.
bool LinkageSolve::repeat_last_move(double part) noexcept {
    double along = 0.0, square = 0.0, wanted = 0.0;
    for (const LinkDriver& each : goals_.drivers) {
        const double last = work_.joints[each.link].last / work_.unit_of(each.link),
                     by = part * driver_distance(each);
        along += by * last;
        square += last * last;
        wanted += by * by;
    }
    if (!(square > 0.0 && along * along >= 0.9 * square * wanted)) return false;
    for (std::size_t i = 0; i < work_.joints.size(); ++i)
        if (work_.linkage.links[i].joint != LinkJoint::Ball)
            work_.step[work_.column[i]] = along / square * work_.joints[i].last / work_.unit_of(i);
    return true;
}

/// The step of a substep, between two parts of the way, along the tangent.
void LinkageSolve::find_tangent(double from, double to) noexcept {
    work_.release();
    std::ranges::fill(work_.step, 0.0);
    for (const LinkDriver& each : goals_.drivers)
        work_.step[work_.column[each.link]] = (to - from) * driver_distance(each);
    do {
        clear_step();
        find_return();
    } while (hold_overstepped());
}

/// One substep. Along the tangent; where branches may cross there is none, and it goes on as before.
bool LinkageSolve::glide_by(double from, double to) noexcept {
    constexpr double crossing = 1e-2;
    find_tangent(from, to);
    if (least_left_ < crossing) {
        work_.release();
        std::ranges::fill(work_.step, 0.0);
        if (repeat_last_move(to - from) && take_glide_step(to)) return true;
        find_tangent(from, to);
    }
    return take_glide_step(to);
}

/// Takes the step, and returns to the closures with the drivers where they are at `to`.
bool LinkageSolve::take_glide_step(double to) noexcept {
    work_.kept = work_.joints;
    ++iterations_;
    const double predicted = norm_of(work_.step);
    const bool wide = !(work_.widest() <= widest_step);
    if (!wide) {
        work_.take_step(1.0);
        for (const LinkDriver& each : goals_.drivers) {
            const Link& link = work_.linkage.links[each.link];
            const double start = work_.driver_starts[each.link];
            const double value =
                to < 1.0 ? start + to * driver_distance(each) * work_.unit_of(each.link) : each.value;
            work_.joints[each.link].value = std::clamp(value, link.minimum, link.maximum);
        }
        work_.move_links();
        // It ends where the tangent led, and not on another branch.
        if (return_to_closures(0.5 * predicted)) {
            for (std::size_t i = 0; i < work_.joints.size(); ++i)
                work_.joints[i].last = work_.joints[i].value - work_.kept[i].value;
            return true;
        }
    }
    note_active();
    put_back(work_.kept);
    return false;
}

void LinkageSolve::glide() noexcept {
    double longest = 0.0;
    for (const LinkDriver& each : goals_.drivers) {
        work_.driver_starts[each.link] = work_.joints[each.link].value;
        const Link& link = work_.linkage.links[each.link];
        if (!(each.value >= link.minimum && each.value <= link.maximum)) beyond_range_ = true;
    }
    double longest_turn = 0.0;
    for (const LinkDriver& each : goals_.drivers) {
        const double distance = std::abs(driver_distance(each));
        longest = std::max(longest, distance);
        if (!work_.straight[work_.column[each.link]]) longest_turn = std::max(longest_turn, distance);
    }
    if (longest == 0.0) return;
    const double furthest = std::min(1.0, 0.9 * widest_step / longest_turn);
    double at = 0.0, by = furthest;
    while (at < 1.0) {
        if (iterations_ >= options_.max_iterations) {
            out_of_iterations_ = true;
            return;
        }
        const double to = by >= 1.0 - at ? 1.0 : at + by;
        if (glide_by(at, to)) {
            at = to;
            by = std::min(2.0 * by, furthest);
            work_.active.clear();
            continue;
        }
        by = 0.5 * (to - at);
        if (by * longest < finest_substep) {
            stopped_ = true;
            return;
        }
    }
}

// -------------------------------------------------------------------------------------------- the targets

double LinkageSolve::target_weight(const LinkTarget& target) const noexcept {
    if (target.exact != (aim_ == Aim::ExactTargets)) return 0.0;
    return heaviest_ > 0.0 ? target.weight / heaviest_ : 0.0;
}

void LinkageSolve::add_equation(std::span<double> row, double error, double weight) noexcept {
    for (std::size_t i = 0; i < row.size(); ++i)
        if (work_.held[i]) row[i] = 0.0;
    work_.basis.remove_from(row);
    const std::size_t count = work_.columns;
    for (std::size_t i = 0; i < count; ++i) {
        if (row[i] == 0.0) continue;
        const double by = weight * row[i];
        work_.gradient[i] += by * error;
        for (std::size_t k = 0; k <= i; ++k) work_.square[i * count + k] += by * row[k];
    }
}

void LinkageSolve::find_equations() noexcept {
    std::ranges::fill(work_.square, 0.0);
    std::ranges::fill(work_.gradient, 0.0);
    if (aim_ == Aim::Closures) {
        for (std::size_t i = 0; i < work_.linkage.closures.size(); ++i) {
            const LinkageWork::Block block = work_.closure_block(i);
            for (std::size_t r = 0; r < block.count; ++r) add_equation(work_.row(r), block.errors[r], 1.0);
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
        }
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

/// Adds (square + damping * its largest diagonal entry * I)^-1 gradient to the step, by Cholesky
/// decomposition.
void LinkageSolve::solve_equations(double damping) noexcept {
    const std::size_t count = work_.columns;
    double largest = 0.0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, work_.square[i * count + i]);
    if (!(largest > 0.0)) return;
    double* a = work_.square.data();
    double* x = work_.gradient.data();
    for (std::size_t i = 0; i < count; ++i) {
        a[i * count + i] += damping * largest;
        for (std::size_t k = 0; k <= i; ++k) {
            double sum = a[i * count + k];
            for (std::size_t j = 0; j < k; ++j) sum -= a[i * count + j] * a[k * count + j];
            a[i * count + k] = k < i ? sum / a[k * count + k] : std::sqrt(std::max(sum, 1e-300));
        }
        double sum = x[i];
        for (std::size_t j = 0; j < i; ++j) sum -= a[i * count + j] * x[j];
        x[i] = sum / a[i * count + i];
    }
    for (std::size_t i = count; i-- > 0;) {
        for (std::size_t j = i + 1; j < count; ++j) x[i] -= a[j * count + i] * x[j];
        x[i] /= a[i * count + i];
        work_.step[i] += x[i];
    }
}

/// Takes one damped step and returns to the closures. False if that gains nothing; the pose is then as it
/// was.
bool LinkageSolve::descent_step(double damping) noexcept {
    work_.release();
    std::ranges::fill(work_.step, 0.0);
    for (bool again = true; again;) {
        clear_step();
        find_return();
        find_equations();
        solve_equations(damping);
        // The active set: joints at the end of their range that the step presses against it.
        again = false;
        for (std::size_t i = 0; i < work_.joints.size(); ++i) {
            const std::size_t col = work_.column[i];
            if (!work_.ranged(i) || work_.held[col] || work_.blocked[i]) continue;
            const bool ball = work_.linkage.links[i].joint == LinkJoint::Ball;
            const double by = work_.step[col];
            if (ball ? !work_.presses_outward(i) : (by == 0.0 || !at_bound(i, by))) continue;
            (ball ? work_.blocked[i] : work_.held[col]) = 1;
            if (!ball) work_.step[col] = 0.0;
            again = true;
        }
    }
    note_active();
    if (!(largest_of(work_.step) > shortest_step)) return false;
    double part = std::min(1.0, widest_step / work_.widest());
    for (std::size_t i = 0; i < work_.joints.size(); ++i) {
        const Link& link = work_.linkage.links[i];
        const double by = work_.step[work_.column[i]];
        if (link.joint == LinkJoint::Ball || !work_.ranged(i) || by == 0.0) continue;
        const double left =
            ((by < 0.0 ? link.minimum : link.maximum) - work_.joints[i].value) / work_.unit_of(i);
        if (part * std::abs(by) > std::abs(left)) part = std::abs(left / by);
    }
    const double before = cost(), predicted = part * norm_of(work_.step);
    work_.kept = work_.joints;
    work_.take_step(part);
    work_.move_links();
    ++iterations_;
    const bool kept = !closes_ || return_to_closures(0.5 * predicted + 1e-9);
    if (kept && cost() < before) return true;
    put_back(work_.kept);
    return false;
}

/// A small step that the closures allow.
bool LinkageSolve::perturb() noexcept {
    std::uint64_t random = 1;
    work_.release();
    std::ranges::fill(work_.step, 0.0);
    find_return();
    work_.scatter(random, 0.02);
    work_.basis.remove_from(work_.step);
    work_.kept = work_.joints;
    work_.take_step(1.0);
    work_.move_links();
    if (!closes_ || return_to_closures(0.1)) return true;
    put_back(work_.kept);
    return false;
}

/// Whether it took a step.
bool LinkageSolve::descend_from_here() noexcept {
    const double enough = 1e-20 * work_.size * work_.size;
    double damping = 1e-9, before = cost();
    bool moved = false;
    for (int slow = 0; before > enough && damping < 1e9 && slow < 3;) {
        if (iterations_ >= options_.max_iterations) {
            out_of_iterations_ = true;
            break;
        }
        if (!descent_step(damping)) {
            if (!(largest_of(work_.step) > shortest_step)) break;
            damping = std::max(damping * 16.0, 1e-6);
            continue;
        }
        moved = true;
        damping = std::max(damping * 0.25, 1e-9);
        const double after = cost();
        slow = before - after <= 1e-10 * before ? slow + 1 : 0;
        before = after;
    }
    return moved;
}

void LinkageSolve::descend(Aim aim) noexcept {
    aim_ = aim;
    heaviest_ = 0.0;
    for (const LinkTarget& each : goals_.targets)
        if (each.exact == (aim == Aim::ExactTargets)) heaviest_ = std::max(heaviest_, each.weight);
    const double start = cost();
    descended_ = descend_from_here();
    if (descended_ || out_of_iterations_ || start <= 1e-12 * work_.size * work_.size) return;
    // It is at a minimum, or stretched out on one line with the target, where descent has no direction.
    work_.best = work_.joints;
    if (perturb()) {
        descended_ = descend_from_here() && cost() < 0.999 * start;
        if (descended_) return;
        put_back(work_.best);
    }
    descent_step(1.0);
}

// --------------------------------------------------------------------------------------------- the report

void LinkageSolve::note_active() noexcept {
    work_.active.clear();
    for (std::size_t i = 0; i < work_.joints.size(); ++i)
        if (work_.blocked[i] || (work_.held[work_.column[i]] && !work_.driven[work_.column[i]]))
            work_.active.push_back(i);
}

std::size_t LinkageSolve::closure_rank() noexcept {
    std::ranges::fill(work_.step, 0.0);
    keeps_exact_ = false;
    find_return();
    return work_.basis.rank();
}

std::size_t LinkageSolve::free_columns() const noexcept {
    return static_cast<std::size_t>(std::ranges::count(work_.held, std::uint8_t{0}));
}

/// mode(), with what is watched held if nothing is driven. Where the last solve ended it is known.
int LinkageSolve::watched_mode() noexcept {
    if (goals_.drivers.empty())
        for (const std::size_t each : options_.watched) work_.driven[work_.column[each]] = 1;
    if (work_.mode_held != work_.driven || work_.mode_at != work_.joints) {
        work_.mode = mode();
        work_.mode_held = work_.driven;
        work_.mode_at = work_.joints;
    }
    std::ranges::fill(work_.driven, std::uint8_t{0});
    hold_drivers();
    return work_.mode;
}

int LinkageSolve::mode() noexcept {
    work_.release();
    const std::size_t rank = closure_rank();
    const std::size_t free = free_columns();
    if (rank != free || rank == 0) return 0;
    // The basis' rows are the closures' by a triangular matrix of positive diagonal: the same sign.
    return work_.basis.orientation(work_.held, work_.square);
}

void LinkageSolve::finish(LinkageReport& report) noexcept {
    report.iterations = iterations_;
    report.closed_to = work_.largest_gap();
    bool missed = false;
    work_.residuals.clear();
    for (const LinkTarget& each : goals_.targets) {
        const double gap = length(work_.target_gap(each));
        work_.residuals.push_back(gap);
        report.residual = std::max(report.residual, gap);
        missed = missed || gap > reached * work_.size;
    }
    double furthest = -1.0;
    for (const LinkDriver& each : goals_.drivers) {
        const double left = std::abs(each.value - work_.joints[each.link].value);
        report.driver_residual = std::max(report.driver_residual, left);
        if (!stopped_ || left / work_.unit_of(each.link) <= furthest) continue;
        furthest = left / work_.unit_of(each.link);
        report.stopped = each.link;
        report.stopped_at = work_.joints[each.link].value;
    }
    if (beyond_range_)
        for (const LinkDriver& each : goals_.drivers) {
            const Link& link = work_.linkage.links[each.link];
            if (each.value < link.minimum || each.value > link.maximum) {
                work_.active.push_back(each.link);
                if (report.stopped) continue;
                report.stopped = each.link;
                report.stopped_at = work_.joints[each.link].value;
            }
        }
    const bool open = !(report.closed_to <= open_from());
    if (open)
        for (std::size_t i = 0; i < work_.linkage.closures.size(); ++i)
            if (work_.gap_of(work_.linkage.closures[i]) > open_from()) work_.open.push_back(i);
    using enum LinkageStatus;
    if (!open && !missed && !stopped_ && !beyond_range_) work_.active.clear();
    report.status = out_of_iterations_          ? IterationLimit
                    : open                      ? Open
                    : stopped_ || beyond_range_ ? (work_.active.empty() ? DeadPoint : Limited)
                    : missed                    ? (work_.active.empty() ? TargetMissed : Limited)
                                                : Reached;
    work_.release();
    for (const std::size_t each : work_.active)
        (work_.linkage.links[each].joint == LinkJoint::Ball ? work_.blocked[each]
                                                            : work_.held[work_.column[each]]) = 1;
    report.freedom = static_cast<int>(free_columns() - closure_rank());
}

LinkageReport LinkageSolve::run() noexcept {
    LinkageReport report;
    work_.move_links();
    if (!closed()) assemble();
    const bool assembled = work_.largest_gap() <= open_from();
    if (!assembled) {
        finish(report);
        return report;
    }
    hold_drivers();
    glide();
    if (stopped_) {
        if (goals_.drivers.size() > 1) {
            std::ranges::fill(work_.driven, std::uint8_t{0});
            descend(Aim::Drivers);
            hold_drivers();
        }
        // The straight way was barred, and it went another.
        stopped_ = std::ranges::any_of(goals_.drivers, [&](const LinkDriver& each) {
            return !(std::abs(work_.driver_error(each)) <= reached);
        });
    }
    if (!goals_.targets.empty()) {
        // A glide goes on along its branch; it is targets that draw it into another mode.
        const int mode_before = watched_mode();
        descend(Aim::ExactTargets);
        for (std::size_t i = 0; i < goals_.targets.size(); ++i) {
            const LinkPoint& point = work_.linkage.points[goals_.targets[i].point];
            work_.exact_places[i] = work_.point_of(point.link, point.at);
        }
        keeps_exact_ = true;
        descend(Aim::Targets);
        keeps_exact_ = false;
        report.passed_dead_point = mode_before * watched_mode() < 0;
    }
    finish(report);
    return report;
}

// ------------------------------------------------------------------------------------ the other modes

namespace {

/// How far a pose is from another, whole turns aside.
double distance_of_modes(const LinkageWork& work, const std::vector<JointPlace>& other) noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < other.size(); ++i) {
        const JointPlace &a = work.joints[i], &b = other[i];
        double by = (a.value - b.value) / work.unit_of(i);
        if (work.linkage.links[i].joint == LinkJoint::Hinge) by -= whole_turns(by);
        if (work.linkage.links[i].joint == LinkJoint::Ball)
            by = 1.0 - std::abs(a.turn.w * b.turn.w + a.turn.x * b.turn.x + a.turn.y * b.turn.y +
                                a.turn.z * b.turn.z);
        sum += by * by;
    }
    return sum;
}

}  // namespace

bool find_other_mode(LinkageWork& work, LinkageState& state, std::span<const LinkDriver> drivers) noexcept {
    constexpr int starts = 48;
    constexpr double same = 1e-6;
    const LinkageGoals goals{drivers, {}};
    const LinkageOptions options{.max_iterations = 100000};
    const auto take = [&] {
        work.joints = state.joints;
        work.enter_ranges();
        work.move_links();
    };
    take();
    LinkageSolve from(work, goals, options);
    from.hold_drivers();
    const int mode = from.mode();
    if (mode == 0) return false;
    const std::vector<JointPlace> here = work.joints;
    double nearest = 1e300;
    std::uint64_t random = 1;
    for (int start = 0; start < starts; ++start) {
        work.joints = here;
        work.move_links();
        work.scatter(random, math::pi);
        work.take_step(1.0);
        work.move_links();
        LinkageSolve solve(work, goals, options);
        solve.hold_drivers();
        if (!solve.close_from_here()) continue;
        const double far = distance_of_modes(work, here);
        if (far < same || far >= nearest || solve.mode() == 0) continue;
        nearest = far;
        for (std::size_t i = 0; i < here.size(); ++i) {
            if (work.linkage.links[i].joint == LinkJoint::Hinge)
                work.joints[i].value -= whole_turns(work.joints[i].value - here[i].value);
            state.joints[i] = work.joints[i];
        }
    }
    const bool found = nearest < 1e300;
    take();
    return found;
}

}  // namespace tendril::ik::detail
