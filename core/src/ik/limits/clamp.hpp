// Checks a rotation against its limit and clamps it. Every joint goes through this in every iteration, nearly
// always without measuring an angle. Not installed.
#pragma once

#include <cmath>

#include "ik/limits/joint.hpp"
#include "ik/math.hpp"

namespace tendril::ik::detail {

/// sin of half the angle from b to a; a need not have length 1.
static inline float beyond(const HalfAngle& a, const HalfAngle& b) noexcept {
    return a.sine * b.cosine - a.cosine * b.sine;
}

static inline bool in_range(const LimitedJoint& joint, const HalfAngle& a, float half_slack) noexcept {
    return beyond(a, joint.high) <= half_slack && beyond(joint.low, a) <= half_slack;
}

/// The nearer bound, the shorter way round the circle.
static inline HalfAngle nearer_bound(const LimitedJoint& joint, const HalfAngle& a) noexcept {
    const auto near = [&](const HalfAngle& b) { return std::abs(a.cosine * b.cosine + a.sine * b.sine); };
    return near(joint.high) >= near(joint.low) ? joint.high : joint.low;
}

static inline bool clamp_hinge(const LimitedJoint& joint, glm::quat& rotation, float slack) noexcept {
    const glm::vec3 vector{rotation.x, rotation.y, rotation.z};
    const float part = dot(vector, joint.axis);
    HalfAngle about{rotation.w, part};
    if (about.cosine < 0.0f) about = {-about.cosine, -about.sine};
    const float squared = about.cosine * about.cosine + about.sine * about.sine;
    if (squared < 1e-12f) about = {1.0f, 0.0f};
    const float off = dot(vector, joint.bone), tilt = dot(vector, joint.side);
    if (in_range(joint, about, 0.5f * slack) && 4.0f * (off * off + tilt * tilt) <= slack * slack)
        return false;
    float scale = 1.0f;
    if (!in_range(joint, about, 0.0f))
        about = nearer_bound(joint, about);
    else
        scale = 1.0f / std::sqrt(about.cosine * about.cosine + about.sine * about.sine);
    const float s = about.sine * scale;
    rotation = {about.cosine * scale, joint.axis.x * s, joint.axis.y * s, joint.axis.z * s};
    return true;
}

/// True if a rotation is certainly clear of every bound. Rarely, it is false for one that is.
static inline bool is_inside(const LimitedJoint& joint, const glm::quat& rotation) noexcept {
    if (joint.free()) return true;
    const glm::vec3 vector{rotation.x, rotation.y, rotation.z};
    HalfAngle about{rotation.w, dot(vector, joint.hinge() ? joint.axis : joint.bone)};
    if (about.cosine < 0.0f) about = {-about.cosine, -about.sine};
    if (!in_range(joint, about, -at_bound)) return false;
    if (joint.hinge()) return true;
    const float x = dot(vector, joint.axis), y = dot(vector, joint.side);
    return x * x + y * y <= joint.round;
}

/// Clamps a joint other than a hinge, if is_inside is false.
bool clamp_cone(const LimitedJoint& joint, glm::quat& rotation, float slack) noexcept;

/// The part of a turn from one rotation to another that a joint's mobility allows.
static inline glm::quat mobile_part(const LimitedJoint& joint, const glm::quat& from,
                                    const glm::quat& to) noexcept {
    return joint.mobility < 1.0f ? math::slerp(from, to, joint.mobility) : to;
}

/// Moves a rotation to the nearest within its limit. Returns false, leaving it bit for bit, if it exceeds the
/// limit by no more than `slack`, radians.
static inline bool clamp(const LimitedJoint& joint, glm::quat& rotation, float slack = at_bound) noexcept {
    if (joint.free()) return false;
    if (joint.hinge()) return clamp_hinge(joint, rotation, slack);
    return !is_inside(joint, rotation) && clamp_cone(joint, rotation, slack);
}

}  // namespace tendril::ik::detail
