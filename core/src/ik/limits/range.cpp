#include "ik/limits/range.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::ik::detail {
namespace {

ActiveLimit exceeded_range(Bound low, Bound high, float min, float max, float angle) noexcept {
    ActiveLimit active;
    active.bound = angle > max ? high : low;
    active.limit = angle > max ? max : min;
    active.needed = angle;
    return active;
}

/// The exceeded bound among half-angles, which are reported without a sign.
ActiveLimit exceeded_half_angle(Bound positive, Bound negative, float inside, float angle) noexcept {
    ActiveLimit active;
    active.bound = angle > inside ? positive : negative;
    active.limit = std::abs(inside);
    active.needed = std::abs(angle);
    return active;
}

}  // namespace

Limit opened(Limit limit, const JointAngles& angles) noexcept {
    const bool hinge = limit.kind == JointKind::Hinge;
    float& maximum = hinge ? limit.max : limit.twist_max;
    float& minimum = hinge ? limit.min : limit.twist_min;
    const float angle = hinge ? angles.up : angles.twist;
    const bool upper = angle >= maximum - 2.0f * at_bound, lower = angle <= minimum + 2.0f * at_bound;
    if (upper) maximum = pi;
    if (lower && !upper) minimum = -pi;
    limit.up = limit.down = limit.left = limit.right = pi;
    return limit;
}

Limit mirrored(Limit limit) noexcept {
    const bool hinge = limit.kind == JointKind::Hinge;
    (hinge ? limit.max : limit.twist_max) = hinge ? limit.min : limit.twist_min;
    (hinge ? limit.min : limit.twist_min) = -pi;
    limit.up = limit.down = limit.left = limit.right = pi;
    return limit;
}

bool has_no_range(const Limit& limit) noexcept {
    const bool hinge = limit.kind == JointKind::Hinge;
    return (hinge ? limit.max - limit.min : limit.twist_max - limit.twist_min) <= 4.0f * at_bound;
}

Limit widened(Limit limit, const JointAngles& angles, float part) noexcept {
    const auto up_to = [part](float& bound, float angle) {
        bound += part * std::max(std::min(angle, pi) - bound, 0.0f);
    };
    const auto down_to = [part](float& bound, float angle) {
        bound += part * std::min(std::max(angle, -pi) - bound, 0.0f);
    };
    if (limit.kind == JointKind::Hinge) {
        up_to(limit.max, angles.up);
        down_to(limit.min, angles.up);
        return limit;
    }
    constexpr float diagonal = 1.42f;  // so that the ellipse with these half-axes contains the angles
    up_to(limit.up, diagonal * angles.up);
    up_to(limit.down, -diagonal * angles.up);
    up_to(limit.left, diagonal * angles.left);
    up_to(limit.right, -diagonal * angles.left);
    up_to(limit.twist_max, angles.twist);
    down_to(limit.twist_min, angles.twist);
    return limit;
}

ActiveLimit exceeded_bound(const LimitedJoint& joint, const JointAngles& angles) noexcept {
    if (joint.hinge()) return exceeded_range(Bound::Min, Bound::Max, joint.min, joint.max, angles.up);
    const JointAngles inside = within(joint, angles);
    const float up = std::abs(angles.up - inside.up), left = std::abs(angles.left - inside.left);
    const float twist = std::abs(angles.twist - inside.twist);
    if (twist >= up && twist >= left) {
        return exceeded_range(Bound::TwistMin, Bound::TwistMax, inside.twist, inside.twist, angles.twist);
    }
    return up >= left ? exceeded_half_angle(Bound::Up, Bound::Down, inside.up, angles.up)
                      : exceeded_half_angle(Bound::Left, Bound::Right, inside.left, angles.left);
}

}  // namespace tendril::ik::detail
