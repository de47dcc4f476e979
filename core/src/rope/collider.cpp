#include "tendril/rope/collider.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/checks.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;
using tendril::detail::refused;

/// Distance from a core (a point or a line) of some thickness. On the core the normal is `otherwise`.
SurfaceDistance from_core(const dvec3& by, double thickness, const dvec3& otherwise) {
    const double length = detail::length(by);
    if (length < 1e-12) return {-thickness, otherwise};
    return {length - thickness, (1.0 / length) * by};
}

SurfaceDistance of(const Sphere& sphere, const dvec3& point) {
    return from_core(point - dvec3(sphere.centre), sphere.radius, {0.0, 1.0, 0.0});
}

SurfaceDistance of(const Capsule& capsule, const dvec3& point) {
    const dvec3 a(capsule.a), axis = dvec3(capsule.b) - a;
    const double squared = detail::dot(axis, axis);
    const double t = squared > 0.0 ? std::clamp(detail::dot(point - a, axis) / squared, 0.0, 1.0) : 0.0;
    const dvec3 aside = squared > 0.0 ? detail::perpendicular(axis) : dvec3(0.0, 1.0, 0.0);
    return from_core(point - (a + t * axis), capsule.radius, aside);
}

SurfaceDistance of(const Plane& plane, const dvec3& point) {
    const dvec3 normal = detail::unit(dvec3(plane.normal));
    return {detail::dot(point - dvec3(plane.point), normal), normal};
}

SurfaceDistance of(const Box& box, const dvec3& point) {
    const detail::Axes axes(box.rotation);
    const dvec3 local = axes.to_local(point - dvec3(box.centre)), half(box.half_extents);
    dvec3 beyond(0.0);
    double inside = -1e300;
    int face = 0;
    for (int i = 0; i < 3; ++i) {
        const double over = std::abs(local[i]) - half[i];
        if (over > inside) inside = over, face = i;
        beyond[i] = std::copysign(std::max(over, 0.0), local[i]);
    }
    if (const double distance = detail::length(beyond); inside > 0.0 && distance > 1e-150) {
        return {distance, axes.to_world((1.0 / distance) * beyond)};
    }
    dvec3 normal(0.0);
    normal[face] = local[face] < 0.0 ? -1.0 : 1.0;
    return {inside, axes.to_world(normal)};
}

}  // namespace

SurfaceDistance surface_distance(const Shape& shape, const dvec3& point) noexcept {
    return std::visit([&](const auto& each) { return of(each, point); }, shape);
}

glm::vec3 centre(const Shape& shape) noexcept {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->centre;
    if (const auto* capsule = std::get_if<Capsule>(&shape)) return 0.5f * capsule->a + 0.5f * capsule->b;
    if (const auto* plane = std::get_if<Plane>(&shape)) return plane->point;
    return std::get_if<Box>(&shape)->centre;
}

Shape moved(const Shape& shape, const glm::vec3& to) noexcept {
    Shape there = shape;
    if (auto* sphere = std::get_if<Sphere>(&there)) sphere->centre = to;
    if (auto* plane = std::get_if<Plane>(&there)) plane->point = to;
    if (auto* box = std::get_if<Box>(&there)) box->centre = to;
    if (auto* capsule = std::get_if<Capsule>(&there)) {
        const glm::vec3 half = 0.5f * capsule->b - 0.5f * capsule->a;
        capsule->a = to - half;
        capsule->b = to + half;
    }
    return there;
}

float size(const Shape& shape) noexcept {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
    if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius;
    if (const auto* box = std::get_if<Box>(&shape)) {
        return std::min({box->half_extents.x, box->half_extents.y, box->half_extents.z});
    }
    return 1.0f;
}

Result check(const char* operation, const Shape& shape) noexcept {
    const auto check_one = [&](const auto& each) {
        const Result checked = check_fields(operation, each);
        if constexpr (std::is_same_v<std::decay_t<decltype(each)>, Plane>)
            if (checked && !(detail::length(dvec3(each.normal)) > 1e-12))
                return refused(operation, "normal", "longer than 0", "0");
        return checked;
    };
    return std::visit(check_one, shape);
}

}  // namespace tendril::rope
