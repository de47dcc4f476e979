#include "ik/limits/stopped.hpp"

#include <algorithm>
#include <limits>

#include "ik/limits/descent.hpp"
#include "ik/limits/least_squares.hpp"
#include "ik/limits/pose.hpp"
#include "ik/limits/starts.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::limits;

bool all_free(const Problem& problem) noexcept {
    const std::vector<LimitedJoint>& limits = problem.scratch.limited.limits;
    return std::all_of(limits.begin(), limits.begin() + static_cast<std::ptrdiff_t>(problem.bones()),
                       [](const LimitedJoint& joint) { return joint.free(); });
}

/// Descends within the limits until it stalls and returns the error.
float descend_to_stall(Problem& problem, float converged) noexcept {
    LimitedDescent descent(problem, std::numeric_limits<float>::infinity());
    descent.continue_from(tune::limits::first_damping, false);
    for (int step = 0; step < limit_test_steps && !descent.stalled() && descent.error() > converged; ++step) {
        descent.iterate(problem, Unwatched());
    }
    return descent.error();
}

/// Like descend_to_stall, but bends the chain out of a singular pose. Of 730 straight arms whose target ahead
/// is reachable, 338 more that FABRIK (2011) leaves on the line would blame a limit without this; for the
/// other methods it changes nothing.
float descend_past_singularity(Problem& problem, float converged) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    const float error = descend_to_stall(problem, converged);
    if (error <= converged || !is_singular(problem)) return error;
    scratch.best = scratch.pose;
    bend_within_limits(problem, Unwatched());
    const float bent = descend_to_stall(problem, converged);
    if (bent < error) return bent;
    scratch.swap_pose(scratch.best);
    return error;
}

}  // namespace

bool is_stopped_by_limits(Problem& problem, PoseUsed pose_used) noexcept {
    const TipDelta wanted = requested_delta(problem);
    Normal normal =
        pose_used == PoseUsed::Current ? linearize(problem, wanted) : release_limits(problem.scratch.limited);
    while (activate(problem, wanted, normal)) {
    }
    float free = 0.0f, allowed = 0.0f;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointFreedom& freedom = problem.scratch.limited.freedoms[i];
        const glm::vec3 torque = free_rotation_by(freedom, wanted);
        const glm::vec3 rotation = allowed_part(freedom, torque);
        free += dot(torque, torque);
        allowed += dot(rotation, rotation);
    }
    const float requested = dot(wanted.move, wanted.move) + dot(wanted.rotation, wanted.rotation);
    // A chain of ball joints on one line with its target would already have been bent.
    if (free <= singular * singular * requested) return !all_free(problem);
    return free - allowed >= min_limit_share * free;
}

bool limits_stop_tip(Problem& problem, float converged) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    const int steps = problem.least_squares_steps;
    scratch.start = scratch.pose;
    const bool holds =
        descend_past_singularity(problem, converged) > converged && is_stopped_by_limits(problem);
    scratch.swap_pose(scratch.start);
    problem.least_squares_steps = steps;  // not counted as the method's
    return holds;
}

}  // namespace tendril::ik::detail
