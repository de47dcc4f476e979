#include "ik/limits/methods.hpp"

#include "ik/limits/fabrik.hpp"
#include "ik/limits/pose.hpp"
#include "ik/limits/step.hpp"
#include "tendril/ik/two_bone.hpp"

namespace tendril::ik::detail {
namespace {

/// Cyclic coordinate descent: from the tip's joint to the root's, each turns by the least rotation that
/// brings the tip onto the line to the target, as far as its limit lets it. The joints nearer to the root
/// stand still meanwhile, so all turns can be carried out at the end, in O(n).
template <class Watch>
void sweep(Problem& problem, Watch watch) noexcept {
    LimitedRoom& room = problem.room.limited;
    std::vector<glm::quat>& rotations = room.trial.rotations;
    glm::vec3 tip = problem.joints.back();
    for (std::size_t i = problem.bones(); i-- > 0;) {
        const glm::vec3 at = problem.joints[i];
        const glm::quat parent = parent_of(problem.room.rotations, i), old = problem.room.rotations[i];
        glm::quat wanted = old;
        if (i + 1 == problem.bones() && problem.options.tip_orientation) {
            wanted = *problem.options.tip_orientation;
        } else if (!coincide(at, tip) && !coincide(at, problem.target)) {
            const glm::vec3 from = tendril::math::direction(at, tip, {}),
                            to = tendril::math::direction(at, problem.target, {});
            wanted = compose(least_rotation(from, to), old);
        }
        rotations[i] = unit(compose(conjugate(parent), wanted));
        bring_within(room.limits[i], rotations[i]);
        const glm::quat by = unit(compose(compose(parent, rotations[i]), conjugate(old)));
        tip = plus(at, rotated(by, minus(tip, at)));
    }
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        rotations[i] = unit(compose(parent_of(rotations, i), rotations[i]));
    }
    lay(problem, room.trial);
    assume(problem, room.trial, Phase::Turn, watch);
}

/// The closed form, as if there were no limits, and then brought within them: the iterations that follow go
/// on from there. The bones keep their lengths.
template <class Watch>
void close(Problem& problem, Watch watch) noexcept {
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
    settle(problem, watch);
}

}  // namespace

template <class Watch>
void limited_iteration(Method method, Problem& problem, Watch watch) noexcept {
    if (method == Method::FabrikPlain) return limited_pulls(problem, watch);
    if (method == Method::Ccd) return sweep(problem, watch);
    const bool closed = method == Method::TwoBone && problem.bones() == 2;
    if (closed && problem.iteration == 1 && !problem.options.tip_orientation) return close(problem, watch);
    const float damping = problem.options.damping * problem.options.damping;
    const Descent descent = method == Method::JacobianTranspose ? Descent::Transpose
                            : method == Method::SvdDls          ? Descent::Filtered
                                                                : Descent::Damped;
    limited_step(problem, descent, damping);
    assume(problem, problem.room.limited.trial, Phase::Gradient, watch);
}

template void limited_iteration(Method, Problem&, Unwatched) noexcept;
template void limited_iteration(Method, Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
