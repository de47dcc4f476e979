#include "ik/limits/fabrik.hpp"

#include "ik/limits/pose.hpp"

namespace tendril::ik::detail {
namespace {

template <class Watch>
void place(Problem& problem, Phase phase, std::size_t joint, std::size_t neighbour, const glm::vec3& to,
           Watch watch) noexcept {
    watch.moved(problem.iteration, phase, joint, neighbour, problem.joints[joint], to);
    watch.next_step();
    problem.joints[joint] = to;
}

template <class Watch>
void pull_from_tip(Problem& problem, Watch watch) noexcept {
    const std::span<glm::vec3> joints = problem.joints;
    std::vector<glm::quat>& rotations = problem.room.rotations;
    const std::size_t last = problem.bones() - 1;
    place(problem, Phase::FromTip, last + 1, no_joint, problem.target, watch);
    for (std::size_t i = last + 1; i-- > 0;) {
        glm::vec3 along = bone_direction(problem, rotations[i], i);
        if (i == last && problem.options.tip_orientation) {
            rotations[i] = unit(*problem.options.tip_orientation);
            along = bone_direction(problem, rotations[i], i);
        } else {
            along = tendril::math::direction(joints[i], joints[i + 1], along);
            rotations[i] = carried(problem, rotations[i], i, along);
        }
        const float length = problem.lengths()[i];
        place(problem, Phase::FromTip, i, i + 1, moved(joints[i + 1], along, -length), watch);
        if (i == last) continue;
        glm::quat turn = compose(conjugate(rotations[i]), rotations[i + 1]);
        if (!bring_within(problem.room.limited.limits[i + 1], turn)) continue;
        rotations[i] = unit(compose(rotations[i + 1], conjugate(turn)));
        along = bone_direction(problem, rotations[i], i);
        place(problem, Phase::Limit, i, i + 1, moved(joints[i + 1], along, -length), watch);
    }
}

template <class Watch>
void pull_from_root(Problem& problem, const glm::vec3& root, Watch watch) noexcept {
    const std::span<glm::vec3> joints = problem.joints;
    std::vector<glm::quat>& rotations = problem.room.rotations;
    place(problem, Phase::FromRoot, 0, no_joint, root, watch);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        glm::vec3 along = bone_direction(problem, rotations[i], i);
        if (i + 1 == problem.bones() && problem.options.tip_orientation) {
            rotations[i] = unit(*problem.options.tip_orientation);
            along = bone_direction(problem, rotations[i], i);
        } else {
            along = tendril::math::direction(joints[i], joints[i + 1], along);
            rotations[i] = carried(problem, rotations[i], i, along);
        }
        const float length = problem.lengths()[i];
        place(problem, Phase::FromRoot, i + 1, i, moved(joints[i], along, length), watch);
        const glm::quat parent = parent_of(rotations, i);
        glm::quat turn = compose(conjugate(parent), rotations[i]);
        if (!bring_within(problem.room.limited.limits[i], turn)) continue;
        rotations[i] = unit(compose(parent, turn));
        along = bone_direction(problem, rotations[i], i);
        place(problem, Phase::Limit, i + 1, i, moved(joints[i], along, length), watch);
    }
}

}  // namespace

template <class Watch>
void limited_pulls(Problem& problem, Watch watch) noexcept {
    const glm::vec3 root = problem.root();
    pull_from_tip(problem, watch);
    pull_from_root(problem, root, watch);
}

template void limited_pulls(Problem&, Unwatched) noexcept;
template void limited_pulls(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
