#include "ik/limits/methods.hpp"

#include <algorithm>

#include "ik/limits/fabrik.hpp"
#include "ik/limits/least_squares.hpp"
#include "ik/limits/pose.hpp"
#include "tendril/ik/options.hpp"
#include "tendril/ik/two_bone.hpp"

namespace tendril::ik::detail {
namespace {

/// Cyclic coordinate descent: from the tip's joint to the root's, each turns by the minimal rotation that
/// brings the tip onto the line to the target, as far as its limit lets it. The joints nearer to the root
/// stand still meanwhile, so all turns can be applied at the end, in O(n).
template <class Watch>
void ccd_sweep(Problem& problem, Watch watch) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    std::vector<glm::quat>& local = scratch.trial.local;
    glm::vec3 tip = scratch.pose.joints[problem.bones()];
    for (std::size_t i = problem.bones(); i-- > 0;) {
        const glm::vec3 at = scratch.pose.joints[i];
        const glm::quat parent = parent_of(scratch.pose.rotations, i), old = scratch.pose.rotations[i];
        glm::quat wanted = old;
        if (i + 1 == problem.bones() && problem.options.tip_orientation) {
            wanted = *problem.options.tip_orientation;
        } else if (!coincide(at, tip) && !coincide(at, problem.target)) {
            wanted = transported(old, math::direction(at, tip, {}), math::direction(at, problem.target, {}));
        }
        local[i] = unit(compose(conjugate(parent), wanted));
        clamp(scratch.limits[i], local[i]);
        const glm::quat by = unit(compose(compose(parent, local[i]), conjugate(old)));
        tip = plus(at, rotated(by, minus(tip, at)));
    }
    forward_kinematics(problem, scratch.trial);
    accept_trial(problem, Phase::Rotate, watch);
}

/// The closed form, as if there were no limits, and then brought within them: the iterations that follow go
/// on from there. The bones keep their lengths.
template <class Watch>
void solve_closed_form(Problem& problem, Watch watch) noexcept {
    commit(problem);
    const std::span<glm::vec3> joints = problem.joints;
    const TwoBone limb{joints[0], joints[1], joints[2], problem.lengths()[0], problem.lengths()[1]};
    const TwoBoneResult result =
        two_bone(limb, problem.target, {.pole = problem.options.pole, .twist = problem.options.twist});
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
void limited_iteration(Method method, Problem& problem, Watch watch) noexcept {
    if (method == Method::FabrikPlain) {
        limited_reaching(problem, watch);
        return problem.scratch.limited.swap_pose(problem.scratch.limited.trial);
    }
    if (method == Method::Ccd) return ccd_sweep(problem, watch);
    const bool closed = method == Method::TwoBone && problem.bones() == 2;
    if (closed && problem.iteration == 1 && !problem.options.tip_orientation)
        return solve_closed_form(problem, watch);
    // Under this the matrix, which limits may leave singular, could not be inverted.
    const float damping = std::max(problem.options.damping * problem.options.damping, 1e-9f);
    const Descent descent = method == Method::JacobianTranspose ? Descent::Transpose
                            : method == Method::SvdDls          ? Descent::Filtered
                                                                : Descent::Damped;
    limited_step(problem, descent, damping);
    if (method == Method::TwoBone) ++problem.least_squares_steps;
    accept_trial(problem, Phase::Gradient, watch);
}

template void limited_iteration(Method, Problem&, Unwatched) noexcept;
template void limited_iteration(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
