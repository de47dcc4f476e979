#include "ik/limits/active.hpp"

#include <algorithm>

#include "ik/limits/freedom.hpp"
#include "ik/limits/perturbation.hpp"
#include "ik/limits/pose.hpp"
#include "ik/limits/step.hpp"

namespace tendril::ik::detail {
namespace {

constexpr float good_part = 0.01f;  ///< of the descent
constexpr float slow = 0.002f;      ///< progress by less than this part of what is left is none
constexpr int most_steps = 40, most_kicks = 4;

bool all_free(const Problem& problem) noexcept {
    const std::vector<LimitedJoint>& limits = problem.room.limited.limits;
    return std::all_of(limits.begin(), limits.begin() + static_cast<std::ptrdiff_t>(problem.bones()),
                       [](const LimitedJoint& joint) { return joint.free(); });
}

/// Downwards within the limits until there is no progress.
float settle_down(Problem& problem, float there) noexcept {
    float error = error_of(problem, problem.room.limited.pose), damping = first_damping;
    for (int step = 0, idle = 0; step < most_steps && idle < 2 && error > there; ++step) {
        const float before = error;
        descend(
            problem, damping, error, [] { return true; }, Unwatched());
        // Far from a target that cannot be reached only so much may still be gained.
        idle = before - error < slow * std::min(before, 0.1f * problem.room.reach) ? idle + 1 : 0;
    }
    return error;
}

/// The same, and on from singular poses where a bend leads on. The error that is left.
float go_down(Problem& problem, float there) noexcept {
    float error = settle_down(problem, there);
    for (int turn = 0; turn < most_kicks && error > there && is_singular(problem); ++turn) {
        problem.room.limited.best = problem.room.limited.pose;
        kick_within_limits(problem, turn, Unwatched());
        const float bent = settle_down(problem, there);
        if (bent < error) {
            error = bent;
        } else {
            std::swap(problem.room.limited.best, problem.room.limited.pose);
        }
    }
    return error;
}

}  // namespace

bool stopped_by_limits(Problem& problem) noexcept {
    const Wanted wanted = wanted_of(problem);
    Normal normal = linearize(problem, wanted);
    while (activate(problem, wanted, normal)) {
    }
    float free = 0.0f, allowed = 0.0f;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointFreedom& freedom = problem.room.limited.freedoms[i];
        const glm::vec3 torque = plus(cross(freedom.arm, wanted.move), times(wanted.turn, wanted.scale));
        const glm::vec3 turn = turn_by(freedom, wanted);
        free += dot(torque, torque);
        allowed += dot(turn, turn);
    }
    const float asked = dot(wanted.move, wanted.move) + dot(wanted.turn, wanted.turn);
    // On a line with its target every chain of ball joints would have bent.
    if (free <= singular * singular * asked) return !all_free(problem);
    return free - allowed >= good_part * free;
}

bool limits_hold(Problem& problem, float there) noexcept {
    LimitedRoom& room = problem.room.limited;
    room.start = room.pose;
    const bool holds = go_down(problem, there) > there && stopped_by_limits(problem);
    std::swap(room.pose, room.start);
    return holds;
}

}  // namespace tendril::ik::detail
