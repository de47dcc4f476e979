#include "rope/contact_shape.hpp"

#include <algorithm>
#include <limits>

#include "rope/geometry.hpp"

namespace tendril::rope::detail {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

dvec3 smaller(const dvec3& a, const dvec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
dvec3 larger(const dvec3& a, const dvec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
dvec3 absolute(const dvec3& v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// The parameter, 0 to 1, of the point of a line that is nearest to a point.
double nearest_to(const dvec3& point, const dvec3& a, const dvec3& b) {
    const dvec3 by = b - a;
    const double squared = dot(by, by);
    return squared > 0.0 ? std::clamp(dot(point - a, by) / squared, 0.0, 1.0) : 0.0;
}

}  // namespace

void bounds(const Shape& shape, const dvec3& by, dvec3& low, dvec3& high) noexcept {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        low = dvec3(sphere->centre) - dvec3(sphere->radius);
        high = dvec3(sphere->centre) + dvec3(sphere->radius);
    } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
        low = smaller(dvec3(capsule->a), dvec3(capsule->b)) - dvec3(capsule->radius);
        high = larger(dvec3(capsule->a), dvec3(capsule->b)) + dvec3(capsule->radius);
    } else if (const auto* box = std::get_if<Box>(&shape)) {
        const Axes axes(box->rotation);
        const dvec3 half(box->half_extents);
        const dvec3 reach = half.x * absolute(axes.x) + half.y * absolute(axes.y) + half.z * absolute(axes.z);
        low = dvec3(box->centre) - reach;
        high = dvec3(box->centre) + reach;
    } else {
        low = dvec3(-endless);
        high = dvec3(endless);
    }
    low = smaller(low, low - by);
    high = larger(high, high - by);
}

bool beyond(const Shape& shape, const dvec3& low, const dvec3& high) noexcept {
    const auto* plane = std::get_if<Plane>(&shape);
    if (plane == nullptr) return false;
    const dvec3 normal = unit(dvec3(plane->normal));
    const dvec3 deepest{normal.x > 0.0 ? low.x : high.x, normal.y > 0.0 ? low.y : high.y,
                        normal.z > 0.0 ? low.z : high.z};
    return dot(deepest - dvec3(plane->point), normal) > 0.0;
}

double nearest_on_line(const Shape& shape, const dvec3& a, const dvec3& b) noexcept {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return nearest_to(dvec3(sphere->centre), a, b);
    if (std::holds_alternative<Plane>(shape)) return 0.0;  // an end is always as near
    // The distance to a convex shape along a line has one valley: narrowed down by golden sections.
    constexpr double golden = 0.6180339887498949;
    double low = 0.0, high = 1.0;
    const auto far = [&](double t) { return surface_distance(shape, a + t * (b - a)).distance; };
    double left = high - golden, right = low + golden, at_left = far(left), at_right = far(right);
    for (int i = 0; i < 28; ++i) {
        if (at_left <= at_right) {
            high = right, right = left, at_right = at_left;
            left = high - golden * (high - low), at_left = far(left);
        } else {
            low = left, left = right, at_left = at_right;
            right = low + golden * (high - low), at_right = far(right);
        }
    }
    return 0.5 * (low + high);
}

}  // namespace tendril::rope::detail
