#include "ik/limits/pole.hpp"

#include "ik/limits/pose.hpp"
#include "ik/pole/pole.hpp"
#include "tendril/elementary.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

/// Angle by which a pose was turned about a line through the root, measured at the joint furthest off the
/// line.
float angle_between(const Problem& problem, const LimitedPose& before, const glm::vec3& line) noexcept {
    float furthest = 0.0f, angle = 0.0f;
    for (std::size_t i = 1; i < problem.bones(); ++i) {
        const glm::vec3 from = minus(before.joints[i], problem.root()),
                        to = minus(problem.joints[i], problem.root());
        const glm::vec3 off = minus(from, times(line, dot(from, line)));
        if (dot(off, off) <= furthest) continue;
        furthest = dot(off, off);
        angle = math::arctangent(dot(line, cross(off, to)), dot(off, to));
    }
    return angle;
}

/// Turns scratch.pose about the line, into the rotations of scratch.trial. Returns whether the root's joint
/// allows it.
bool try_swivel(Problem& problem, const glm::vec3& line, float angle) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    const glm::quat by = rotation_about(line, angle);
    scratch.trial.local = scratch.pose.local;
    scratch.trial.local[0] = unit(compose(by, scratch.pose.local[0]));
    return excess_of(scratch.limits[0], angles_of(scratch.limits[0], scratch.trial.local[0])) <= at_bound;
}

void swivel_within_limits(Problem& problem, const glm::vec3& line, float angle) noexcept {
    if (try_swivel(problem, line, angle)) return;
    float minimum = 0.0f, maximum = 1.0f;
    for (int i = 0; i < 10; ++i) {
        const float part = 0.5f * (minimum + maximum);
        (try_swivel(problem, line, part * angle) ? minimum : maximum) = part;
    }
    try_swivel(problem, line, minimum * angle);
}

/// Writes the pose mirrored at a line in the plane to scratch.trial. Returns whether the limits allow it.
bool try_mirror(const Problem& problem, const glm::vec3& line) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    const glm::quat half = minimal_rotation(glm::vec3(1.0f, 0.0f, 0.0f), line), twice = compose(half, half);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        glm::quat& local = scratch.trial.local[i];
        local = conjugate(scratch.pose.local[i]);
        if (is_from_base(scratch, i)) local = unit(compose(twice, local));
        if (excess_of(scratch.limits[i], angles_of(scratch.limits[i], local)) > at_bound) return false;
    }
    forward_kinematics(problem, scratch.trial);
    return true;
}

/// Accepts the turn unless it costs more than rounding, by which forward kinematics moves the tip.
template <class Watch>
bool accept_turned(Problem& problem, Watch watch) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    const float allowed = std::max(error_of(problem, scratch.pose), problem.tolerance);
    if (error_of(problem, scratch.trial) > allowed + 1e-6f * problem.scratch.reach) return false;
    accept_trial(problem, Phase::Pole, watch);
    commit(problem);
    return true;
}

template <class Watch>
void mirror_within_limits(Problem& problem, Watch watch) noexcept {
    const Side side = planar_side(problem);
    if (side == Side::Free || side == problem.options.plane->bend) return;
    const glm::vec3 line = math::direction(problem.root(), problem.joints.back(), {1.0f, 0.0f, 0.0f});
    if (try_mirror(problem, line)) accept_turned(problem, watch);
}

}  // namespace

template <class Watch>
void face_pole_within_limits(Problem& problem, Watch watch) noexcept {
    if (problem.options.plane) return mirror_within_limits(problem, watch);
    if (!problem.options.pole) return remember_pose(problem);
    LimitedScratch& scratch = problem.scratch.limited;
    Options options = problem.options;
    options.pole_turn = PoleTurn::WholeChain;
    Problem whole{problem.joints, problem.target, problem.tolerance, options, problem.scratch, problem.state};
    face_pole(whole, Unwatched());
    const glm::vec3 span = minus(scratch.pose.joints[problem.bones()], problem.root());
    const float size = length(span);
    const glm::vec3 line = size > 0.0f ? times(span, 1.0f / size) : span;
    const float angle = size > 0.0f ? angle_between(problem, scratch.pose, line) : 0.0f;
    commit(problem);
    if (std::abs(angle) <= at_bound) return;
    swivel_within_limits(problem, line, angle);
    forward_kinematics(problem, scratch.trial);
    if (accept_turned(problem, watch)) remember_pose(problem);
}

template void face_pole_within_limits(Problem&, Unwatched) noexcept;
template void face_pole_within_limits(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
