#include "ik/batch/limits.hpp"

#include <algorithm>
#include <cmath>

#include "ik/limits/joint.hpp"
#include "tendril/elementary.hpp"

namespace tendril::ik::detail {
namespace {

/// A cone with a smaller half-angle is treated as flat and left to the scalar solver.
constexpr float min_half_angle = 1e-3f;

HalfRange half_range(float min, float max) noexcept {
    const bool whole = max - min >= 2.0f * pi - at_bound;
    return {math::sine(0.5f * std::clamp(min, -pi, pi)), math::sine(0.5f * std::clamp(max, -pi, pi)), whole};
}

/// 1 / angle^2, as in solvable_joint (limits/joint.cpp): pointing straight back, neither the twist nor the
/// side of the swing is defined.
float inverse_square(float half_angle) noexcept {
    const float angle = std::min(half_angle, pi - 0.02f);
    return 1.0f / (angle * angle);
}

std::optional<BatchLimit> prepared(const Limit& limit, const glm::vec3& rest_direction) noexcept {
    if (limit.stiffness > 0.0f) return std::nullopt;
    const LimitedJoint joint = limited_joint(limit, rest_direction);
    BatchLimit to;
    to.bone = joint.bone, to.axis = joint.axis, to.side = joint.side;
    if (joint.free()) return to;
    if (joint.hinge()) {
        to.kind = BatchLimit::Kind::Hinge;
        to.range = half_range(joint.min, joint.max);
        return to;
    }
    if (std::min({joint.up, joint.down, joint.left, joint.right}) < min_half_angle) return std::nullopt;
    to.kind = BatchLimit::Kind::Cone;
    to.range = half_range(joint.twist_min, joint.twist_max);
    to.up = inverse_square(joint.up), to.down = inverse_square(joint.down);
    to.left = inverse_square(joint.left), to.right = inverse_square(joint.right);
    return to;
}

}  // namespace

BatchLimits batch_limits(std::span<const Limit> limits, std::span<const glm::vec3> rest_directions) {
    BatchLimits all;
    all.limits.assign(limits.begin(), limits.end());
    all.rest_directions.assign(rest_directions.begin(), rest_directions.end());
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const std::optional<BatchLimit> each = prepared(limits[i], rest_directions[i]);
        if (!each) {
            all.prepared.clear();
            break;
        }
        all.prepared.push_back(*each);
    }
    return all;
}

}  // namespace tendril::ik::detail
