#include "ik/limits/joint.hpp"

#include <algorithm>

#include "ik/limits/clamp.hpp"
#include "ik/math.hpp"
#include "tendril/elementary.hpp"

namespace tendril::ik::detail {
namespace {

constexpr float min_freedom = 1e-5f;  ///< smaller half-angles count as no range

HalfAngle half_of(float angle) noexcept {
    return {std::max(math::cosine(0.5f * angle), 0.0f), math::sine(0.5f * angle)};
}

/// A rotation split into one about a main axis (a hinge's own, or the bone for a twist), applied first, and
/// one about an axis (first, second) perpendicular to it.
struct Split {
    HalfAngle about;
    float first, second;  ///< axis of the second rotation times the sine of its half-angle
    float cosine;         ///< cosine of the half-angle
};

Split split(const LimitedJoint& joint, const glm::quat& rotation) noexcept {
    const glm::vec3 vector{rotation.x, rotation.y, rotation.z};
    const float part = dot(vector, joint.hinge() ? joint.axis : joint.bone),
                sign = rotation.w < 0 ? -1.0f : 1.0f;
    const float size = std::sqrt(rotation.w * rotation.w + part * part);
    const float scale = size >= 1e-6f ? sign / size : 0.0f;  // 0 if the second rotation is half a turn
    const float c = size >= 1e-6f ? scale * rotation.w : 1.0f, s = scale * part;
    const float x = sign * dot(vector, joint.hinge() ? joint.side : joint.axis);
    const float y = sign * dot(vector, joint.hinge() ? joint.bone : joint.side);
    if (joint.hinge()) return {{c, s}, c * x - s * y, c * y + s * x, size};
    return {{c, s}, c * x + s * y, c * y - s * x, size};
}

/// angle / sin(angle / 2) of a swing, from cosine and squared sine of its half-angle, without arc functions.
/// With y the squared sine of a quarter of the angle, angle^2 = 16 y (asin(sqrt y))^2 / y; the polynomial
/// approximates that quotient for 0 <= y <= 1/2, to 5e-7, by interpolation at Chebyshev points.
float angle_per_sine(float cosine, float squared_sine) noexcept {
    const float inverse = 1.0f / (1.0f + cosine), y = 0.5f * squared_sine * inverse;
    float p = 0.28755694f;
    for (const float c : {-0.15858506f, 0.16761763f, 0.09793333f, 0.17920389f, 0.33328774f, 1.0000002f}) {
        p = p * y + c;
    }
    return std::sqrt(8.0f * p * inverse);
}

/// The point of an ellipse nearest to (x, y), which lies outside; all numbers positive or zero, the half-axes
/// positive. It is (a a x / (t + a a), b b y / (t + b b)) for the one t >= 0 that puts it on the ellipse.
/// Newton's method on one over the distance from the centre (in units of the ellipse), which is nearly linear
/// in t: two or three steps are enough (More and Sorensen 1983).
void nearest_on_ellipse(float a, float b, float& x, float& y) noexcept {
    float t = std::max({a * x - a * a, b * y - b * b, 0.0f}), scale = 1.0f, u = 0.0f, v = 0.0f;
    for (int i = 0; i < 10; ++i) {
        const float p = 1.0f / (t + a * a), q = 1.0f / (t + b * b);
        u = a * x * p, v = b * y * q;
        const float squared = u * u + v * v, size = std::sqrt(squared);
        scale = 1.0f / size;
        if (size < 1.0f + 1e-5f) break;
        t += (size - 1.0f) * squared / (u * u * p + v * v * q);
    }
    x = a * u * scale;
    y = b * v * scale;
}

struct Swing {
    float up, left;
};

float half_axis_up(const LimitedJoint& joint, const Swing& swing) noexcept {
    return swing.up >= 0.0f ? joint.up : joint.down;
}
float half_axis_left(const LimitedJoint& joint, const Swing& swing) noexcept {
    return swing.left >= 0.0f ? joint.left : joint.right;
}

/// The nearest swing in the cone.
Swing within_cone(const LimitedJoint& joint, const Swing& swing) noexcept {
    const float a = half_axis_up(joint, swing), b = half_axis_left(joint, swing);
    float x = std::abs(swing.up), y = std::abs(swing.left);
    if (a < min_freedom || b < min_freedom) {
        x = a < min_freedom ? 0.0f : std::min(x, a);
        y = b < min_freedom ? 0.0f : std::min(y, b);
    } else if ((x / a) * (x / a) + (y / b) * (y / b) > 1.0f) {
        nearest_on_ellipse(a, b, x, y);
    }
    return {swing.up >= 0.0f ? x : -x, swing.left >= 0.0f ? y : -y};
}

/// Signed excess of an angle over a range, the shorter way round the circle; negative below the range.
float over(float angle, float min, float max) noexcept {
    if (angle >= min && angle <= max) return 0.0f;
    const float above = angle > max ? angle - max : angle - max + 2.0f * pi;
    const float below = angle < min ? min - angle : min - angle + 2.0f * pi;
    return above <= below ? above : -below;
}

float clamped(float angle, float min, float max) noexcept {
    const float by = over(angle, min, max);
    return by > 0.0f ? max : by < 0.0f ? min : angle;
}

/// Applies twist first, then swing.
glm::quat joined(const LimitedJoint& joint, const Split& parts) noexcept {
    const float a = parts.first, b = parts.second, c = parts.about.cosine, s = parts.about.sine;
    const glm::vec3 vector = plus(plus(times(joint.axis, a * c - b * s), times(joint.side, b * c + a * s)),
                                  times(joint.bone, parts.cosine * s));
    return {parts.cosine * c, vector.x, vector.y, vector.z};
}

void set_swing(Split& parts, const Swing& swing) noexcept {
    const float angle = std::sqrt(swing.up * swing.up + swing.left * swing.left);
    const float scale = angle < 1e-6f ? 0.5f : math::sine(0.5f * angle) / angle;
    parts.first = swing.up * scale;
    parts.second = swing.left * scale;
    parts.cosine = math::cosine(0.5f * angle);
}

Swing swing_of(const Split& parts) noexcept {
    const float squared = parts.first * parts.first + parts.second * parts.second;
    const float scale = angle_per_sine(parts.cosine, squared);
    return {parts.first * scale, parts.second * scale};
}

/// The rotation axis, in the parent's frame, that moves the swing along (up, left) fastest.
glm::vec3 axis_along(const LimitedJoint& joint, const Split& parts, float up, float left) noexcept {
    const float squared = parts.first * parts.first + parts.second * parts.second;
    const glm::vec3 plain = plus(times(joint.axis, up), times(joint.side, left));
    if (squared < 1e-10f) return plain;
    const float sine = std::sqrt(squared), x = parts.first / sine, y = parts.second / sine;
    const float out = up * x + left * y, round = left * x - up * y;  // along the swing, and across it
    const glm::vec3 about = plus(times(joint.axis, x), times(joint.side, y)),
                    ahead = minus(times(joint.side, x), times(joint.axis, y));
    const float angle = angle_per_sine(parts.cosine, squared) * sine;
    const float s = 2.0f * sine * parts.cosine, c = 1.0f - 2.0f * squared;  // of the full angle
    const glm::vec3 across = times(minus(times(ahead, c), times(joint.bone, s)), round * angle / s);
    const glm::vec3 axis = plus(times(about, out), across);
    return times(axis, 1.0f / length(axis));
}

void add_swing_bounds(const LimitedJoint& joint, const Split& parts, Bounds& bounds) noexcept {
    const Swing swing = swing_of(parts);
    const float a = half_axis_up(joint, swing), b = half_axis_left(joint, swing);
    const auto add = [&](float up, float left, bool both) {
        bounds.add(axis_along(joint, parts, up, left), both);
    };
    const auto add_edges = [&](float angle, float positive, float negative, float up, float left) {
        const bool over = angle >= positive - at_bound, under = -angle >= negative - at_bound;
        if (over || under) add(over ? up : -up, over ? left : -left, over && under);
    };
    if (a >= min_freedom && b >= min_freedom) {
        const float x = swing.up / a, y = swing.left / b, size = std::sqrt(x * x / (a * a) + y * y / (b * b));
        if (x * x + y * y > 1.0f - 2.0f * at_bound) return add(x / (a * size), y / (b * size), false);
    }
    // Quadrants without range have edges instead of a rim.
    if (a < min_freedom || b < min_freedom || std::min(joint.up, joint.down) < min_freedom) {
        add_edges(swing.up, joint.up, joint.down, 1.0f, 0.0f);
    }
    if (a < min_freedom || b < min_freedom || std::min(joint.left, joint.right) < min_freedom) {
        add_edges(swing.left, joint.left, joint.right, 0.0f, 1.0f);
    }
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
    // A free joint's axis is unused, so any will do.
    joint.axis = size > 0.0f ? times(across, 1.0f / size) : perpendicular(joint.bone);
    joint.side = cross(joint.axis, joint.bone);
    joint.min = limit.min, joint.max = limit.max;
    joint.up = limit.up, joint.down = limit.down, joint.left = limit.left, joint.right = limit.right;
    joint.twist_min = limit.twist_min, joint.twist_max = limit.twist_max;
    joint.low = half_of(joint.hinge() ? limit.min : limit.twist_min);
    joint.high = half_of(joint.hinge() ? limit.max : limit.twist_max);
    return joint;
}

LimitedJoint solvable_joint(const Limit& limit, const glm::vec3& rest_direction) noexcept {
    LimitedJoint joint = limited_joint(limit, rest_direction);
    float minimum = std::min({joint.up, joint.down, joint.left, joint.right});
    if (minimum >= pi - at_bound && joint.twist_max - joint.twist_min >= 2.0f * pi - at_bound) {
        joint.kind = joint.hinge() ? joint.kind : JointKind::Free;
    }
    constexpr float maximum = pi - 0.02f;
    for (float* angle : {&joint.up, &joint.down, &joint.left, &joint.right})
        *angle = std::min(*angle, maximum);
    const float sine = math::sine(0.5f * std::max(std::min(minimum, maximum) - 2.0f * at_bound, 0.0f));
    joint.round = sine * sine;
    return joint;
}

JointAngles angles_of(const LimitedJoint& joint, const glm::quat& rotation) noexcept {
    const Split parts = split(joint, rotation);
    const Swing swing = swing_of(parts);
    const float about = 2.0f * math::arctangent(parts.about.sine, parts.about.cosine);
    return joint.hinge() ? JointAngles{about, swing.up, swing.left}
                         : JointAngles{swing.up, swing.left, about};
}

glm::quat rotation_of(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    if (joint.hinge()) return rotation_about(joint.axis, angles.up);
    Split parts{};
    parts.about = {math::cosine(0.5f * angles.twist), math::sine(0.5f * angles.twist)};
    set_swing(parts, {angles.up, angles.left});
    return joined(joint, parts);
}

JointAngles within(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    if (joint.free()) return angles;
    if (joint.hinge()) return {clamped(angles.up, joint.min, joint.max), 0.0f, 0.0f};
    const Swing swing = within_cone(joint, {angles.up, angles.left});
    return {swing.up, swing.left, clamped(angles.twist, joint.twist_min, joint.twist_max)};
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

bool is_at_limit(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    return bounds_of(joint, rotation_of(joint, angles)).count > 0;
}

bool clamp_cone(const LimitedJoint& joint, glm::quat& rotation, float slack) noexcept {
    Split parts = split(joint, rotation);
    const bool twisted = !in_range(joint, parts.about, 0.5f * slack);
    bool swung = parts.first * parts.first + parts.second * parts.second > joint.round;
    if (swung) {
        const Swing swing = swing_of(parts), inside = within_cone(joint, swing);
        const float up = swing.up - inside.up, left = swing.left - inside.left;
        swung = up * up + left * left > slack * slack;
        if (swung) set_swing(parts, inside);
    }
    if (!swung && !twisted) return false;
    if (twisted) parts.about = nearer_bound(joint, parts.about);
    rotation = joined(joint, parts);
    return true;
}

Bounds bounds_of(const LimitedJoint& joint, const glm::quat& rotation) noexcept {
    Bounds bounds;
    if (joint.free()) return bounds;
    const Split parts = split(joint, rotation);
    const bool whole =
        (joint.hinge() ? joint.max - joint.min : joint.twist_max - joint.twist_min) >= 2.0f * pi - at_bound;
    const bool over = !whole && beyond(parts.about, joint.high) >= -0.5f * at_bound;
    const bool under = !whole && beyond(joint.low, parts.about) >= -0.5f * at_bound;
    if (over || under) {
        glm::vec3 axis = joint.axis;
        if (!joint.hinge()) {  // changing only the twist rotates about the bisector of the bone and its rest
            axis = plus(joint.bone, rotated(rotation, joint.bone));
            axis = times(axis, 1.0f / length(axis));
        }
        bounds.add(over ? axis : times(axis, -1.0f), over && under);
    }
    if (!joint.hinge() && parts.first * parts.first + parts.second * parts.second >= joint.round) {
        add_swing_bounds(joint, parts, bounds);
    }
    return bounds;
}

}  // namespace tendril::ik::detail
