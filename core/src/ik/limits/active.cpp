#include "ik/limits/active.hpp"

#include <algorithm>

#include "ik/limits/jacobian.hpp"
#include "ik/limits/perturbation.hpp"
#include "ik/limits/pose.hpp"
#include "ik/limits/step.hpp"

namespace tendril::ik::detail {
namespace {

constexpr float small_turn = 1e-3f;  ///< radians: how far a joint is turned to see what stops it
constexpr float good_part = 0.01f;   ///< of the descent
constexpr float slow = 0.002f;       ///< progress by less than this part of what is left is none
constexpr int most_steps = 40, most_kicks = 4;

/// How fast the error's square falls as all joints turn, each in the way that is best for it.
struct Fall {
    float free = 0.0f;     ///< were they ball joints
    float stopped = 0.0f;  ///< what the limits take away of that
};

/// The fall with a joint's angles as far as its limit lets them change.
float fall_within(const LimitedRoom& room, std::size_t i, const JointAngles& best) noexcept {
    const JointAngles& from = room.angles[i];
    const float size = std::sqrt(best.up * best.up + best.left * best.left + best.twist * best.twist);
    if (!(size > 0.0f)) return 0.0f;
    const float by = small_turn / size;
    const JointAngles to = within(
        room.limits[i], {from.up + by * best.up, from.left + by * best.left, from.twist + by * best.twist});
    const float fall = best.up * (to.up - from.up) + best.left * (to.left - from.left) +
                       best.twist * (to.twist - from.twist);
    return std::max(fall, 0.0f) / by;
}

Fall fall_of(const Problem& problem, const Wanted& wanted) noexcept {
    const LimitedRoom& room = problem.room.limited;
    const float unit_length = 1.0f / problem.room.reach;
    Fall fall;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::vec3 arm = times(minus(problem.joints.back(), problem.joints[i]), unit_length);
        const glm::vec3 torque = plus(cross(arm, wanted.move), times(wanted.turn, wanted.scale));
        const float free = dot(torque, torque);
        fall.free += free;
        if (room.limits[i].free()) continue;
        const JointAngles best = change_of(room, i, wanted);
        // Two of a hinge's three axes are always held.
        const float asked = room.limits[i].hinge()
                                ? free
                                : best.up * best.up + best.left * best.left + best.twist * best.twist;
        fall.stopped += std::max(asked - fall_within(room, i, best), 0.0f);
    }
    return fall;
}

bool all_free(const Problem& problem) noexcept {
    const std::vector<LimitedJoint>& limits = problem.room.limited.limits;
    return std::all_of(limits.begin(), limits.begin() + static_cast<std::ptrdiff_t>(problem.bones()),
                       [](const LimitedJoint& joint) { return joint.free(); });
}

/// Downwards within the limits until there is no progress.
float settle_down(Problem& problem, float there) noexcept {
    float error = error_of(problem), damping = first_damping;
    for (int step = 0, idle = 0; step < most_steps && idle < 2 && error > there; ++step) {
        const float before = error;
        descend(problem, damping, error, Unwatched());
        // Far from a target that cannot be reached only so much may still be gained.
        idle = before - error < slow * std::min(before, 0.1f * problem.room.reach) ? idle + 1 : 0;
    }
    return error;
}

/// The same, and on from singular poses where a bend leads on. The error that is left.
float go_down(Problem& problem, float there) noexcept {
    float error = settle_down(problem, there);
    for (int turn = 0; turn < most_kicks && error > there && is_singular(problem); ++turn) {
        LimitedPose& before_kick = problem.room.limited.nearest;
        save(problem, before_kick);
        kick_within_limits(problem, turn, Unwatched());
        const float bent = settle_down(problem, there);
        if (bent < error) {
            error = bent;
        } else {
            assume(problem, before_kick, Phase::Keep, Unwatched());
        }
    }
    return error;
}

bool stopped_by_limits(Problem& problem) noexcept {
    linearize(problem);
    const Wanted wanted = wanted_of(problem);
    const float asked = dot(wanted.move, wanted.move) + dot(wanted.turn, wanted.turn);
    const Fall fall = fall_of(problem, wanted);
    // On a line with its target every chain of ball joints would have bent.
    if (fall.free <= singular * singular * asked) return !all_free(problem);
    return fall.stopped >= good_part * fall.free;
}

}  // namespace

bool limits_hold(Problem& problem, float there) noexcept {
    LimitedPose& pose = problem.room.limited.before;
    save(problem, pose);
    const bool holds = go_down(problem, there) > there && stopped_by_limits(problem);
    // Copied, not assumed: a zero must keep its sign.
    std::copy_n(pose.joints.begin(), problem.joints.size(), problem.joints.begin());
    std::copy_n(pose.rotations.begin(), problem.bones(), problem.room.rotations.begin());
    return holds;
}

}  // namespace tendril::ik::detail
