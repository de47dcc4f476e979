// The end of an iteration of CCD and the Jacobian solvers: once every joint's rotation is known, all of them
// are applied in one sweep from root to tip. O(n). Not installed.
#pragma once

#include <cfloat>

#include "ik/math.hpp"
#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Scales `bone` to a length; along +X if it has no direction.
static inline glm::vec3 with_length(const glm::vec3& bone, float length) noexcept {
    const float squared = dot(bone, bone);
    if (squared < FLT_MIN) return {length, 0.0f, 0.0f};
    return times(bone, length / std::sqrt(squared));
}

/// Rotates everything beyond joint i by scratch.rotations[i], for every i. The rotations are in the world, as
/// if no joint nearer to the root had rotated. Bones are set to their lengths, so nothing drifts.
static inline void apply_rotations(Problem& problem) noexcept {
    const std::span<glm::vec3> joints = problem.joints;
    const std::span<const float> lengths = problem.lengths();
    glm::quat all{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 before = joints.front(), at = before;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        all = compose(all, problem.scratch.rotations[i]);
        const glm::vec3 bone = minus(joints[i + 1], before);
        before = joints[i + 1];
        at = plus(at, with_length(rotated(all, bone), lengths[i]));
        joints[i + 1] = at;
    }
}

}  // namespace tendril::ik::detail
