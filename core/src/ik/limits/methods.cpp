#include "ik/limits/methods.hpp"

#include <algorithm>

#include "ik/limits/least_squares.hpp"
#include "ik/limits/pose.hpp"
#include "ik/methods/methods.hpp"
#include "tendril/ik/options.hpp"
#include "tendril/ik/two_bone.hpp"

namespace tendril::ik::detail {
namespace {

template <class Watch>
void place(const Problem& problem, Phase phase, std::size_t joint, std::size_t neighbour,
           const glm::vec3& from, glm::vec3& place, const glm::vec3& to, Watch watch) noexcept {
    watch.moved(problem.iteration, phase, joint, neighbour, from, to);
    watch.next_step();
    place = to;
}

/// In scratch.trial: turns a bone so that the next one, already placed, is within its limit. A bone limited
/// from the base turns into its own limit instead. Returns whether the bone had to turn.
bool clamp_against_next(Problem& problem, std::size_t bone) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    std::vector<glm::quat>& rotations = scratch.trial.rotations;
    if (scratch.limits[bone].from_base) return clamp(scratch.limits[bone], rotations[bone]);
    if (bone + 1 == problem.bones() || scratch.limits[bone + 1].from_base) return false;
    glm::quat local = compose(conjugate(rotations[bone]), rotations[bone + 1]);
    if (!clamp(scratch.limits[bone + 1], local)) return false;
    rotations[bone] = nearly_unit(compose(rotations[bone + 1], conjugate(local)));
    return true;
}

/// Forward reaching: from the tip, which moves to the target, to the root, which leaves its position.
template <class Watch>
void limited_forward_reaching(Problem& problem, Watch watch) noexcept {
    const LimitedPose& from = problem.scratch.limited.pose;
    LimitedPose& to = problem.scratch.limited.trial;
    const std::size_t last = problem.bones() - 1;
    const std::optional<glm::quat> requested = requested_orientation(problem);
    place(problem, Phase::ForwardReaching, last + 1, no_joint, from.joints[last + 1], to.joints[last + 1],
          problem.target, watch);
    for (std::size_t i = last + 1; i-- > 0;) {
        const glm::vec3 next = to.joints[i + 1];
        const float length = problem.lengths()[i];
        if (i == last && requested) {
            to.rotations[i] = *requested;
            to.directions[i] = bone_direction(problem, to.rotations[i], i);
        } else {
            to.directions[i] = math::direction(from.joints[i], next, from.directions[i]);
            to.rotations[i] = transported(from.rotations[i], from.directions[i], to.directions[i]);
        }
        place(problem, Phase::ForwardReaching, i, i + 1, from.joints[i], to.joints[i],
              moved(next, to.directions[i], -length), watch);
        if (!clamp_against_next(problem, i)) continue;
        to.directions[i] = bone_direction(problem, to.rotations[i], i);
        place(problem, Phase::Limit, i, i + 1, to.joints[i], to.joints[i],
              moved(next, to.directions[i], -length), watch);
    }
}

template <class Watch>
void limited_backward_reaching(Problem& problem, Watch watch) noexcept {
    LimitedPose& pose = problem.scratch.limited.trial;
    const std::optional<glm::quat> requested = requested_orientation(problem);
    place(problem, Phase::BackwardReaching, 0, no_joint, pose.joints[0], pose.joints[0], problem.root(),
          watch);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::vec3 before = pose.joints[i];
        const float length = problem.lengths()[i];
        if (i + 1 == problem.bones() && requested) {
            pose.rotations[i] = *requested;
            pose.directions[i] = bone_direction(problem, pose.rotations[i], i);
        } else {
            const glm::vec3 old = pose.directions[i];
            pose.directions[i] = math::direction(before, pose.joints[i + 1], old);
            pose.rotations[i] = transported(pose.rotations[i], old, pose.directions[i]);
        }
        const LimitedScratch& scratch = problem.scratch.limited;
        const glm::quat parent = parent_of(scratch, pose.rotations, i);
        if (const LimitedJoint& joint = scratch.limits[i]; joint.mobility < 1.0f) {
            const glm::quat local = compose(conjugate(parent), pose.rotations[i]);
            pose.rotations[i] =
                nearly_unit(compose(parent, mobile_part(joint, scratch.pose.local[i], local)));
            pose.directions[i] = bone_direction(problem, pose.rotations[i], i);
        }
        place(problem, Phase::BackwardReaching, i + 1, i, pose.joints[i + 1], pose.joints[i + 1],
              moved(before, pose.directions[i], length), watch);
        pose.local[i] = compose(conjugate(parent), pose.rotations[i]);
        if (!clamp(scratch.limits[i], pose.local[i])) continue;
        pose.rotations[i] = nearly_unit(compose(parent, pose.local[i]));
        pose.directions[i] = bone_direction(problem, pose.rotations[i], i);
        place(problem, Phase::Limit, i + 1, i, pose.joints[i + 1], pose.joints[i + 1],
              moved(before, pose.directions[i], length), watch);
    }
}

