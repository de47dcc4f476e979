#include "ik/limited_methods.hpp"

#include "ik/limited_pose.hpp"
#include "ik/limited_pulls.hpp"
#include "ik/limited_step.hpp"

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
            const glm::vec3 from = tendril::detail::direction(at, tip, {}),
                            to = tendril::detail::direction(at, problem.target, {});
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

}  // namespace

template <class Watch>
void limited_iteration(Method method, Problem& problem, Watch watch) noexcept {
    if (method == Method::FabrikPlain) return limited_pulls(problem, watch);
    if (method == Method::Ccd) return sweep(problem, watch);
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
