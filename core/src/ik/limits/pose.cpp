#include "ik/limits/pose.hpp"

#include <algorithm>

namespace tendril::ik::detail {

glm::vec3 rotation_vector(const glm::quat& rotation) noexcept {
    const glm::vec3 vector{rotation.x, rotation.y, rotation.z};
    const float sine = length(vector);
    if (sine < 1e-6f) return times(vector, rotation.w < 0.0f ? -2.0f : 2.0f);
    const float angle =
        rotation.w < 0.0f ? -2.0f * std::atan2(sine, -rotation.w) : 2.0f * std::atan2(sine, rotation.w);
    return times(vector, angle / sine);
}

glm::vec3 orientation_error(const Problem& problem, const std::vector<glm::quat>& rotations) noexcept {
    const glm::quat& last = rotations[problem.bones() - 1];
    const glm::quat left = compose(unit(*problem.options.tip_orientation), conjugate(last));
    return times(rotation_vector(left), 0.25f * problem.room.reach);
}

namespace {

float error_of(const Problem& problem, const glm::vec3& tip,
               const std::vector<glm::quat>& rotations) noexcept {
    const float squared = squared_distance(tip, problem.target);
    if (!problem.options.tip_orientation) return std::sqrt(squared);
    const glm::vec3 turn = orientation_error(problem, rotations);
    return std::sqrt(squared + dot(turn, turn));
}

}  // namespace

float error_of(const Problem& problem, const LimitedPose& pose) noexcept {
    return error_of(problem, pose.joints[problem.bones()], pose.rotations);
}

float error_of(const Problem& problem) noexcept {
    return error_of(problem, problem.joints.back(), problem.room.rotations);
}

void lay(const Problem& problem, LimitedPose& pose) noexcept {
    pose.joints[0] = problem.root();
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::vec3 direction = bone_direction(problem, pose.rotations[i], i);
        pose.joints[i + 1] = moved(pose.joints[i], direction, problem.lengths()[i]);
    }
}

void save(const Problem& problem, LimitedPose& pose) noexcept {
    std::copy(problem.joints.begin(), problem.joints.end(), pose.joints.begin());
    std::copy_n(problem.room.rotations.begin(), problem.bones(), pose.rotations.begin());
}

namespace {

/// A bone that points straight back shows neither its twist nor to which side it swung. Where any of these is
/// limited, it stays this far from there, so that floats can tell.
void keep_from_half_turn(LimitedJoint& joint) noexcept {
    constexpr float most = pi - 0.02f;
    const float least = std::min({joint.up, joint.down, joint.left, joint.right});
    if (least >= pi - at_bound && joint.twist_max - joint.twist_min >= 2.0f * pi - at_bound) return;
    for (float* angle : {&joint.up, &joint.down, &joint.left, &joint.right}) *angle = std::min(*angle, most);
}

}  // namespace

void take_limits(Problem& problem) noexcept {
    Workspace& room = problem.room;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        room.limited.limits[i] = limited_joint(problem.options.limits[i], room.rest_directions[i]);
        keep_from_half_turn(room.limited.limits[i]);
    }
}

template <class Watch>
void settle(Problem& problem, Watch watch) noexcept {
    Workspace& room = problem.room;
    LimitedPose& pose = room.limited.trial;
    save(problem, pose);
    bool same = true;  // so far nothing had to move
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::vec3 before = bone_direction(problem, pose.rotations[i], i);
        const glm::vec3 along = tendril::math::direction(problem.joints[i], problem.joints[i + 1], before);
        // A rotation that agrees to rounding stays as it is, or each solve would shake it a little.
        if (squared_distance(before, along) > 1e-10f) {
            pose.rotations[i] = carried(problem, pose.rotations[i], i, along);
        }
        const glm::quat parent = parent_of(pose.rotations, i);
        glm::quat turn = compose(conjugate(parent), pose.rotations[i]);
        // More than a solve leaves, or the next one would begin by moving what the last has left.
        if (bring_within(room.limited.limits[i], turn, 5.0f * at_bound)) {
            pose.rotations[i] = unit(compose(parent, turn));
            same = false;
        }
        if (!same) {
            const glm::vec3 direction = bone_direction(problem, pose.rotations[i], i);
            pose.joints[i + 1] = moved(pose.joints[i], direction, problem.lengths()[i]);
        }
    }
    assume(problem, pose, Phase::Limit, watch);
}

template void settle(Problem&, Unwatched) noexcept;
template void settle(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
