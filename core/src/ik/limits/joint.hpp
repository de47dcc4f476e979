// One joint's limit made ready for a solve: its three axes, its angles, the nearest turn within. Not
// installed.
//
// A turn is split as Limit says: first the twist about the bone, then the swing that takes the bone to where
// it points, written as one vector (the axis times the angle). In that plane a cone of four half-angles is
// four quarters of ellipses. It is convex, so its nearest point moves no faster than the turn does: what is
// brought back never jumps. A hinge is split about its own axis instead, which holds up to half a turn.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "tendril/ik/limit.hpp"

namespace tendril::ik::detail {

/// In the frame (axis, bone, side), which is right-handed.
struct LimitedJoint {
    JointKind kind = JointKind::Free;
    glm::vec3 bone{1, 0, 0}, axis{0, 0, 1}, side{0, 1, 0};
    float min = 0, max = 0;
    float up = 0, down = 0, left = 0, right = 0;
    float twist_min = 0, twist_max = 0;

    bool hinge() const noexcept { return kind == JointKind::Hinge; }
    bool free() const noexcept { return kind == JointKind::Free; }
};

/// Angles nearer than this to a bound are at it; radians.
inline constexpr float at_bound = 1e-4f;
inline constexpr float pi = 3.14159265f;

/// What is left of a limit's axis, as a unit vector, without its part along the bone (a unit vector too);
/// zero where that is nothing.
glm::vec3 across_of(const Limit& limit, const glm::vec3& bone) noexcept;

/// The limit must be without fault for this bone.
LimitedJoint limited_joint(const Limit& limit, const glm::vec3& rest_direction) noexcept;

JointAngles angles_of(const LimitedJoint& joint, const glm::quat& turn) noexcept;
/// The unit quaternion with these angles.
glm::quat turn_of(const LimitedJoint& joint, const JointAngles& angles) noexcept;
/// The nearest within the limit: the cone and the twist each by itself.
JointAngles within(const LimitedJoint& joint, const JointAngles& angles) noexcept;
float excess_of(const LimitedJoint& joint, const JointAngles& angles) noexcept;

/// The same for a turn; false, and the turn is left bit for bit, where it is over by no more than `slack`.
bool bring_within(const LimitedJoint& joint, glm::quat& turn, float slack = at_bound) noexcept;

/// Whether any of the angles that the joint has is at its bound, or has no room at all.
bool is_at_limit(const LimitedJoint& joint, const JointAngles& angles) noexcept;
/// Whether the swing lies on the rim of its cone.
bool on_rim(const LimitedJoint& joint, const JointAngles& angles) noexcept;

}  // namespace tendril::ik::detail
