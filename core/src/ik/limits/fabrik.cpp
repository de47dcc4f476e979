#include "ik/limits/fabrik.hpp"

#include "ik/limits/pose.hpp"

namespace tendril::ik::detail {
namespace {

template <class Watch>
void place(const Problem& problem, Phase phase, std::size_t joint, std::size_t neighbour,
           const glm::vec3& from, glm::vec3& place, const glm::vec3& to, Watch watch) noexcept {
    watch.moved(problem.iteration, phase, joint, neighbour, from, to);
    watch.next_step();
    place = to;
}

/// From the tip, which goes to the target, to the root, which is left.
template <class Watch>
void forward_reaching(Problem& problem, Watch watch) noexcept {
    const LimitedPose& from = problem.scratch.limited.pose;
    LimitedPose& to = problem.scratch.limited.trial;
    const std::size_t last = problem.bones() - 1;
    const std::optional<glm::quat> asked = asked_orientation(problem);
    place(problem, Phase::ForwardReaching, last + 1, no_joint, from.joints[last + 1], to.joints[last + 1],
          problem.target, watch);
    for (std::size_t i = last + 1; i-- > 0;) {
        const glm::vec3 next = to.joints[i + 1];
        const float length = problem.lengths()[i];
        if (i == last && asked) {
            to.rotations[i] = *asked;
            to.directions[i] = bone_direction(problem, to.rotations[i], i);
        } else {
            to.directions[i] = math::direction(from.joints[i], next, from.directions[i]);
            to.rotations[i] = transported(from.rotations[i], from.directions[i], to.directions[i]);
        }
        place(problem, Phase::ForwardReaching, i, i + 1, from.joints[i], to.joints[i],
              moved(next, to.directions[i], -length), watch);
        if (i == last) continue;
        glm::quat local = compose(conjugate(to.rotations[i]), to.rotations[i + 1]);
        if (!clamp(problem.scratch.limited.limits[i + 1], local)) continue;
        to.rotations[i] = nearly_unit(compose(to.rotations[i + 1], conjugate(local)));
        to.directions[i] = bone_direction(problem, to.rotations[i], i);
        place(problem, Phase::Limit, i, i + 1, to.joints[i], to.joints[i],
              moved(next, to.directions[i], -length), watch);
    }
}

template <class Watch>
void backward_reaching(Problem& problem, Watch watch) noexcept {
    LimitedPose& pose = problem.scratch.limited.trial;
    const std::optional<glm::quat> asked = asked_orientation(problem);
    place(problem, Phase::BackwardReaching, 0, no_joint, pose.joints[0], pose.joints[0], problem.root(),
          watch);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::vec3 before = pose.joints[i];
        const float length = problem.lengths()[i];
        if (i + 1 == problem.bones() && asked) {
            pose.rotations[i] = *asked;
            pose.directions[i] = bone_direction(problem, pose.rotations[i], i);
        } else {
            const glm::vec3 old = pose.directions[i];
            pose.directions[i] = math::direction(before, pose.joints[i + 1], old);
            pose.rotations[i] = transported(pose.rotations[i], old, pose.directions[i]);
        }
        place(problem, Phase::BackwardReaching, i + 1, i, pose.joints[i + 1], pose.joints[i + 1],
              moved(before, pose.directions[i], length), watch);
        const glm::quat parent = parent_of(pose.rotations, i);
        pose.local[i] = compose(conjugate(parent), pose.rotations[i]);
        if (!clamp(problem.scratch.limited.limits[i], pose.local[i])) continue;
        pose.rotations[i] = nearly_unit(compose(parent, pose.local[i]));
        pose.directions[i] = bone_direction(problem, pose.rotations[i], i);
        place(problem, Phase::Limit, i + 1, i, pose.joints[i + 1], pose.joints[i + 1],
              moved(before, pose.directions[i], length), watch);
    }
}

}  // namespace

template <class Watch>
void limited_reaching(Problem& problem, Watch watch) noexcept {
    forward_reaching(problem, watch);
    backward_reaching(problem, watch);
}

template void limited_reaching(Problem&, Unwatched) noexcept;
template void limited_reaching(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
