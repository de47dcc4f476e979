#include "ik/limits/joint.hpp"

#include <algorithm>

#include "ik/math.hpp"

namespace tendril::ik::detail {
namespace {

/// By how much an angle is over a range, the shorter way round the circle; negative below it.
float over(float angle, float min, float max) noexcept {
    if (angle >= min && angle <= max) return 0.0f;
    const float above = angle > max ? angle - max : angle - max + 2.0f * pi;
    const float below = angle < min ? min - angle : min - angle + 2.0f * pi;
    return above <= below ? above : -below;
}

float into(float angle, float min, float max) noexcept {
    const float by = over(angle, min, max);
    return by > 0.0f ? max : by < 0.0f ? min : angle;
}

/// Twice the angle whose sine and cosine are in this proportion, from -pi to pi.
float doubled_angle(float sine, float cosine) noexcept {
    return cosine < 0.0f ? 2.0f * std::atan2(-sine, -cosine) : 2.0f * std::atan2(sine, cosine);
}

/// The point of an ellipse that is nearest to (x, y), which lies outside; all of them positive or zero, the
/// half-axes positive. It is (a a x / (t + a a), b b y / (t + b b)) for the one t >= 0 that puts it on the
/// ellipse; the condition falls and is convex in t, so Newton's steps from below never pass it.
void nearest_on_ellipse(float a, float b, float& x, float& y) noexcept {
    float t = std::max(a * x - a * a, b * y - b * b);
    for (int i = 0; i < 12; ++i) {
        const float u = a * x / (t + a * a), v = b * y / (t + b * b);
        const float value = u * u + v * v - 1.0f;
        if (value < 1e-6f) break;
        t += value / (2.0f * (u * u / (t + a * a) + v * v / (t + b * b)));
    }
    const float u = a * x / (t + a * a), v = b * y / (t + b * b);
    const float scale = 1.0f / std::sqrt(u * u + v * v);
    x = a * u * scale;
    y = b * v * scale;
}

constexpr float flat = 1e-5f;  ///< half-angles under this leave no room

void into_cone(const LimitedJoint& joint, float& up, float& left) noexcept {
    const float a = up >= 0.0f ? joint.up : joint.down, b = left >= 0.0f ? joint.left : joint.right;
    float x = std::abs(up), y = std::abs(left);
    if (a < flat || b < flat) {
        x = a < flat ? 0.0f : std::min(x, a);
        y = b < flat ? 0.0f : std::min(y, b);
    } else if ((x / a) * (x / a) + (y / b) * (y / b) > 1.0f) {
        nearest_on_ellipse(a, b, x, y);
    }
    up = up >= 0.0f ? x : -x;
    left = left >= 0.0f ? y : -y;
}

}  // namespace

glm::vec3 across_of(const Limit& limit, const glm::vec3& bone) noexcept {
    const float size = length(limit.axis);
    if (!(size > 1e-6f) || !(size <= 3e9f)) return {0.0f, 0.0f, 0.0f};
    const glm::vec3 axis = times(limit.axis, 1.0f / size);
    const glm::vec3 across = minus(axis, times(bone, dot(bone, axis)));
    return dot(across, across) > 1e-8f ? across : glm::vec3(0.0f);
}

LimitedJoint limited_joint(const Limit& limit, const glm::vec3& rest_direction) noexcept {
    LimitedJoint joint;
    joint.kind = limit.kind;
    joint.bone = times(rest_direction, 1.0f / length(rest_direction));
    const glm::vec3 across = across_of(limit, joint.bone);
    const float size = length(across);
    // A free joint asks for nothing, so its axis may be anything.
    joint.axis = size > 0.0f ? times(across, 1.0f / size) : perpendicular(joint.bone);
    joint.side = cross(joint.axis, joint.bone);
    joint.min = limit.min, joint.max = limit.max;
    joint.up = limit.up, joint.down = limit.down, joint.left = limit.left, joint.right = limit.right;
    joint.twist_min = limit.twist_min, joint.twist_max = limit.twist_max;
    return joint;
}

JointAngles angles_of(const LimitedJoint& joint, const glm::quat& turn) noexcept {
    const glm::vec3 vector{turn.x, turn.y, turn.z};
    const float x = dot(vector, joint.axis), y = dot(vector, joint.side), z = dot(vector, joint.bone);
    // The part about one axis, as cosine and sine of half its angle; what is left is about the other two.
    const float part = joint.hinge() ? x : z;
    const float size = std::sqrt(turn.w * turn.w + part * part);
    const float c = size < 1e-6f ? 1.0f : turn.w / size, s = size < 1e-6f ? 0.0f : part / size;
    const float first = joint.hinge() ? y : x, second = joint.hinge() ? z : y;
    const float a = joint.hinge() ? c * first - s * second : c * first + s * second;
    const float b = joint.hinge() ? c * second + s * first : c * second - s * first;
    const float sine = std::sqrt(a * a + b * b);
    const float scale = sine < 1e-6f ? 2.0f : 2.0f * std::atan2(sine, size) / sine;
    const float about = doubled_angle(s, c);
    return joint.hinge() ? JointAngles{about, a * scale, b * scale}
                         : JointAngles{a * scale, b * scale, about};
}

glm::quat turn_of(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    if (joint.hinge()) return rotation_about(joint.axis, angles.up);
    const float angle = std::sqrt(angles.up * angles.up + angles.left * angles.left);
    const float scale = angle < 1e-6f ? 0.5f : std::sin(0.5f * angle) / angle;
    const float w = std::cos(0.5f * angle), a = angles.up * scale, b = angles.left * scale;
    const float c = std::cos(0.5f * angles.twist), s = std::sin(0.5f * angles.twist);
    const glm::vec3 vector = plus(plus(times(joint.axis, a * c - b * s), times(joint.side, b * c + a * s)),
                                  times(joint.bone, w * s));
    return unit_quaternion(w * c, vector.x, vector.y, vector.z);
}

JointAngles within(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    if (joint.free()) return angles;
    if (joint.hinge()) return {into(angles.up, joint.min, joint.max), 0.0f, 0.0f};
    JointAngles inside = angles;
    into_cone(joint, inside.up, inside.left);
    inside.twist = into(angles.twist, joint.twist_min, joint.twist_max);
    return inside;
}

float excess_of(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    if (joint.free()) return 0.0f;
    if (joint.hinge()) {
        return std::max(std::abs(over(angles.up, joint.min, joint.max)),
                        std::sqrt(angles.left * angles.left + angles.twist * angles.twist));
    }
    const JointAngles inside = within(joint, angles);
    const float up = angles.up - inside.up, left = angles.left - inside.left;
    return std::max(std::sqrt(up * up + left * left),
                    std::abs(over(angles.twist, joint.twist_min, joint.twist_max)));
}

bool bring_within(const LimitedJoint& joint, glm::quat& turn, float slack) noexcept {
    if (joint.free()) return false;
    const JointAngles angles = angles_of(joint, turn);
    if (excess_of(joint, angles) <= slack) return false;
    turn = turn_of(joint, within(joint, angles));
    return true;
}

bool is_at_limit(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    if (joint.free()) return false;
    const auto at = [](float angle, float min, float max) {
        return max - min < 2.0f * pi - at_bound && (angle <= min + at_bound || angle >= max - at_bound);
    };
    if (joint.hinge()) return at(angles.up, joint.min, joint.max);
    return at(angles.twist, joint.twist_min, joint.twist_max) || on_rim(joint, angles);
}

bool on_rim(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    const float a = std::max(angles.up >= 0.0f ? joint.up : joint.down, flat);
    const float b = std::max(angles.left >= 0.0f ? joint.left : joint.right, flat);
    const float x = angles.up / a, y = angles.left / b;
    return x * x + y * y > 1.0f - 2.0f * at_bound;
}

}  // namespace tendril::ik::detail