/// Cyclic coordinate descent: from the last joint to the root, each turns by the minimal rotation that brings
/// the tip onto the line to the target, as far as its limit allows. Joints nearer to the root do not move
/// meanwhile, so all rotations can be applied at the end, in O(n).
template <class Watch>
void ccd_sweep(Problem& problem, Watch watch) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    std::vector<glm::quat>& local = scratch.trial.local;
    glm::vec3 target = problem.target;
    glm::vec3 tip = scratch.pose.joints[problem.bones()];  // the end of the bones that the joint turns
    for (std::size_t i = problem.bones(); i-- > 0;) {
        const glm::vec3 at = scratch.pose.joints[i];
        const glm::quat parent = parent_of(scratch, scratch.pose.rotations, i),
                        old = scratch.pose.rotations[i];
        const bool placed = i + 1 == problem.bones() && problem.options.tip_orientation;
        const glm::quat wanted = placed ? *problem.options.tip_orientation
                                        : compose(rotation_towards(problem, at, tip, target), old);
        local[i] = unit(compose(conjugate(parent), wanted));
        local[i] = mobile_part(scratch.limits[i], scratch.pose.local[i], local[i]);
        clamp(scratch.limits[i], local[i]);
        const glm::quat by = unit(compose(compose(parent, local[i]), conjugate(old)));
        tip = plus(at, rotated(by, minus(tip, at)));
        if (i == 0 || !is_from_base(scratch, i)) continue;
        // A bone measured from the base does not turn with the bones before it, it only moves along.
        target = plus(target, minus(at, tip));
        tip = at;
    }
    forward_kinematics(problem, scratch.trial);
    accept_trial(problem, Phase::Rotate, watch);
}

/// The closed form without limits, then clamped: the start of the iterations. The bones keep their lengths.
template <class Watch>
void solve_closed_form(Problem& problem, Watch watch) noexcept {
    commit(problem);
    const std::span<glm::vec3> joints = problem.joints;
    const TwoBone limb{joints[0], joints[1], joints[2], problem.lengths()[0], problem.lengths()[1]};
    const TwoBoneResult result =
        two_bone(limb, problem.target, {.pole = pole_of_limb(problem), .twist = problem.options.twist});
    for (const std::size_t i : {1u, 2u}) {
        const glm::vec3 to = i == 1 ? result.mid : result.tip;
        watch.moved(problem.iteration, Phase::Analytic, i, i - 1, joints[i], to);
        joints[i] = to;
    }
    watch.next_step();
    load_pose(problem, watch);
    problem.closed_form = true;
}

}  // namespace

template <class Watch>
void limited_reaching(Problem& problem, Watch watch) noexcept {
    limited_forward_reaching(problem, watch);
    limited_backward_reaching(problem, watch);
}

template <class Watch>
void limited_iteration(Method method, Problem& problem, Watch watch) noexcept {
    if (method == Method::FabrikPlain) {
        limited_reaching(problem, watch);
        return problem.scratch.limited.swap_pose(problem.scratch.limited.trial);
    }
    if (method == Method::Ccd) return ccd_sweep(problem, watch);
    const bool closed = method == Method::TwoBone && problem.bones() == 2;
    if (closed && problem.iteration == 1 && !problem.options.tip_orientation)
        return solve_closed_form(problem, watch);
    // With less damping the matrix, which limits may make singular, could not be inverted.
    const float damping = std::max(problem.options.damping * problem.options.damping, 1e-9f);
    const Descent descent = method == Method::JacobianTranspose ? Descent::Transpose
                            : method == Method::SvdDls          ? Descent::Filtered
                                                                : Descent::Damped;
    limited_step(problem, descent, damping);
    if (method == Method::TwoBone) ++problem.least_squares_steps;
    accept_trial(problem, Phase::Gradient, watch);
}

template void limited_reaching(Problem&, Unwatched) noexcept;
template void limited_reaching(Problem&, Watched) noexcept;
template void limited_iteration(Method, Problem&, Unwatched) noexcept;
template void limited_iteration(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
