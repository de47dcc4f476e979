#include "rope/contact_shape.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "math/rotation.hpp"
#include "rope/geometry.hpp"
#include "tendril/chain/segment.hpp"

namespace tendril::rope::detail {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

dvec3 absolute(const dvec3& v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// The parameter, 0 to 1, of the point of a line nearest to a point.
double nearest_to(const dvec3& point, const dvec3& a, const dvec3& b) {
    const dvec3 by = b - a;
    const double squared = dot(by, by);
    return squared > 0.0 ? std::clamp(dot(point - a, by) / squared, 0.0, 1.0) : 0.0;
}

/// The distance to a convex shape along a line: it has a single minimum.
struct ConvexLine {
    const Shape& shape;
    dvec3 from, by;
    std::uint64_t& work;

    struct Point {
        double t, distance, slope;
    };
    Point at(double t) const {
        ++work;
        const SurfaceDistance surface = surface_distance(shape, from + t * by);
        return {t, surface.distance, dot(surface.normal, by)};
    }
};

}  // namespace

void bounds(const Shape& shape, const dvec3& by, dvec3& low, dvec3& high) noexcept {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        low = dvec3(sphere->centre) - dvec3(sphere->radius);
        high = dvec3(sphere->centre) + dvec3(sphere->radius);
    } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
        low = glm::min(dvec3(capsule->a), dvec3(capsule->b)) - dvec3(capsule->radius);
        high = glm::max(dvec3(capsule->a), dvec3(capsule->b)) + dvec3(capsule->radius);
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
    low = glm::min(low, low - by);
    high = glm::max(high, high - by);
}

bool beyond(const Shape& shape, const dvec3& low, const dvec3& high) noexcept {
    const auto* plane = std::get_if<Plane>(&shape);
    if (plane == nullptr) return false;
    const dvec3 normal = unit(dvec3(plane->normal));
    const dvec3 deepest{normal.x > 0.0 ? low.x : high.x, normal.y > 0.0 ? low.y : high.y,
                        normal.z > 0.0 ? low.z : high.z};
    return dot(deepest - dvec3(plane->point), normal) > 0.0;
}

std::optional<double> nearest_between(const Shape& shape, const dvec3& a, const dvec3& b, double reach,
                                      std::uint64_t& work) noexcept {
    constexpr int max_samples = 14;
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        const double t = nearest_to(dvec3(sphere->centre), a, b);
        return t > 0.0 && t < 1.0 ? std::optional(t) : std::nullopt;
    }
    if (std::holds_alternative<Plane>(shape)) return std::nullopt;  // an end is always at least as near
    const ConvexLine line{shape, a, b - a, work};
    ConvexLine::Point low = line.at(0.0), high = line.at(1.0);
    if (!(low.slope < 0.0 && high.slope > 0.0)) return std::nullopt;
    const double precise = 1e-9 * length(line.by);
    for (int i = 2; i < max_samples; ++i) {
        // The tangents at both ends cross at a lower bound of the distance in between.
        const double bend = high.slope - low.slope, width = high.t - low.t;
        const double cross = (low.distance - high.distance + high.slope * width) / bend;
        const double minimum = low.distance + low.slope * cross;
        if (minimum > reach) return std::nullopt;
        const bool low_is_less = low.distance <= high.distance;
        if (std::min(low.distance, high.distance) - minimum <= precise) return low_is_less ? low.t : high.t;
        // The crossing finds a corner, the secant of the slopes a smooth minimum.
        const double step = i % 2 == 0 ? cross : -low.slope / bend * width;
        const ConvexLine::Point middle = line.at(low.t + std::clamp(step, 0.001 * width, 0.999 * width));
        (middle.slope < 0.0 ? low : high) = middle;
    }
    return low.distance <= high.distance ? low.t : high.t;
}

dvec3 middle_of(const Capsule& capsule) noexcept {
    return 0.5 * dvec3(capsule.b) + 0.5 * dvec3(capsule.a);
}

dvec3 half_of(const Capsule& capsule) noexcept {
    return 0.5 * dvec3(capsule.b) - 0.5 * dvec3(capsule.a);
}

Shape interpolated(const Collider& collider, double part) noexcept {
    const auto* const capsule = std::get_if<Capsule>(&collider.shape);
    const bool turns = collider.half_goal.has_value();
    const dvec3 from = turns ? middle_of(*capsule) : dvec3(centre(collider.shape));
    const dvec3 to = from + part * (collider.goal - from);
    if (!turns) return clamped_to_world(moved(collider.shape, glm::vec3(to)));
    const dvec3 was = half_of(*capsule), half = was + part * (*collider.half_goal - was);
    return clamped_to_world(Capsule{glm::vec3(to - half), glm::vec3(to + half), capsule->radius});
}

glm::dquat rotation_after(const Drive& drive, double seconds) noexcept {
    const double half = 0.5 * seconds * static_cast<double>(drive.spin);
    return {math::cosine(half), math::sine(half) * unit(dvec3(drive.axis))};
}

Shape driven(const Shape& shape, const Drive& drive, double seconds) noexcept {
    if (std::holds_alternative<Plane>(shape)) return shape;
    constexpr double edge = max_magnitude;
    const dvec3 from(centre(shape)), to = from + seconds * dvec3(drive.velocity);
    Shape there = moved(shape, glm::vec3(glm::clamp(to, dvec3(-edge), dvec3(edge))));
    if (drive.spin == 0.0f) return clamped_to_world(there);
    const glm::dquat turn = rotation_after(drive, seconds);
    if (auto* box = std::get_if<Box>(&there))
        box->rotation = math::narrow(math::compose(turn, math::wide(box->rotation)));
    if (auto* capsule = std::get_if<Capsule>(&there)) {
        const dvec3 middle(centre(there)), half = math::rotated(turn, half_of(*capsule));
        *capsule = {glm::vec3(middle - half), glm::vec3(middle + half), capsule->radius};
    }
    return clamped_to_world(there);
}

Shape clamped_to_world(const Shape& shape) noexcept {
    const auto* capsule = std::get_if<Capsule>(&shape);  // the others are defined by their centre
    if (capsule == nullptr) return shape;
    const glm::vec3 edge(max_magnitude);
    return Capsule{glm::clamp(capsule->a, -edge, edge), glm::clamp(capsule->b, -edge, edge), capsule->radius};
}

}  // namespace tendril::rope::detail
