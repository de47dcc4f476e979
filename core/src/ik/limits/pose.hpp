// The pose of a solve with limits: consistent joints and rotations, every joint within its limit. Not
// installed.
#pragma once

#include <optional>

#include "ik/limits/clamp.hpp"
#include "ik/limits/workspace.hpp"
#include "ik/math.hpp"
#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Normalises a rotation; products slowly lose unit length.
static inline glm::quat unit(const glm::quat& q) noexcept {
    return unit_quaternion(q.w, q.x, q.y, q.z);
}
/// unit() after only a few products: one Newton step for the inverse root.
static inline glm::quat nearly_unit(const glm::quat& q) noexcept {
    const float scale = 1.5f - 0.5f * (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

/// True if a bone's rotation is measured in the world: for the root's bone and, in a plane, for bones whose
/// limits are. Such a bone does not turn with the bones before it.
static inline bool is_from_base(const LimitedScratch& scratch, std::size_t bone) noexcept {
    return bone == 0 || scratch.limits[bone].from_base;
}
/// The first joint that a bone's rotation does not carry along rigidly: the joint of the next bone measured
/// from the base, or one past the tip's bone.
static inline std::size_t end_of(const LimitedScratch& scratch, std::size_t bone,
                                 std::size_t bones) noexcept {
    std::size_t end = bone + 1;
    while (end < bones && !scratch.limits[end].from_base) ++end;
    return end;
}

/// The reference of a bone's rotation: the parent bone's world rotation, or identity.
static inline glm::quat parent_of(const LimitedScratch& scratch, const std::vector<glm::quat>& rotations,
                                  std::size_t bone) noexcept {
    return is_from_base(scratch, bone) ? glm::quat(1.0f, 0.0f, 0.0f, 0.0f) : rotations[bone - 1];
}

static inline glm::quat local_rotation(const LimitedScratch& scratch, const std::vector<glm::quat>& rotations,
                                       std::size_t bone) noexcept {
    return compose(conjugate(parent_of(scratch, rotations, bone)), rotations[bone]);
}

/// Applies the minimal rotation that takes one unit vector to another.
static inline glm::quat transported(const glm::quat& rotation, const glm::vec3& from,
                                    const glm::vec3& to) noexcept {
    const float w = 1.0f + dot(from, to);
    if (w < 1e-3f) {  // almost opposite: half a turn first, then the rest
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

/// The rotation's unit axis times its angle, the shorter way round.
glm::vec3 rotation_vector(const glm::quat& rotation) noexcept;

/// Error of the pose, metres: root of the squared distance of the tip from the target plus, with a tip
/// orientation, the square of the last bone's angle times a quarter of the reach.
float error_of(const Problem& problem, const LimitedPose& pose) noexcept;
/// The requested tip orientation, normalised; none without one.
std::optional<glm::quat> requested_orientation(const Problem& problem) noexcept;
/// Rotation vector from the last bone's orientation to the requested one, times a quarter of the reach; none
/// without a tip orientation.
std::optional<glm::vec3> orientation_error(const Problem& problem, const LimitedPose& pose) noexcept;

/// Maximum distance of a joint from its position in another pose, metres.
float furthest_moved(const Problem& problem, const LimitedPose& from, const LimitedPose& to) noexcept;

/// Forward kinematics: rotations, directions and joints from `local`. The root is the problem's.
void forward_kinematics(const Problem& problem, LimitedPose& pose) noexcept;
/// Places one bone; those before it are done.
static inline void place_bone(const Problem& problem, LimitedPose& pose, std::size_t bone) noexcept {
    pose.rotations[bone] =
        nearly_unit(compose(parent_of(problem.scratch.limited, pose.rotations, bone), pose.local[bone]));
    pose.directions[bone] = bone_direction(problem, pose.rotations[bone], bone);
    pose.joints[bone + 1] = moved(pose.joints[bone], pose.directions[bone], problem.lengths()[bone]);
}

/// Before a solve: prepares the limits that have changed since the last one. One per bone, or none; false
/// if a limit is invalid for its bone. In a plane a joint keeps LimitedJoint::from_base.
Result load_limits(Workspace& scratch, std::span<const Limit> limits, bool planar = false) noexcept;

/// Loads the problem's joints and rotations into scratch.pose. If joints moved and rotations did not,
/// transports the rotations to the joints, clamps each joint from the root on and places what follows it.
/// Anything that is already consistent is kept bit for bit. Returns true if nothing was clamped and no
/// rotation was off by more than 0.01 radians.
template <class Watch>
bool load_pose(Problem& problem, Watch watch) noexcept;
/// Writes scratch.pose back to the problem.
void commit(Problem& problem) noexcept;

/// Reports the joints that differ between two poses, as one step.
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

/// Replaces the pose with `trial`.
template <class Watch>
void accept_trial(Problem& problem, Phase phase, Watch watch) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    report_moves(problem, scratch.pose, scratch.trial, phase, watch);
    scratch.swap_pose(scratch.trial);
}

}  // namespace tendril::ik::detail
