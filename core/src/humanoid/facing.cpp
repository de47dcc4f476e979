#include "humanoid/facing.hpp"

#include <cmath>
#include <vector>

#include "humanoid/input.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {

using namespace rig::detail;

namespace detail {
namespace {

constexpr Bone legs[2][3]{{Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot},
                          {Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot}};

/// The vector from one bone to another; 0 if either is not mapped.
glm::dvec3 way(const BoneMap& map, std::span<const Placement> rest, Bone from, Bone to) {
    const std::int32_t a = map[from].node, b = map[to].node;
    if (a < 0 || b < 0) return glm::dvec3(0.0);
    return minus(rest[static_cast<std::size_t>(b)].position, rest[static_cast<std::size_t>(a)].position);
}

/// True if the feet clearly point backwards: an ankle slightly in front of its toe tip is not enough.
bool feet_point_back(const Skeleton& skeleton, const BoneMap& map, std::span<const Placement> rest,
                     const glm::dvec3& forward) {
    double ahead = 0.0, leg = 0.0;
    for (const auto& [upper, lower, foot] : legs) {
        if (map[foot].node < 0) continue;
        const auto node = static_cast<std::size_t>(map[foot].node);
        const glm::dvec3& toes = rest[farthest_below(skeleton, rest, node)].position;
        ahead += dot(minus(toes, rest[node].position), forward);
        leg += 0.5 * (length(way(map, rest, upper, lower)) + length(way(map, rest, lower, foot)));
    }
    return ahead < -0.1 * leg;
}

}  // namespace

std::optional<Facing> find_facing(const Skeleton& skeleton, const BoneMap& map,
                                  std::span<const Placement> rest) {
    const glm::dvec3 across = plus(way(map, rest, Bone::RightUpperLeg, Bone::LeftUpperLeg),
                                   way(map, rest, Bone::RightUpperArm, Bone::LeftUpperArm));
    const auto left = direction_of(glm::dvec3(across.x, 0.0, across.z), 1e-6);
    if (!left) return std::nullopt;
    Facing result{.left = *left};
    result.forward = cross(result.left, result.up);
    if (feet_point_back(skeleton, map, rest, result.forward)) result.forward = times(result.forward, -1.0);
    return result;
}

std::size_t farthest_below(const Skeleton& skeleton, std::span<const Placement> rest, std::size_t node) {
    std::size_t farthest = node;
    double most = 0.0;
    for (std::size_t i = 0; i < skeleton.size(); ++i) {
        if (i == node || !skeleton.is_below(i, node)) continue;
        const glm::dvec3 away = minus(rest[i].position, rest[node].position);
        const double level = std::sqrt(away.x * away.x + away.z * away.z);
        if (level > most) most = level, farthest = i;
    }
    return farthest;
}

}  // namespace detail

Facing facing(const Skeleton& skeleton, const BoneMap& map) {
    std::vector<Placement> rest(skeleton.size());
    place(skeleton, rest_pose(skeleton), rest);
    return detail::find_facing(skeleton, detail::map_or_none(map, skeleton), rest).value_or(Facing());
}

}  // namespace tendril::humanoid
