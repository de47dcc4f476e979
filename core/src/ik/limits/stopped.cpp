#include "ik/limits/stopped.hpp"

#include <algorithm>

#include "ik/limits/freedom.hpp"
#include "ik/limits/perturbation.hpp"
#include "ik/limits/pose.hpp"
#include "ik/limits/step.hpp"

namespace tendril::ik::detail {
namespace {

constexpr float good_part = 0.01f;  ///< of the descent
constexpr float slow = 0.002f;      ///< progress by less than this part of what is left is none
constexpr int max_steps = 40, max_perturbations = 4;

bool all_free(const Problem& problem) noexcept {
    const std::vector<LimitedJoint>& limits = problem.scratch.limited.limits;
    return std::all_of(limits.begin(), limits.begin() + static_cast<std::ptrdiff_t>(problem.bones()),
                       [](const LimitedJoint& joint) { return joint.free(); });
}

/// Downwards within the limits until there is no progress.
float descend_to_stall(Problem& problem, float there) noexcept {
    float error = error_of(problem, problem.scratch.limited.pose), damping = first_damping;
    for (int step = 0, idle = 0; step < max_steps && idle < 2 && error > there; ++step) {
        const float before = error;
        descend(
            problem, damping, error, [] { return true; }, Unwatched());
        // Far from a target that cannot be reached only so much may still be gained.
        idle = before - error < slow * std::min(before, 0.1f * problem.scratch.reach) ? idle + 1 : 0;
    }
    return error;
}

/// The same, and on from singular poses where a bend leads on. The error that is left.
float descend_past_singularities(Problem& problem, float there) noexcept {
    float error = descend_to_stall(problem, there);
    for (int number = 0; number < max_perturbations && error > there && is_singular(problem); ++number) {
        problem.scratch.limited.best = problem.scratch.limited.pose;
        perturb_within_limits(problem, number, Unwatched());
        const float bent = descend_to_stall(problem, there);
        if (bent < error) {
            error = bent;
        } else {
            std::swap(problem.scratch.limited.best, problem.scratch.limited.pose);
        }
    }
    return error;
}

}  // namespace

bool is_stopped_by_limits(Problem& problem) noexcept {
    const Wanted wanted = wanted_of(problem);
    Normal normal = linearize(problem, wanted);
    while (activate(problem, wanted, normal)) {
    }
    float free = 0.0f, allowed = 0.0f;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointFreedom& freedom = problem.scratch.limited.freedoms[i];
        const glm::vec3 torque = plus(cross(freedom.arm, wanted.move), times(wanted.rotation, wanted.scale));
        const glm::vec3 rotation = rotation_by(freedom, wanted);
        free += dot(torque, torque);
        allowed += dot(rotation, rotation);
    }
    const float asked = dot(wanted.move, wanted.move) + dot(wanted.rotation, wanted.rotation);
    // On a line with its target every chain of ball joints would have bent.
    if (free <= singular * singular * asked) return !all_free(problem);
    return free - allowed >= good_part * free;
}

bool limits_stop_tip(Problem& problem, float there) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    scratch.start = scratch.pose;
    const bool holds = descend_past_singularities(problem, there) > there && is_stopped_by_limits(problem);
    std::swap(scratch.pose, scratch.start);
    return holds;
}

}  // namespace tendril::ik::detail
