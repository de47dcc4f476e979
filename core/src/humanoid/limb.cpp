#include "humanoid/limb.hpp"

#include <algorithm>

namespace tendril::humanoid::detail {
namespace {

using namespace rig::detail;

constexpr double shortest = 1e-9;

Placement placed(const Limb& limb, std::size_t from, std::size_t to, Placement at, Pose pose) noexcept {
    for (std::size_t i = from; i < to; ++i) at = at * placement(pose[limb.node(i)]);
    return at;
}

glm::dvec3 direction(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& fallback) noexcept {
    return direction_of(minus(to, from), shortest).value_or(fallback);
}

/// The direction of the middle joint, perpendicular to the line from root to end. It is blended with the
/// pole, the more so the nearer the joint is to the line. With pole.always, never against the pole.
glm::dvec3 bend_direction(const LimbPlacement& at, const glm::dvec3& line, const Pole& pole) noexcept {
    const glm::dvec3 side = direction_of(across(pole.direction, line), 1e-6).value_or(perpendicular(line));
    glm::dvec3 aside = across(minus(at.lower.position, at.upper.position), line);
    if (pole.always) aside = plus(aside, times(side, std::max(0.0, -dot(aside, side))));
    const double part = pole.part * (at.upper_length() + at.lower_length());
    return direction_of(plus(aside, times(side, part)), shortest).value_or(side);
}

}  // namespace

std::optional<Limb> Limb::make(const Skeleton& skeleton, std::int32_t upper, std::int32_t lower,
                               std::int32_t end, std::int32_t tail) {
    Limb made;
    for (std::int32_t node = tail; node >= 0; node = skeleton[static_cast<std::size_t>(node)].parent)
        made.path.push_back(node);
    std::reverse(made.path.begin(), made.path.end());
    const auto place_of = [&](std::int32_t node) {
        return static_cast<std::size_t>(std::find(made.path.begin(), made.path.end(), node) -
                                        made.path.begin());
    };
    made.upper = place_of(upper), made.lower = place_of(lower), made.end = place_of(end);
    made.tail = place_of(tail);
    if (upper < 0 || tail < 0 || made.upper >= made.lower || made.lower >= made.end || made.end > made.tail)
        return std::nullopt;
    return made;
}

void LimbPlacement::move(const glm::dvec3& by) noexcept {
    for (Placement* each : {&above_upper, &upper, &above_lower, &lower, &above_end, &end, &tail})
        each->position = plus(each->position, by);
}
double LimbPlacement::upper_length() const noexcept {
    return length(minus(lower.position, upper.position));
}
double LimbPlacement::lower_length() const noexcept {
    return length(minus(end.position, lower.position));
}
bool LimbPlacement::is_finite() const noexcept {
    return is_moderate(upper) && is_moderate(lower) && is_moderate(end) && is_moderate(tail);
}

LimbPlacement place(const Limb& limb, const Placement& root, Pose pose) noexcept {
    LimbPlacement at;
    at.above_upper = placed(limb, 0, limb.upper, root, pose);
    place_below(limb, at, pose);
    return at;
}

void place_below(const Limb& limb, LimbPlacement& at, Pose pose) noexcept {
    at.upper = at.above_upper * placement(pose[limb.node(limb.upper)]);
    at.above_lower = placed(limb, limb.upper + 1, limb.lower, at.upper, pose);
    at.lower = at.above_lower * placement(pose[limb.node(limb.lower)]);
    at.above_end = placed(limb, limb.lower + 1, limb.end, at.lower, pose);
    at.end = at.above_end * placement(pose[limb.node(limb.end)]);
    at.tail = placed(limb, limb.end + 1, limb.tail + 1, at.end, pose);
}

bool is_moderate(const Placement& p) noexcept {
    const auto fine = [](const glm::dvec3& v) {
        return std::abs(v.x) <= 1e12 && std::abs(v.y) <= 1e12 && std::abs(v.z) <= 1e12;
    };
    return fine(p.position) && fine(p.axes[0]) && fine(p.axes[1]) && fine(p.axes[2]);
}

glm::dvec3 to_local(const Placement& at, const glm::dvec3& v) noexcept {
    const glm::dvec3 &x = at.axes[0], &y = at.axes[1], &z = at.axes[2];
    const double volume = dot(x, cross(y, z));
    if (!(std::abs(volume) > 1e-200 && std::abs(volume) < 1e200)) return glm::dvec3(0.0);
    const glm::dvec3 parts{dot(cross(y, z), v), dot(cross(z, x), v), dot(cross(x, y), v)};
    return times(parts, 1.0 / volume);
}

void turn(rig::Transform& local, const Placement& above, const glm::dquat& by) noexcept {
    const glm::dvec3 axis{by.x, by.y, by.z};
    const double sine = length(axis);
    if (sine == 0.0) return;
    // The axis in the parent's space, by the adjugate, which has the right sign even for a mirrored parent.
    const glm::dvec3 &x = above.axes[0], &y = above.axes[1], &z = above.axes[2];
    const glm::dvec3 seen{dot(cross(y, z), axis), dot(cross(z, x), axis), dot(cross(x, y), axis)};
    const double size = length(seen);
    if (!(size > 1e-200)) return;
    const glm::dvec3 v = times(seen, sine / size);
    local.rotation = rig::normalised(math::compose(glm::dquat{by.w, v.x, v.y, v.z}, local.rotation));
}

Reach reach_of(const LimbPlacement& at, double straightest) noexcept {
    const double a = at.upper_length(), b = at.lower_length();
    const double longest = straightest * (a + b);
    return {std::min(longest, 1.001 * std::abs(a - b) + 0.05 * std::min(a, b)), longest};
}

Bend bend_to(const LimbPlacement& at, const glm::dvec3& target, const Pole& pole,
             double straightest) noexcept {
    const glm::dvec3 root = at.upper.position;
    const glm::dvec3 from = direction(root, at.end.position, perpendicular(pole.direction));
    const glm::dvec3 to = direction(root, target, from);
    const double a = at.upper_length(), b = at.lower_length();
    if (!(a > shortest && b > shortest)) {
        const glm::dquat none{1.0, 0.0, 0.0, 0.0};
        return {at.lower.position, at.end.position, none, none};
    }
    const auto [near, far] = reach_of(at, straightest);
    const double d = std::clamp(length(minus(target, root)), near, far);
    const glm::dquat whole = minimal_rotation(from, to);
    const glm::dvec3 bend = rotated(whole, bend_direction(at, from, pole));
    const double along = (d * d + a * a - b * b) / (2.0 * d);
    const double aside = std::sqrt(std::max(a * a - along * along, 0.0));
    Bend result;
    result.mid = plus(root, plus(times(to, along), times(bend, aside)));
    result.end = plus(root, times(to, d));

    const auto turn_of = [&](const glm::dvec3& before, const glm::dvec3& after, const glm::dvec3& start,
                             const glm::dvec3& stop) {
        const glm::dvec3 was = rotated(whole, direction(before, after, from));
        return math::compose(minimal_rotation(was, direction(start, stop, to)), whole);
    };
    result.upper = turn_of(at.upper.position, at.lower.position, root, result.mid);
    result.lower = turn_of(at.lower.position, at.end.position, result.mid, result.end);
    return result;
}

void apply(const Bend& bend, const glm::dquat& end_turn, const Limb& limb, LimbPlacement& at,
           Pose pose) noexcept {
    turn(pose[limb.node(limb.upper)], at.above_upper, bend.upper);
    place_below(limb, at, pose);
    turn(pose[limb.node(limb.lower)], at.above_lower, math::compose(bend.lower, conjugate(bend.upper)));
    place_below(limb, at, pose);
    turn(pose[limb.node(limb.end)], at.above_end, math::compose(end_turn, conjugate(bend.lower)));
    place_below(limb, at, pose);
}

}  // namespace tendril::humanoid::detail
