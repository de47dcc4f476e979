#include "tendril/rope/hair_roots.hpp"

#include <cmath>

#include "math/checks.hpp"
#include "math/vector.hpp"
#include "tendril/elementary.hpp"

namespace tendril::rope {
namespace {

/// The patch's direction, or `fallback` if it has none; unit.
Expected<glm::vec3> direction_of(const HairPatch& patch, glm::vec3 fallback) {
    const glm::vec3 direction = patch.direction.value_or(fallback);
    const float length = math::length(direction);
    if (length > 0.0f && std::isfinite(length)) return direction / length;
    return tendril::detail::refused("hair", "direction", "of finite length over 0", length);
}

/// A point of the patch: distance and direction from its centre.
struct PatchPoint {
    float distance = 0.0f;
    glm::vec3 outwards{1.0f, 0.0f, 0.0f};  ///< unit, perpendicular to the direction
};

std::vector<PatchPoint> patch_points(const HairPatch& patch, glm::vec3 direction) {
    constexpr float golden_angle = 2.3999632f;
    const glm::vec3 across = std::abs(direction.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 side = math::cross(direction, across);
    const glm::vec3 first = math::times(side, 1.0f / math::length(side));
    const glm::vec3 second = math::cross(direction, first);
    std::vector<PatchPoint> found;
    found.reserve(static_cast<std::size_t>(patch.strands));
    for (int i = 0; i < patch.strands; ++i) {
        const float part = (static_cast<float>(i) + 0.5f) / static_cast<float>(patch.strands);
        const float angle = golden_angle * static_cast<float>(i);
        found.push_back(
            {patch.spread * std::sqrt(part), math::cosine(angle) * first + math::sine(angle) * second});
    }
    return found;
}

}  // namespace

Expected<std::vector<HairRoot>> roots_around(const HairPatch& patch) {
    if (const Result bad = check_fields("hair", patch); !bad) return bad;
    const Expected<glm::vec3> given = direction_of(patch, glm::vec3(0, -1, 0));
    if (!given) return given.error();
    const glm::vec3 direction = *given;
    std::vector<HairRoot> roots;
    for (const PatchPoint& point : patch_points(patch, direction))
        roots.push_back({patch.centre + point.distance * point.outwards, direction});
    return roots;
}

Expected<std::vector<HairRoot>> roots_on(const Shape& shape, const HairPatch& patch, float lift) {
    if (const Result bad = check_fields("hair", patch); !bad) return bad;
    const auto* plane = std::get_if<Plane>(&shape);
    const glm::vec3 fallback = plane != nullptr ? plane->normal : glm::vec3(0, 1, 0);
    const Expected<glm::vec3> given = direction_of(patch, fallback);
    if (!given) return given.error();
    const glm::vec3 direction = *given;
    const glm::vec3 middle = centre(shape);
    const float ball = plane != nullptr ? 0.0f : size(shape);
    std::vector<HairRoot> roots;
    for (const PatchPoint& point : patch_points(patch, direction)) {
        // Along an arc on a ball of the collider's size, and from there to its surface.
        const float angle = ball > 0.0f ? point.distance / ball : 0.0f;
        const glm::vec3 from =
            ball > 0.0f
                ? middle + ball * (math::cosine(angle) * direction + math::sine(angle) * point.outwards)
                : middle + point.distance * point.outwards;
        const SurfaceDistance surface = surface_distance(shape, from);
        const glm::vec3 normal(surface.normal);
        roots.push_back({from + (lift - static_cast<float>(surface.distance)) * normal, normal});
    }
    return roots;
}

}  // namespace tendril::rope
