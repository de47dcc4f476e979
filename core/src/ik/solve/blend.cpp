#include "ik/solve/blend.hpp"

#include <algorithm>

#include "ik/limits/pose.hpp"
#include "ik/math.hpp"
#include "ik/solve/prepare.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

JointAngles blended_angles(const JointAngles& a, const JointAngles& b, float part) noexcept {
    return {a.up + part * (b.up - a.up), a.left + part * (b.left - a.left),
            a.twist + part * (b.twist - a.twist)};
}

/// A limit is convex in its angles, so a blend of two poses within it is within it too.
glm::quat blended_rotation(const LimitedJoint& joint, const glm::quat& from, const glm::quat& to,
                           float part) noexcept {
    const bool whole = joint.hinge() && joint.max - joint.min >= 2.0f * pi - at_bound;
    if (joint.free() || whole) return math::slerp(from, to, part);
    return rotation_of(joint,
                       within(joint, blended_angles(angles_of(joint, from), angles_of(joint, to), part)));
}

/// Within limits, into scratch.trial.
void blend_within_limits(const Problem& problem) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        scratch.trial.local[i] =
            blended_rotation(scratch.limits[i], problem.scratch.given.local[i],
                             local_rotation(scratch, problem.state.rotations, i), problem.options.weight);
    }
    forward_kinematics(problem, scratch.trial);
}

/// Without limits, into scratch.trial.
void blend_rotations(const Problem& problem) noexcept {
    LimitedPose& pose = problem.scratch.limited.trial;
    const float weight = problem.options.weight, stretch = 1.0f + weight * (problem.stretch - 1.0f);
    pose.joints[0] = problem.root();
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        pose.rotations[i] =
            math::slerp(problem.scratch.given.rotations[i], problem.state.rotations[i], weight);
        const bool last = i + 1 == problem.bones();  // a requested tip orientation places it separately
        const float by = last && problem.options.tip_orientation ? 1.0f : stretch;
        pose.joints[i + 1] =
            moved(pose.joints[i], rotated(pose.rotations[i], problem.scratch.rest_directions[i]),
                  problem.lengths()[i] * by);
    }
}

template <class Watch>
void commit(Problem& problem, const LimitedPose& pose, Watch watch) noexcept {
    for (std::size_t i = 1; i < problem.joints.size(); ++i) {
        watch.moved(problem.iteration, Phase::Blend, i, i - 1, problem.joints[i], pose.joints[i]);
        problem.joints[i] = pose.joints[i];
    }
    std::copy_n(pose.rotations.begin(), problem.bones(), problem.state.rotations.begin());
    watch.next_step();
}

}  // namespace

template <class Watch>
void save_given(Problem& problem, Watch watch) noexcept {
    LimitedPose& given = problem.scratch.given;
    if (problem.options.limits.empty()) {
        enforce_lengths(problem, watch);
        transport_rotations(problem);
        std::copy(problem.joints.begin(), problem.joints.end(), given.joints.begin());
        std::copy_n(problem.state.rotations.begin(), problem.bones(), given.rotations.begin());
    } else {
        load_pose(problem, watch);
        commit(problem);
        given = problem.scratch.limited.pose;
    }
}

template <class Watch>
void blend(Problem& problem, Watch watch) noexcept {
    const bool within_limits = !problem.options.limits.empty();
    if (problem.options.weight == 0.0f) {
        commit(problem, problem.scratch.given, watch);
    } else {
        within_limits ? blend_within_limits(problem) : blend_rotations(problem);
        commit(problem, problem.scratch.limited.trial, watch);
    }
    if (!problem.state.pole.valid) return;
    for (std::size_t i = 0; i < problem.joints.size(); ++i)
        problem.state.pole.joints[i] = minus(problem.joints[i], problem.root());
}

template void save_given(Problem&, Unwatched) noexcept;
template void save_given(Problem&, Watched) noexcept;
template void blend(Problem&, Unwatched) noexcept;
template void blend(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
