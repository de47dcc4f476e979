// Joint limits: how far a joint may swing (where its bone points) and twist (how the bone turns about
// itself).
//
// A joint's angles are its bone's, relative to the parent bone (for the root: to the world), measured from
// the rest pose. Swing is measured about two axes perpendicular to the bone at rest: about `axis`, where a
// positive angle is *up*, and about `axis x bone`, where a positive angle is *left*. With a bone along +X and
// the axis +Z, up is +Y and left is -Z. Twist is about the bone itself, right-handed.
//
// Source of the decomposition: F. S. Grassia, "Practical parameterization of rotations using the exponential
// map", Journal of Graphics Tools 3(3), 1998. Joint kinds after Aristidou, Chrysanthou, Lasenby, "Extending
// FABRIK with model constraints", Computer Animation and Virtual Worlds 27(1), 2016. Angles of the presets
// after Greene, Heckman (eds.), "The Clinical Measurement of Joint Motion", American Academy of Orthopaedic
// Surgeons, 1994, rounded.
#pragma once

#include <cstdint>
#include <span>

#include "tendril/fields.hpp"
#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

enum class JointKind : std::uint8_t {
    Free,          ///< no limit
    Suture,        ///< skull: almost fixed
    Hinge,         ///< elbow, knee, finger: one axis, from `min` to `max`
    Gliding,       ///< wrist, ankle: two axes, small range
    Saddle,        ///< thumb: two axes, larger range
    Pivot,         ///< neck: twist and a small nod
    BallAndSocket  ///< hip, shoulder: an elliptic cone and twist
};
/// "ball_and_socket"
const char* name(JointKind kind) noexcept;

/// Above this, a joint would hardly move within a solve.
inline constexpr float max_stiffness = 0.99f;

/// All angles in radians.
struct Limit {
    JointKind kind = JointKind::Free;
    /// World axis at rest, longer than 1e-6. Its component along the bone is removed; the rest must not
    /// vanish.
    glm::vec3 axis{0.0f, 0.0f, 1.0f};
    /// Hinge: the angle about `axis`, -pi <= min <= max <= pi.
    float min = 0.0f, max = 0.0f;
    /// All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an elliptic quadrant.
    float up = 0.0f, down = 0.0f, left = 0.0f, right = 0.0f;
    /// All other kinds: -pi <= twist_min <= twist_max <= pi.
    float twist_min = 0.0f, twist_max = 0.0f;
    /// 0 to max_stiffness: how much the joint resists turning, compared with the other joints of the chain.
    /// Beside joints of stiffness 0, one of 0.9 takes a tenth of its share of each step, and the others make
    /// up for it. If all are equally stiff, nothing changes. Stiffness only chooses among the poses that
    /// reach the target; a stiff joint that must turn far costs iterations (up to 1 / (1 - stiffness) times
    /// in CCD and FABRIK). A two-bone limb in closed form ignores it. Applies to every kind.
    float stiffness = 0.0f;

    bool operator==(const Limit&) const = default;

    /// A limit of this kind with typical human angles, to be adjusted.
    static Limit of(JointKind kind) noexcept;
    static Limit hinge(glm::vec3 axis, float min, float max) noexcept;
};

/// The fields that a limit of this kind uses, in the order of its members.
std::span<const Field> limit_fields(JointKind kind) noexcept;

/// The fault of an invalid limit, as a constant text ("the hinge's axis has no length"). Null if it is valid.
const char* fault(const Limit& limit) noexcept;
/// Also checks the limit against a bone's rest direction: "the hinge's axis lies along the bone".
const char* fault(const Limit& limit, glm::vec3 rest_direction) noexcept;

/// A joint's rotation, measured in the axes of its limit; radians.
struct JointAngles {
    float up = 0.0f;     ///< about the axis; down is negative
    float left = 0.0f;   ///< right is negative
    float twist = 0.0f;  ///< about the bone
};

/// `turn` is the unit quaternion of this bone relative to its parent bone, identity at rest.
JointAngles measure(const Limit& limit, glm::vec3 rest_direction, glm::quat turn) noexcept;

/// By how much the angles exceed the limit, radians; 0 within it.
float excess(const Limit& limit, const JointAngles& angles) noexcept;

}  // namespace tendril::ik

/// All fields of every kind. Angles are in radians.
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Limit>() noexcept;
