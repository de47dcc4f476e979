// Limits as user input: presets, validation, a joint's angles.
#include "tendril/ik/limit.hpp"

#include <cmath>

#include "ik/limits/joint.hpp"
#include "ik/math.hpp"
#include "tendril/ik/plane.hpp"

namespace tendril::ik {
namespace {

using detail::pi;

constexpr float degrees(float angle) noexcept {
    return angle * (pi / 180.0f);
}

constexpr float largest_angle = pi + 1e-6f;  ///< allows for pi rounded as double or float

bool is_angle(float angle) noexcept {
    return angle >= -largest_angle && angle <= largest_angle;
}

bool is_half_angle(float angle) noexcept {
    return angle >= 0.0f && angle <= largest_angle;
}

Limit cone(JointKind kind, float up, float down, float left, float right, float twist) noexcept {
    Limit limit;
    limit.kind = kind;
    limit.up = degrees(up), limit.down = degrees(down);
    limit.left = degrees(left), limit.right = degrees(right);
    limit.twist_min = degrees(-twist), limit.twist_max = degrees(twist);
    return limit;
}

const char* fault_of_hinge(const Limit& limit) noexcept {
    if (!is_angle(limit.min)) return "the hinge's min must be from -180 to 180 degrees";
    if (!is_angle(limit.max)) return "the hinge's max must be from -180 to 180 degrees";
    if (limit.min > limit.max) return "the hinge's min is over its max";
    return nullptr;
}

const char* fault_of_cone(const Limit& limit) noexcept {
    if (!is_half_angle(limit.up)) return "up must be from 0 to 180 degrees";
    if (!is_half_angle(limit.down)) return "down must be from 0 to 180 degrees";
    if (!is_half_angle(limit.left)) return "left must be from 0 to 180 degrees";
    if (!is_half_angle(limit.right)) return "right must be from 0 to 180 degrees";
    if (!is_angle(limit.twist_min)) return "twist_min must be from -180 to 180 degrees";
    if (!is_angle(limit.twist_max)) return "twist_max must be from -180 to 180 degrees";
    if (limit.twist_min > limit.twist_max) return "twist_min is over twist_max";
    return nullptr;
}

}  // namespace

Limit Limit::of(JointKind kind) noexcept {
    switch (kind) {
        case JointKind::Free:
            break;
        case JointKind::Suture:
            return cone(kind, 1, 1, 0, 0, 0);
        case JointKind::Hinge:
            return hinge({0.0f, 0.0f, 1.0f}, 0.0f, degrees(145));  // elbow
        case JointKind::Gliding:
            return cone(kind, 35, 35, 20, 30, 0);  // half a wrist
        case JointKind::Saddle:
            return cone(kind, 60, 25, 50, 25, 0);  // thumb
        case JointKind::Pivot:
            return cone(kind, 15, 15, 5, 5, 80);  // neck
        case JointKind::BallAndSocket:
            return cone(kind, 120, 30, 45, 30, 45);  // hip
    }
    return {};
}

Limit Limit::hinge(glm::vec3 axis, float min, float max) noexcept {
    Limit limit;
    limit.kind = JointKind::Hinge;
    limit.axis = axis;
    limit.min = min;
    limit.max = max;
    return limit;
}

const char* fault(const AngleLimit& limit) noexcept {
    if (!is_angle(limit.min)) return "min must be from -180 to 180 degrees";
    if (!is_angle(limit.max)) return "max must be from -180 to 180 degrees";
    if (limit.min > limit.max) return "min is over max";
    return limit.from <= AngleFrom::Base ? nullptr : "from must be bone or base";
}

const char* fault(const Limit& limit) noexcept {
    if (static_cast<unsigned>(limit.kind) > static_cast<unsigned>(JointKind::BallAndSocket)) {
        return "there is no such kind of joint";
    }
    if (!(limit.stiffness >= 0.0f && limit.stiffness <= max_stiffness))
        return "stiffness must be from 0 to 0.99";
    if (limit.kind == JointKind::Free) return nullptr;
    const bool hinge = limit.kind == JointKind::Hinge;
    const auto beyond = [](float x) { return !(std::abs(x) <= 1e9f); };  // true for NaN
    if (beyond(limit.axis.x) || beyond(limit.axis.y) || beyond(limit.axis.z)) {
        return hinge ? "the hinge's axis is not finite" : "the limit's axis is not finite";
    }
    if (!(detail::length(limit.axis) > 1e-6f)) {
        return hinge ? "the hinge's axis has no length" : "the limit's axis has no length";
    }
    return hinge ? fault_of_hinge(limit) : fault_of_cone(limit);
}

const char* fault(const Limit& limit, glm::vec3 rest_direction) noexcept {
    if (const char* wrong = fault(limit)) return wrong;
    if (limit.kind == JointKind::Free) return nullptr;
    const float size = detail::length(rest_direction);
    if (!(size > 1e-6f) || !(size <= 3e9f)) return "the bone has no direction at rest";
    const glm::vec3 across = detail::across_of(limit, detail::times(rest_direction, 1.0f / size));
    if (detail::length(across) > 0.0f) return nullptr;
    return limit.kind == JointKind::Hinge ? "the hinge's axis lies along the bone"
                                          : "the limit's axis lies along the bone";
}

JointAngles measure(const Limit& limit, glm::vec3 rest_direction, glm::quat rotation) noexcept {
    return detail::angles_of(detail::limited_joint(limit, rest_direction), rotation);
}

float excess(const Limit& limit, const JointAngles& angles) noexcept {
    return detail::excess_of(detail::limited_joint(limit, detail::perpendicular(limit.axis)), angles);
}

}  // namespace tendril::ik
