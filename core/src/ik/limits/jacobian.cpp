#include "ik/limits/jacobian.hpp"

#include "ik/limits/pose.hpp"

namespace tendril::ik::detail {
namespace {

/// The change of rotation, in the world's axes of the swing's own frame, for a change `d` of the vector `v`
/// of a rotation: the left Jacobian of the exponential map.
glm::vec3 turned_by(const glm::vec3& v, const glm::vec3& d) noexcept {
    const float squared = dot(v, v);
    const glm::vec3 vd = cross(v, d);
    if (squared < 1e-6f) return plus(d, times(vd, 0.5f));
    const float angle = std::sqrt(squared);
    const float first = (1.0f - std::cos(angle)) / squared;
    const float second = (1.0f - std::sin(angle) / angle) / squared;
    return plus(plus(d, times(vd, first)), times(cross(v, vd), second));
}

/// How each angle of a joint turns its bone: three axes in the world, zero for what the joint has not.
std::array<glm::vec3, 3> axes_of(const Problem& problem, std::size_t bone,
                                 const JointAngles& angles) noexcept {
    const LimitedJoint& joint = problem.room.limited.limits[bone];
    const glm::quat parent = parent_of(problem.room.rotations, bone);
    if (joint.free()) {
        return {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)};
    }
    if (joint.hinge()) return {rotated(parent, joint.axis), glm::vec3(0.0f), glm::vec3(0.0f)};
    const glm::vec3 swing = plus(times(joint.axis, angles.up), times(joint.side, angles.left));
    return {rotated(parent, turned_by(swing, joint.axis)), rotated(parent, turned_by(swing, joint.side)),
            bone_direction(problem, problem.room.rotations[bone], bone)};
}

float along(const Wanted& wanted, const glm::vec3& column, const glm::vec3& axis) noexcept {
    return dot(column, wanted.move) + wanted.scale * dot(axis, wanted.turn);
}

bool pushes(float angle, float by, float min, float max) noexcept {
    if (max - min >= 2.0f * pi - at_bound) return false;
    return (angle >= max - at_bound && by > 0.0f) || (angle <= min + at_bound && by < 0.0f);
}

void drop(LimitedRoom& room, std::size_t i, std::size_t k) noexcept {
    room.columns[i][k] = room.axes[i][k] = glm::vec3(0.0f);
}

/// Only the part of the two swings along the unit vector (up, left) is left.
void slide(std::array<glm::vec3, 3>& vectors, float up, float left) noexcept {
    const glm::vec3 tangent = plus(times(vectors[0], up), times(vectors[1], left));
    vectors[0] = times(tangent, up);
    vectors[1] = times(tangent, left);
}

bool hold_swing(LimitedRoom& room, std::size_t i, const JointAngles& change) noexcept {
    const LimitedJoint& joint = room.limits[i];
    const JointAngles& angles = room.angles[i];
    const float a = angles.up >= 0.0f ? joint.up : joint.down,
                b = angles.left >= 0.0f ? joint.left : joint.right;
    const float up = angles.up * b * b, left = angles.left * a * a;  // outward
    const float size = std::sqrt(up * up + left * left);
    if (!on_rim(joint, angles) || size < 1e-12f || change.up * up + change.left * left <= 1e-6f * size) {
        return false;
    }
    slide(room.columns[i], -left / size, up / size);
    slide(room.axes[i], -left / size, up / size);
    return true;
}

}  // namespace

void linearize(Problem& problem) noexcept {
    LimitedRoom& room = problem.room.limited;
    const glm::vec3 tip = problem.joints.back();
    const float unit_length = 1.0f / problem.room.reach;  // so that no size of chain overflows
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::quat parent = parent_of(problem.room.rotations, i);
        room.angles[i] = angles_of(room.limits[i], compose(conjugate(parent), problem.room.rotations[i]));
        room.axes[i] = axes_of(problem, i, room.angles[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            room.columns[i][k] = cross(room.axes[i][k], times(minus(tip, problem.joints[i]), unit_length));
        }
    }
}

Wanted wanted_of(const Problem& problem) noexcept {
    Wanted wanted;
    const float unit_length = 1.0f / problem.room.reach;
    wanted.move = times(minus(problem.target, problem.joints.back()), unit_length);
    // A target far out of reach says no more than its direction.
    if (const float far = length(wanted.move); far > 1.0f) wanted.move = times(wanted.move, 1.0f / far);
    if (problem.options.tip_orientation) {
        wanted.turn = times(orientation_error(problem, problem.room.rotations), unit_length);
        wanted.scale = 0.25f;
    }
    return wanted;
}

JointAngles change_of(const LimitedRoom& room, std::size_t i, const Wanted& by) noexcept {
    return {along(by, room.columns[i][0], room.axes[i][0]), along(by, room.columns[i][1], room.axes[i][1]),
            along(by, room.columns[i][2], room.axes[i][2])};
}

bool hold_back(Problem& problem, const Wanted& by) noexcept {
    LimitedRoom& room = problem.room.limited;
    bool any = false;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const LimitedJoint& joint = room.limits[i];
        if (joint.free()) continue;
        const JointAngles change = change_of(room, i, by);
        if (joint.hinge()) {
            if (!pushes(room.angles[i].up, change.up, joint.min, joint.max)) continue;
            drop(room, i, 0);
            any = true;
            continue;
        }
        if (pushes(room.angles[i].twist, change.twist, joint.twist_min, joint.twist_max)) {
            drop(room, i, 2);
            any = true;
        }
        any = hold_swing(room, i, change) || any;
    }
    return any;
}

}  // namespace tendril::ik::detail
