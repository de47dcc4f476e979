// The pose that a solve with limits works on: joints and rotations that agree, and every joint within its
// limit. Not installed.
#pragma once

#include <algorithm>

#include "ik/math.hpp"
#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// A rotation brought to length 1 again, which products lose slowly.
static inline glm::quat unit(const glm::quat& q) noexcept {
    return unit_quaternion(q.w, q.x, q.y, q.z);
}

/// How the bone before is turned; the root's is the world.
static inline glm::quat parent_of(const std::vector<glm::quat>& rotations, std::size_t bone) noexcept {
    return bone == 0 ? glm::quat(1.0f, 0.0f, 0.0f, 0.0f) : rotations[bone - 1];
}

/// How a bone is turned against the one before.
static inline glm::quat local_turn(const std::vector<glm::quat>& rotations, std::size_t bone) noexcept {
    return compose(conjugate(parent_of(rotations, bone)), rotations[bone]);
}

static inline glm::vec3 bone_direction(const Problem& problem, const glm::quat& rotation,
                                       std::size_t bone) noexcept {
    return rotated(rotation, problem.room.limited.limits[bone].bone);
}

/// Turned on by the least rotation so that the bone points along `direction`.
static inline glm::quat carried(const Problem& problem, const glm::quat& rotation, std::size_t bone,
                                const glm::vec3& direction) noexcept {
    return unit(compose(least_rotation(bone_direction(problem, rotation, bone), direction), rotation));
}

/// The vector along a rotation's axis whose length is its angle, the shorter way round.
glm::vec3 rotation_vector(const glm::quat& rotation) noexcept;

/// How far the pose is from what is asked, metres: the distance of the tip, and with a tip orientation also
/// the angle of the last bone, as if seen at a quarter of the reach.
float error_of(const Problem& problem, const LimitedPose& pose) noexcept;
float error_of(const Problem& problem) noexcept;
/// The turn from how the last bone is turned to how it should be, times that quarter of the reach.
glm::vec3 orientation_error(const Problem& problem, const std::vector<glm::quat>& rotations) noexcept;

/// Lays the joints of a pose as its rotations say.
void lay(const Problem& problem, LimitedPose& pose) noexcept;
void save(const Problem& problem, LimitedPose& pose) noexcept;

/// At the start: makes the limits ready.
void take_limits(Problem& problem) noexcept;

/// Where joints were moved and rotations were not: the rotations are carried to where the joints are, each
/// joint brought within its limit from the root on, and what hangs on it laid anew. What holds already is
/// left as it is to the bit.
template <class Watch>
void settle(Problem& problem, Watch watch) noexcept;

/// The pose becomes that of the solve, as one step.
template <class Watch>
void assume(Problem& problem, const LimitedPose& pose, Phase phase, Watch watch) noexcept {
    for (std::size_t i = 1; i < problem.joints.size(); ++i) {
        const glm::vec3 from = problem.joints[i], to = pose.joints[i];
        if (from.x == to.x && from.y == to.y && from.z == to.z) continue;
        watch.moved(problem.iteration, phase, i, i - 1, from, to);
        problem.joints[i] = to;
    }
    std::copy_n(pose.rotations.begin(), problem.bones(), problem.room.rotations.begin());
    watch.next_step();
}

}  // namespace tendril::ik::detail
