#include "ik/limits/starts.hpp"

#include <algorithm>
#include <cstdint>

#include "ik/limits/least_squares.hpp"
#include "ik/limits/pose.hpp"
#include "ik/pole/pole.hpp"
#include "ik/solve/perturbation.hpp"
#include "ik/tunables.hpp"
#include "math/random.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::limits;

/// A joint's rotation relative to its parent, bent by the world rotation vector `by`, as far as its limit
/// allows. A hinge bends by the full angle about its own axis; the plane of the arc only chooses the side.
glm::quat bent_rotation(const Problem& problem, std::size_t i, const glm::vec3& by) noexcept {
    const LimitedScratch& scratch = problem.scratch.limited;
    const LimitedJoint& joint = scratch.limits[i];
    glm::vec3 half = times(rotated(conjugate(parent_of(scratch, scratch.pose.rotations, i)), by), 0.5f);
    if (joint.hinge()) half = times(joint.axis, dot(half, joint.axis) < 0.0f ? -length(half) : length(half));
    glm::quat rotation = unit(compose({1.0f, half.x, half.y, half.z}, scratch.pose.local[i]));
    clamp(joint, rotation);
    return rotation;
}

/// Direction from root to tip; for a closed chain, from root to target.
glm::vec3 line_to_bend(const Problem& problem) noexcept {
    const LimitedPose& pose = problem.scratch.limited.pose;
    for (const glm::vec3& end : {pose.joints[problem.bones()], problem.target}) {
        const glm::vec3 arm = minus(end, problem.root());
        const float far = length(arm);
        if (far > 1e-3f * problem.scratch.reach) return times(arm, 1.0f / far);
    }
    return pose.directions[0];
}

/// Bends the first bone one way and the others back, so that the tip stays near the line. Returns the error.
float bend_in_arc(const Problem& problem, const glm::vec3& about) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const float part = std::max(2.0f * problem.lengths()[i] / problem.scratch.reach, min_part);
        const float angle = tune::chain::bend_angle * (i == 0 ? 1.0f : -part);
        scratch.trial.local[i] = bent_rotation(problem, i, times(about, angle));
    }
    forward_kinematics(problem, scratch.trial);
    return error_of(problem, scratch.trial);
}

/// A random number in [0, 1).
float random_unit(std::uint64_t& state) noexcept {
    return static_cast<float>(math::random_bits(state) >> 40) * (1.0f / 16777216.0f);
}

float interpolated(float a, float b, float part) noexcept {
    return a + (b - a) * part;
}

JointAngles sampled_angles(const LimitedJoint& joint, std::uint64_t& state) noexcept {
    const float a = random_unit(state), b = random_unit(state), c = random_unit(state);
    if (joint.hinge()) return {interpolated(joint.min, joint.max, a), 0.0f, 0.0f};
    if (joint.free())
        return {interpolated(-2.0f, 2.0f, a), interpolated(-2.0f, 2.0f, b), interpolated(-2.0f, 2.0f, c)};
    return within(joint, {interpolated(-joint.down, joint.up, a), interpolated(-joint.right, joint.left, b),
                          interpolated(joint.twist_min, joint.twist_max, c)});
}

}  // namespace

bool is_singular(Problem& problem) noexcept {
    const TipDelta wanted = requested_delta(problem);
    linearize(problem, wanted);
    const float requested = dot(wanted.move, wanted.move) + dot(wanted.rotation, wanted.rotation);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        // Unweighted: a stiff joint does not make the pose singular.
        const JointFreedom& freedom = problem.scratch.limited.freedoms[i];
        const glm::vec3 rotation = allowed_part(freedom, free_rotation_by(freedom, wanted));
        if (dot(rotation, rotation) > singular * singular * requested) return false;
    }
    return true;
}

template <class Watch>
void bend_within_limits(Problem& problem, Watch watch) noexcept {
    const glm::vec3 line = line_to_bend(problem), side = side_of(problem, line);
    const glm::vec3 axes[] = {cross(line, side), cross(side, line), times(side, -1.0f), side};
    std::size_t best = 0;
    float minimum = bend_in_arc(problem, axes[0]);
    for (std::size_t axis = 1; axis < 4; ++axis) {
        // Among equally good ways, the first is taken: rounding must not choose the side.
        const float error = bend_in_arc(problem, axes[axis]);
        if (error < minimum - tie_error * problem.scratch.reach) best = axis, minimum = error;
    }
    bend_in_arc(problem, axes[best]);
    accept_trial(problem, Phase::Prepare, watch);
}

void sample(const Problem& problem, int number) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    std::uint64_t state = static_cast<std::uint64_t>(number) * 7919u;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const LimitedJoint& joint = scratch.limits[i];
        glm::quat& local = scratch.trial.local[i];
        local = rotation_of(joint, sampled_angles(joint, state));
        // The first restarts leave stiff joints near where they were; the later ones try everything.
        if (number > default_restarts / 2 || joint.mobility == 1.0f) continue;
        local = mobile_part(joint, scratch.start.local[i], local);
        clamp(joint, local);
    }
    forward_kinematics(problem, scratch.trial);
}

template void bend_within_limits(Problem&, Unwatched) noexcept;
template void bend_within_limits(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
