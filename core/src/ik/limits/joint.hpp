// A joint's limit prepared for a solve: its three axes, and the nearest rotation within it. Not installed.
//
// A joint's rotation (relative to its parent bone) is split as in Limit: first the twist about the bone, then
// the swing that points the bone, written as one vector (the axis times the angle). In that plane a cone of
// four half-angles consists of four elliptic quadrants. It is convex, so its nearest point moves no faster
// than the rotation does: clamping never jumps. A hinge is split about its own axis instead, which allows up
// to half a turn.
//
// The check needs no angles: a quaternion holds sine and cosine of the half-angles, and the bounds are stored
// that way too. Only a swing outside the round cone inscribed in the elliptic one is measured.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "tendril/ik/limit.hpp"

namespace tendril::ik::detail {

inline constexpr const char* kind_names[] = {"free",   "suture", "hinge",          "gliding",
                                             "saddle", "pivot",  "ball_and_socket"};

/// Angles within this distance of a bound are at it; radians.
inline constexpr float at_bound = 1e-4f;
inline constexpr float pi = 3.14159265f;

/// Cosine and sine of half an angle from -pi to pi. The cosine is not negative.
struct HalfAngle {
    float cosine = 1.0f, sine = 0.0f;
};

/// The right-handed frame is (axis, bone, side).
struct LimitedJoint {
    JointKind kind = JointKind::Free;
    glm::vec3 bone{1, 0, 0}, axis{0, 0, 1}, side{0, 1, 0};
    float min = 0, max = 0;
    float up = 0, down = 0, left = 0, right = 0;
    float twist_min = 0, twist_max = 0;
    HalfAngle low, high;  ///< bounds of the hinge's angle, or the twist
    bool from_base =
        false;           ///< measured in the world instead of relative to the parent bone: AngleFrom::Base
    float mobility = 1;  ///< fraction of the wanted rotation that the joint makes in each step
    float round = 0;     ///< sin^2 of half the swing up to which it is certainly within

    bool hinge() const noexcept { return kind == JointKind::Hinge; }
    bool free() const noexcept { return kind == JointKind::Free; }
};

/// A limit's axis without its component along the bone (a unit vector), not normalised; zero if almost
/// nothing remains.
glm::vec3 across_of(const Limit& limit, const glm::vec3& bone) noexcept;

/// The limit must be valid for this bone.
LimitedJoint limited_joint(const Limit& limit, const glm::vec3& rest_direction) noexcept;
/// limited_joint() for a solve: the cone stays a little short of straight back, where neither the twist nor
/// the side of the swing is defined. A cone that limits nothing becomes Free.
LimitedJoint solvable_joint(const Limit& limit, const glm::vec3& rest_direction) noexcept;

JointAngles angles_of(const LimitedJoint& joint, const glm::quat& rotation) noexcept;
/// The unit quaternion with these angles.
glm::quat rotation_of(const LimitedJoint& joint, const JointAngles& angles) noexcept;
/// Clamps to the limit: cone and twist separately.
JointAngles within(const LimitedJoint& joint, const JointAngles& angles) noexcept;
float excess_of(const LimitedJoint& joint, const JointAngles& angles) noexcept;
/// True if any of the joint's angles is at its bound, or has no range at all.
bool is_at_limit(const LimitedJoint& joint, const JointAngles& angles) noexcept;

/// The bounds that a rotation is at.
struct Bounds {
    struct Bound {
        glm::vec3 outward;  ///< unit axis, in the parent's frame, of the rotation that leaves the limit
        bool both = false;  ///< rotating the other way leaves it too
    };
    int count = 0;
    Bound at[3];
    void add(const glm::vec3& outward, bool both) noexcept { at[count++] = {outward, both}; }
};
Bounds bounds_of(const LimitedJoint& joint, const glm::quat& rotation) noexcept;

}  // namespace tendril::ik::detail
