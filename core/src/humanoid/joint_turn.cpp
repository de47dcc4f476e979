#include "humanoid/joint_turn.hpp"

#include <algorithm>
#include <cmath>

#include "ik/limits/clamp.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

using math::wide;

glm::dquat exponential(const glm::dvec3& turn) noexcept {
    const double angle = length(turn);
    if (angle < 1e-9) return unit_quaternion(1.0, 0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z);
    return rotation_about(times(turn, 1.0 / angle), angle);
}
glm::dvec3 logarithm(const glm::dquat& q) noexcept {
    const double sign = q.w < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 axis{sign * q.x, sign * q.y, sign * q.z};
    const double sine = length(axis);
    if (sine < 1e-9) return times(axis, 2.0);
    return times(axis, 2.0 * arctangent(sine, sign * q.w) / sine);
}

double hinge_angle(const glm::dvec3& axis, const glm::dquat& turn) noexcept {
    const double along = dot(glm::dvec3{turn.x, turn.y, turn.z}, axis);
    return turn.w < 0.0 ? 2.0 * arctangent(-along, -turn.w) : 2.0 * arctangent(along, turn.w);
}

bool clamp_turn(Link& link, float slack) noexcept {
    if (link.limit.free()) return false;
    if (link.limit.hinge()) {
        const double angle = hinge_angle(link.hinge, link.turn);
        const double low = static_cast<double>(link.limit.min), high = static_cast<double>(link.limit.max);
        const double within = std::clamp(angle, low, high);
        if (within == angle) return false;
        link.turn = math::compose(rotation_about(link.hinge, within - angle), link.turn);
        return true;
    }
    glm::quat turn = narrow(link.turn);
    if (!ik::detail::clamp(link.limit, turn, slack)) return false;
    link.turn = wide(turn);
    return true;
}

void widen(Link& link) noexcept {
    ik::detail::LimitedJoint& limit = link.limit;
    if (limit.free()) return;
    if (limit.hinge()) {
        const auto angle = static_cast<float>(hinge_angle(link.hinge, link.clip_turn));
        limit.min = std::min(limit.min, angle), limit.max = std::max(limit.max, angle);
        return;
    }
    const glm::quat turn = narrow(link.clip_turn);
    if (ik::detail::is_inside(limit, turn)) return;
    const ik::JointAngles angles = ik::detail::angles_of(limit, turn);
    if (!(ik::detail::excess_of(limit, angles) > ik::detail::at_bound)) return;
    const float a = std::max(angles.up >= 0.0f ? limit.up : limit.down, 1e-3f);
    const float b = std::max(angles.left >= 0.0f ? limit.left : limit.right, 1e-3f);
    const float x = angles.up / a, y = angles.left / b, size = std::sqrt(x * x + y * y);
    ik::Limit wider{.kind = limit.kind, .axis = limit.axis};
    const float by = std::max(size * 1.0001f, 1.0f);
    const auto grown = [by](float half) { return std::min(std::max(half, 1e-3f) * by, ik::detail::pi); };
    wider.up = grown(limit.up), wider.down = grown(limit.down);
    wider.left = grown(limit.left), wider.right = grown(limit.right);
    wider.twist_min = std::min(limit.twist_min, angles.twist),
    wider.twist_max = std::max(limit.twist_max, angles.twist);
    limit = ik::detail::solvable_joint(wider, limit.bone);
}

void TurnFreedom::begin(const Link& link, const glm::dquat& before) noexcept {
    blocked = 0;
    if (link.limit.hinge()) hinge = rotated(before, link.hinge);
}

glm::dvec3 TurnFreedom::allowed(const Link& link, const glm::dvec3& turn) const noexcept {
    glm::dvec3 result = turn;
    if (link.limit.hinge()) result = times(hinge, dot(hinge, turn));
    for (int i = 0; i < blocked; ++i) result = across(result, outward[static_cast<std::size_t>(i)]);
    return result;
}

bool TurnFreedom::block(const glm::dvec3& direction) noexcept {
    glm::dvec3 left = direction;
    for (int i = 0; i < blocked; ++i) left = across(left, outward[static_cast<std::size_t>(i)]);
    const auto unit = direction_of(left, 1e-6);
    if (!unit || blocked == 3) return false;
    outward[static_cast<std::size_t>(blocked++)] = *unit;
    return true;
}

bool TurnFreedom::block_limit(const Link& link, const glm::dquat& turn, const glm::dquat& before,
                              const glm::dvec3& step) noexcept {
    if (link.limit.free() || blocked == 3 || dot(step, step) < 1e-24) return false;
    const glm::quat at = narrow(turn);
    if (link.limit.hinge()) {
        const double angle = hinge_angle(link.hinge, turn), by = dot(hinge, step);
        const double low = static_cast<double>(link.limit.min), high = static_cast<double>(link.limit.max);
        return ((by > 0.0 && angle >= high - 1e-6) || (by < 0.0 && angle <= low + 1e-6)) && block(hinge);
    }
    if (ik::detail::is_inside(link.limit, at)) return false;
    bool changed = false;
    const ik::detail::Bounds bounds = ik::detail::bounds_of(link.limit, at);
    for (int i = 0; i < bounds.count; ++i) {
        const glm::dvec3 out = rotated(before, math::wide(bounds.at[i].outward));
        const double by = dot(out, step);
        if (by > 1e-12 || (bounds.at[i].both && by < -1e-12)) changed |= block(out);
    }
    return changed;
}

}  // namespace tendril::humanoid::detail
