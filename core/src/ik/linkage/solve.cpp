#include "ik/linkage/solve.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::ik::detail {

LinkageSolve::LinkageSolve(LinkageWork& work, const LinkageGoals& goals,
                           const LinkageOptions& options) noexcept
    : work_(work),
      goals_(goals),
      options_(options),
      tolerance_(options.tolerance.value_or(std::max(1e-10 * work.size, work.rounding))) {
    std::ranges::fill(work_.driven, std::uint8_t{0});
    work_.release();
}

void LinkageSolve::store_active() noexcept {
    work_.active.clear();
    for (std::size_t i = 0; i < work_.joints.size(); ++i)
        if (work_.blocked[i] || (work_.held[work_.column[i]] && !work_.driven[work_.column[i]]))
            work_.active.push_back(i);
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
    double largest = -1.0;
    for (const LinkDriver& each : goals_.drivers) {
        const double error = std::abs(each.value - work_.joints[each.link].value);
        report.driver_residual = std::max(report.driver_residual, error);
        if (!stopped_ || error / work_.unit_of(each.link) <= largest) continue;
        largest = error / work_.unit_of(each.link);
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
    const bool open = !(report.closed_to <= open_threshold());
    if (open)
        for (std::size_t i = 0; i < work_.linkage.closures.size(); ++i)
            if (work_.gap_of(work_.linkage.closures[i]) > open_threshold()) work_.open.push_back(i);
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

/// Reports the target point that moved furthest, if it moved far beyond its initial pull.
void LinkageSolve::find_jump(LinkageReport& report) noexcept {
    constexpr double ratio = 4.0, min_share = 0.01;  // fraction of the size
    const double expected = std::max(ratio * initial_move_, min_share * work_.size);
    for (std::size_t i = 0; i < goals_.targets.size(); ++i) {
        const LinkTarget& target = goals_.targets[i];
        const double moved = length(minus(work_.position_of(target), work_.target_starts[i]));
        if (moved <= std::max(report.jump, expected) ||
            length(work_.target_gap(target)) <= reached * work_.size)
            continue;
        report.jumped = i;
        report.jump = moved;
    }
}

LinkageReport LinkageSolve::run() noexcept {
    LinkageReport report;
    work_.active.clear();
    work_.open.clear();
    work_.move_links();
    if (!closed()) assemble();
    const bool assembled = work_.largest_gap() <= open_threshold();
    if (!assembled) {
        finish(report);
        return report;
    }
    hold_drivers();
    drive();
    if (stopped_) {
        if (goals_.drivers.size() > 1) {
            std::ranges::fill(work_.driven, std::uint8_t{0});
            descend(Aim::Drivers);
            hold_drivers();
        }
        // The drivers may have arrived by another path.
        stopped_ = std::ranges::any_of(goals_.drivers, [&](const LinkDriver& each) {
            return !(std::abs(work_.driver_error(each)) <= reached);
        });
    }
    if (!goals_.targets.empty()) {
        // Driving stays on its branch; only targets can change the mode.
        const int mode_before = watched_mode();
        for (std::size_t i = 0; i < goals_.targets.size(); ++i)
            work_.target_starts[i] = work_.position_of(goals_.targets[i]);
        descend(Aim::ExactTargets);
        for (std::size_t i = 0; i < goals_.targets.size(); ++i)
            work_.exact_positions[i] = work_.position_of(goals_.targets[i]);
        keeps_exact_ = true;
        descend(Aim::Targets);
        keeps_exact_ = false;
        report.passed_dead_point = mode_before * watched_mode() < 0;
        if (was_nonconvex_) find_jump(report);
    }
    finish(report);
    return report;
}

}  // namespace tendril::ik::detail
