// One joint's limit made ready for a solve: its three axes, the nearest rotation within. Not installed.
//
// A joint's rotation (against the bone before) is split as Limit says: first the twist about the bone, then
// the swing that takes the bone to where it points, written as one vector (the axis times the angle). In that
// plane a cone of four half-angles is four quarters of ellipses. It is convex, so its nearest point moves no
// faster than the rotation does: what is clamped never jumps. A hinge is split about its own axis instead,
// which allows up to half a turn.
//
// Whether a rotation is within needs no angles: a quaternion holds the sine and cosine of half of each, and
// bounds are kept so too. Only a swing outside the round cone that fits into the elliptic one is measured.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "tendril/ik/limit.hpp"

namespace tendril::ik::detail {

/// Angles nearer than this to a bound are at it; radians.
inline constexpr float at_bound = 1e-4f;
inline constexpr float pi = 3.14159265f;

/// An angle from -pi to pi as cosine and sine of its half. The cosine is not negative.
struct HalfAngle {
    float cosine = 1.0f, sine = 0.0f;
};

/// In the frame (axis, bone, side), which is right-handed.
struct LimitedJoint {
    JointKind kind = JointKind::Free;
    glm::vec3 bone{1, 0, 0}, axis{0, 0, 1}, side{0, 1, 0};
    float min = 0, max = 0;
    float up = 0, down = 0, left = 0, right = 0;
    float twist_min = 0, twist_max = 0;
    HalfAngle low, high;  ///< of the hinge's angle, or the twist
    float round = 0;  ///< the square of a swing's sine of half its angle, up to which it is within for sure

    bool hinge() const noexcept { return kind == JointKind::Hinge; }
    bool free() const noexcept { return kind == JointKind::Free; }
};

/// What is left of a limit's axis, as a unit vector, without its part along the bone (a unit vector too);
/// zero where that is nothing.
glm::vec3 across_of(const Limit& limit, const glm::vec3& bone) noexcept;

/// The limit must be without fault for this bone.
LimitedJoint limited_joint(const Limit& limit, const glm::vec3& rest_direction) noexcept;
/// The same for a solve: a bone that points straight back shows neither its twist nor to which side it swung,
/// so where any of these is limited, it stays a little off that.
LimitedJoint solvable_joint(const Limit& limit, const glm::vec3& rest_direction) noexcept;

JointAngles angles_of(const LimitedJoint& joint, const glm::quat& rotation) noexcept;
/// The unit quaternion with these angles.
glm::quat rotation_of(const LimitedJoint& joint, const JointAngles& angles) noexcept;
/// The nearest within the limit: the cone and the twist each by itself.
JointAngles within(const LimitedJoint& joint, const JointAngles& angles) noexcept;
float excess_of(const LimitedJoint& joint, const JointAngles& angles) noexcept;
/// Whether any of the angles that the joint has is at its bound, or has no freedom at all.
bool is_at_limit(const LimitedJoint& joint, const JointAngles& angles) noexcept;

/// The bounds that a rotation stands at.
struct Bounds {
    struct Bound {
        glm::vec3 outward;  ///< the unit axis about which to turn on leads out of the limit, in the parent's
                            ///< frame
        bool both = false;  ///< the other way round leads out as well
    };
    int count = 0;
    Bound at[3];
    void add(const glm::vec3& outward, bool both) noexcept { at[count++] = {outward, both}; }
};
Bounds bounds_of(const LimitedJoint& joint, const glm::quat& rotation) noexcept;

}  // namespace tendril::ik::detail
