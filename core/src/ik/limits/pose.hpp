// The pose that a solve with limits works on: joints and rotations that agree, and every joint within its
// limit. Not installed.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "ik/limits/clamp.hpp"
#include "ik/limits/workspace.hpp"
#include "ik/math.hpp"
#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// A rotation brought to length 1 again, which products lose slowly.
static inline glm::quat unit(const glm::quat& q) noexcept {
    return unit_quaternion(q.w, q.x, q.y, q.z);
}
/// The same for one that has lost no more than a few products' rounding: a step of Newton's for the root.
static inline glm::quat nearly_unit(const glm::quat& q) noexcept {
    const float scale = 1.5f - 0.5f * (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

/// How the bone before is turned; the root's is the world.
static inline glm::quat parent_of(const std::vector<glm::quat>& rotations, std::size_t bone) noexcept {
    return bone == 0 ? glm::quat(1.0f, 0.0f, 0.0f, 0.0f) : rotations[bone - 1];
}

/// How a bone is turned against the one before.
static inline glm::quat local_rotation(const std::vector<glm::quat>& rotations, std::size_t bone) noexcept {
    return compose(conjugate(parent_of(rotations, bone)), rotations[bone]);
}

/// Turned on by the minimal rotation that takes one unit vector to another.
static inline glm::quat transported(const glm::quat& rotation, const glm::vec3& from,
                                    const glm::vec3& to) noexcept {
    const float w = 1.0f + dot(from, to);
    if (w < 1e-3f) {  // all but opposite: half a turn, and on from there
        const glm::vec3 half = perpendicular(from);
        return transported(compose({0.0f, half.x, half.y, half.z}, rotation), times(from, -1.0f), to);
    }
    const glm::vec3 axis = cross(from, to);
    return unit(compose({w, axis.x, axis.y, axis.z}, rotation));
}

static inline glm::vec3 bone_direction(const Problem& problem, const glm::quat& rotation,
                                       std::size_t bone) noexcept {
    return rotated(rotation, problem.scratch.limited.limits[bone].bone);
}

/// The vector along a rotation's axis whose length is its angle, the shorter way round.
glm::vec3 rotation_vector(const glm::quat& rotation) noexcept;

/// How far the pose is from what is asked, metres: the distance of the tip, and with a tip orientation also
/// the angle of the last bone, as if seen at a quarter of the reach.
float error_of(const Problem& problem, const LimitedPose& pose) noexcept;
/// How the last bone must be turned in the end; none where no tip orientation is asked for.
std::optional<glm::quat> asked_orientation(const Problem& problem) noexcept;
/// The rotation from how the last bone is turned to how it should be, times that quarter of the reach; none
/// where no tip orientation is asked for.
std::optional<glm::vec3> orientation_error(const Problem& problem, const LimitedPose& pose) noexcept;

/// How far the joint that moved most is from where it was in another pose, metres.
float furthest_moved(const Problem& problem, const LimitedPose& from, const LimitedPose& to) noexcept;

/// Forward kinematics: rotations, directions and joints from `turns`. The root is the problem's.
void forward_kinematics(const Problem& problem, LimitedPose& pose) noexcept;
/// One bone of it; those before it are done.
static inline void place_bone(const Problem& problem, LimitedPose& pose, std::size_t bone) noexcept {
    pose.rotations[bone] = nearly_unit(compose(parent_of(pose.rotations, bone), pose.local[bone]));
    pose.directions[bone] = bone_direction(problem, pose.rotations[bone], bone);
    pose.joints[bone + 1] = moved(pose.joints[bone], pose.directions[bone], problem.lengths()[bone]);
}

/// Before a solve: makes the limits ready for it that are not those of the last one. One a bone, or none;
/// false where one has a fault for its bone.
bool load_limits(Workspace& scratch, std::span<const Limit> limits) noexcept;

/// Takes the problem's joints and rotations into scratch.pose. Where joints were moved and rotations were
/// not, the rotations are transported to where the joints are, each joint is clamped from the root on, and
/// what follows it placed anew. What holds already is left as it is to the bit; true where all does, but for
/// 0.01 radians.
template <class Watch>
bool load_pose(Problem& problem, Watch watch) noexcept;
/// Hands scratch.pose back to the problem.
void commit(Problem& problem) noexcept;

/// The joints that are elsewhere in another pose go there, as one step.
template <class Watch>
void report_moves(const Problem& problem, const LimitedPose& from, const LimitedPose& to, Phase phase,
                  Watch watch) noexcept {
    if constexpr (Watch::watching) {
        for (std::size_t i = 1; i <= problem.bones(); ++i) {
            if (from.joints[i] == to.joints[i]) continue;
            watch.moved(problem.iteration, phase, i, i - 1, from.joints[i], to.joints[i]);
        }
        watch.next_step();
    }
}

/// The pose becomes what `trial` holds.
template <class Watch>
void accept_trial(Problem& problem, Phase phase, Watch watch) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    report_moves(problem, scratch.pose, scratch.trial, phase, watch);
    scratch.swap_pose(scratch.trial);
}

}  // namespace tendril::ik::detail
