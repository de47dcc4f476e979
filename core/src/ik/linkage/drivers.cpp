// The drivers: substeps along the tangent, so that a linkage stays in its assembly mode.
#include <algorithm>
#include <cmath>

#include "ik/linkage/solve.hpp"

namespace tendril::ik::detail {
namespace {

/// Minimum substep, radians or sizes; a driver that needs a shorter one stops. A joint is then off a dead
/// point by the square root of this. Unless closures are far finer, the solve could change sides.
constexpr double min_substep = 1e-7;

}  // namespace

void LinkageSolve::hold_drivers() noexcept {
    for (const LinkDriver& each : goals_.drivers) work_.driven[work_.column[each.link]] = 1;
}

double LinkageSolve::driver_distance(const LinkDriver& driver) const noexcept {
    const Link& link = work_.linkage.links[driver.link];
    const double to = std::clamp(driver.value, link.minimum, link.maximum);
    return (to - work_.driver_starts[driver.link]) / work_.unit_of(driver.link);
}

/// Steps by the joints' last move, or its reverse; false if the drivers go another way.
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

/// Finds the step along the tangent, from one part of the drivers' way to another.
void LinkageSolve::find_tangent(double from, double to) noexcept {
    work_.release();
    std::ranges::fill(work_.step, 0.0);
    for (const LinkDriver& each : goals_.drivers)
        work_.step[work_.column[each.link]] = (to - from) * driver_distance(each);
    do {
        clear_step();
        find_correction();
    } while (update_active_set());
}

/// One substep along the tangent. If branches may cross there is no tangent: repeats the last move.
bool LinkageSolve::drive_substep(double from, double to) noexcept {
    constexpr double crossing = 1e-2;
    find_tangent(from, to);
    if (rank_margin_ < crossing) {
        work_.release();
        std::ranges::fill(work_.step, 0.0);
        if (repeat_last_move(to - from) && take_drive_step(to)) return true;
        find_tangent(from, to);
    }
    return take_drive_step(to);
}

/// Takes the step and projects to the closures, with the drivers at their values for `to`.
bool LinkageSolve::take_drive_step(double to) noexcept {
    work_.before_step = work_.joints;
    ++iterations_;
    const double predicted = length_of_step_ = norm_of(work_.step);
    const bool too_long = !(work_.max_turn() <= max_turn_step);
    if (!too_long) {
        work_.take_step(1.0);
        for (const LinkDriver& each : goals_.drivers) {
            const Link& link = work_.linkage.links[each.link];
            const double start = work_.driver_starts[each.link];
            const double value =
                to < 1.0 ? start + to * driver_distance(each) * work_.unit_of(each.link) : each.value;
            work_.joints[each.link].value = std::clamp(value, link.minimum, link.maximum);
        }
        work_.move_links();
        // Rejects a correction that leads to another branch.
        if (project_to_closures(0.5 * predicted)) {
            for (std::size_t i = 0; i < work_.joints.size(); ++i)
                work_.joints[i].last = work_.joints[i].value - work_.before_step[i].value;
            return true;
        }
    }
    store_active();
    restore(work_.before_step);
    return false;
}

void LinkageSolve::drive() noexcept {
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
    const double max_part = std::min(1.0, 0.9 * max_turn_step / longest_turn);
    double at = 0.0, by = max_part;
    while (at < 1.0) {
        if (iterations_ >= options_.max_iterations) {
            out_of_iterations_ = true;
            return;
        }
        const double to = by >= 1.0 - at ? 1.0 : at + by;
        min_rank_margin_ = 1.0;
        if (drive_substep(at, to) && !jumped_branch()) {
            at = to;
            by = std::min(2.0 * by, max_part);
            work_.active.clear();
            continue;
        }
        by = 0.5 * (to - at);
        if (by * longest < min_substep) {
            stopped_ = true;
            return;
        }
    }
}

}  // namespace tendril::ik::detail
