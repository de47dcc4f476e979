// Capsules fitted to a mesh.
#include <algorithm>
#include <cmath>

#include "humanoid/anatomy.hpp"
#include "humanoid/limb.hpp"
#include "rig/math.hpp"
#include "tendril/humanoid/capsules.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;

constexpr std::size_t min_points = 16;   // points
constexpr double min_inside_part = 0.8;  // fraction of the points that must be within the radius
/// Fraction of the points ignored at each end of the line, and at each side when centring it.
constexpr double at_ends = 0.02, at_sides = 0.15;
/// Minimum and maximum radius of a fit, and its maximum distance from the bone, in radii of the default.
constexpr double min_radius = 0.4, max_radius = 3.0, max_offset = 0.75;
/// Maximum extent of the line of a head or a hand before and beyond the bone, in radii of the default.
constexpr double before = 2.0, beyond = 4.0;

/// The value with `part` of the values below it. Reorders them.
double quantile(std::vector<double>& values, double part) {
    const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

struct Line {
    glm::dvec3 from, direction;
    double along(const glm::dvec3& point) const noexcept { return dot(minus(point, from), direction); }
    double off(const glm::dvec3& point) const noexcept {
        return length(across(minus(point, from), direction));
    }
};

/// The line moved to the middle of the points' cross-section; unchanged if that is further away than `most`.
Line centred(const Line& line, const Facing& facing, const std::vector<glm::dvec3>& points, double most) {
    Line moved = line;
    // Bodies are symmetric left and right, and arms also above and below: centre along these directions.
    const glm::dvec3 aside = direction_of(across(facing.left, line.direction), 0.5)
                                 .value_or(direction_of(across(facing.up, line.direction), 1e-6)
                                               .value_or(perpendicular(line.direction)));
    std::vector<double> values(points.size());
    for (const glm::dvec3& way : {aside, cross(line.direction, aside)}) {
        std::transform(points.begin(), points.end(), values.begin(),
                       [&](const glm::dvec3& point) { return dot(minus(point, line.from), way); });
        const double middle = 0.5 * (quantile(values, at_sides) + quantile(values, 1.0 - at_sides));
        moved.from = plus(moved.from, times(way, middle));
    }
    return length(minus(moved.from, line.from)) <= most ? moved : line;
}

std::optional<PlacedCapsule> fitted(const PlacedCapsule& usual, const Facing& facing, bool ends_free,
                                    const std::vector<glm::dvec3>& points) {
    const double bone = length(minus(usual.to, usual.from));
    if (points.size() < min_points || !(bone > 1e-6) || !(usual.radius > 0.0)) return std::nullopt;
    const Line line = centred({usual.from, times(minus(usual.to, usual.from), 1.0 / bone)}, facing, points,
                              max_offset * usual.radius);
    std::vector<double> places, offs;
    for (const glm::dvec3& point : points) places.push_back(line.along(point));
    double low = quantile(places, at_ends), high = quantile(places, 1.0 - at_ends);
    if (ends_free)
        low = std::max(low, -before * usual.radius), high = std::min(high, bone + beyond * usual.radius);
    else
        low = std::clamp(low, 0.0, 0.5 * bone), high = std::clamp(high, 0.5 * bone, bone);
    for (const glm::dvec3& point : points)
        if (const double place = line.along(point); place >= low && place <= high)
            offs.push_back(line.off(point));
    if (offs.size() < min_points) return std::nullopt;
    const double radius = quantile(offs, min_inside_part);
    if (!(radius >= min_radius * usual.radius && radius <= max_radius * usual.radius)) return std::nullopt;
    if (ends_free) {  // the caps at the ends reach as far as the points
        const double middle = 0.5 * (low + high);
        low = std::min(low + radius, middle), high = std::max(high - radius, middle);
    }
    return PlacedCapsule{plus(line.from, times(line.direction, low)),
                         plus(line.from, times(line.direction, high)), radius};
}

/// For each node, its bone or its nearest mapped ancestor's bone.
std::vector<std::optional<Bone>> bones_of_nodes(const Skeleton& skeleton, const BoneMap& map) {
    std::vector<std::optional<Bone>> bones(skeleton.size());
    for (const std::int32_t each : skeleton.order()) {
        const auto node = static_cast<std::size_t>(each);
        bones[node] = detail::bone_of(map, each);
        if (!bones[node] && skeleton[node].parent >= 0)
            bones[node] = bones[static_cast<std::size_t>(skeleton[node].parent)];
    }
    return bones;
}

bool is_near(const glm::dvec3& point) noexcept {
    constexpr double far = static_cast<double>(max_magnitude);
    return std::abs(point.x) <= far && std::abs(point.y) <= far && std::abs(point.z) <= far;
}

}  // namespace

std::vector<BodyCapsule> fitted_capsules(const Skeleton& skeleton, const BoneMap& map,
                                         std::span<const SkinPoint> points) {
    std::vector<BodyCapsule> capsules = default_capsules(skeleton, map);
    const std::vector<std::optional<Bone>> bones = bones_of_nodes(skeleton, map);
    std::array<std::vector<glm::dvec3>, bone_count> of_bone{};
    for (const SkinPoint& point : points)
        if (point.node < bones.size() && bones[point.node] && is_near(point.position))
            of_bone[static_cast<std::size_t>(*bones[point.node])].push_back(point.position);
    std::vector<Placement> rest(skeleton.size());
    place(skeleton, rest_pose(skeleton), rest);
    const Facing at_rest = facing(skeleton, map);
    for (BodyCapsule& capsule : capsules) {
        const Placement& at = rest[static_cast<std::size_t>(map[capsule.bone].node)];
        if (!(std::abs(dot(at.axes[0], cross(at.axes[1], at.axes[2]))) > 1e-30)) continue;
        const bool ends_free =
            capsule.bone == Bone::Head || capsule.bone == Bone::LeftHand || capsule.bone == Bone::RightHand;
        const auto fit = fitted(place(capsule, map, rest), at_rest, ends_free,
                                of_bone[static_cast<std::size_t>(capsule.bone)]);
        if (!fit) continue;
        capsule.from = detail::to_local(at, minus(fit->from, at.position));
        capsule.to = detail::to_local(at, minus(fit->to, at.position));
        capsule.radius = fit->radius;
    }
    return capsules;
}

}  // namespace tendril::humanoid
