#include "app/view/spline.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tendril::app {
namespace {

/// The derivative at p1 over the knot interval from p1 to p2.
glm::vec3 slope_between(glm::vec3 p0, glm::vec3 p1, glm::vec3 p2) {
    const float before = std::sqrt(glm::distance(p0, p1)), after = std::sqrt(glm::distance(p1, p2));
    const glm::vec3 velocity = (p1 - p0) / before - (p2 - p0) / (before + after) + (p2 - p1) / after;
    return velocity * after;
}

float angle(glm::vec3 a, glm::vec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// `vector` rotated by the smallest rotation that takes `from` to `to`; both unit, not opposite.
glm::vec3 turned(glm::vec3 vector, glm::vec3 from, glm::vec3 to) {
    const glm::vec3 half_way = from + to;
    return vector - glm::dot(half_way, vector) / (1.0f + glm::dot(from, to)) * half_way +
           2.0f * glm::dot(from, vector) * to;
}

glm::vec3 first_normal(glm::vec3 tangent) {
    // No rule is continuous for all tangents. This one is discontinuous only opposite to `pole`, an unlikely
    // direction for a rope.
    const glm::vec3 pole(0.60f, 0.64f, 0.48f), across(-0.80f, 0.48f, 0.36f);
    if (glm::dot(pole, tangent) < -0.9999f) return across;
    return turned(across, pole, tangent);
}

/// The unit vector perpendicular to `tangent` that is nearest to `normal`.
glm::vec3 straightened(glm::vec3 normal, glm::vec3 tangent) {
    normal -= glm::dot(normal, tangent) * tangent;
    const float length = glm::length(normal);
    return length > 1e-3f ? normal / length : first_normal(tangent);
}

}  // namespace

glm::vec3 CurveSpan::at(float t) const {
    const float s = 1.0f - t;
    return s * s * (1.0f + 2.0f * t) * a + t * t * (1.0f + 2.0f * s) * b + s * s * t * slope_a -
           t * t * s * slope_b;
}

glm::vec3 CurveSpan::slope(float t) const {
    const float s = 1.0f - t;
    return 6.0f * s * t * (b - a) + s * (s - 2.0f * t) * slope_a + t * (t - 2.0f * s) * slope_b;
}

float CurveSpan::turn() const {
    return angle(slope_a, b - a) + angle(b - a, slope_b);
}

CurveSpan curve_span(std::span<const glm::vec3> points, std::size_t i) {
    const glm::vec3 a = points[i], b = points[i + 1];
    const bool first = i == 0, last = i + 2 == points.size();
    CurveSpan span{.a = a, .b = b, .slope_a = b - a, .slope_b = b - a};
    if (!first) span.slope_a = slope_between(points[i - 1], a, b);
    if (!last) span.slope_b = -slope_between(points[i + 2], b, a);
    // The first and last spans are parabolas: minimum bending for one given end direction.
    if (first && !last) span.slope_a = 2.0f * (b - a) - span.slope_b;
    if (last && !first) span.slope_b = 2.0f * (b - a) - span.slope_a;
    return span;
}

void set_frames(std::span<CurvePoint> points) {
    if (points.empty()) return;
    points[0].normal = straightened(first_normal(points[0].tangent), points[0].tangent);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const CurvePoint& from = points[i - 1];
        CurvePoint& to = points[i];
        glm::vec3 normal = from.normal, tangent = from.tangent;
        // Reflected in the plane halfway between the two points, then in the one that maps the tangent to the
        // next one.
        const glm::vec3 step = to.at - from.at;
        if (const float squared = glm::dot(step, step); squared > 0.0f) {
            normal -= 2.0f / squared * glm::dot(step, normal) * step;
            tangent -= 2.0f / squared * glm::dot(step, tangent) * step;
        }
        const glm::vec3 rest = to.tangent - tangent;
        if (const float squared = glm::dot(rest, rest); squared > 1e-12f)
            normal -= 2.0f / squared * glm::dot(rest, normal) * rest;
        to.normal = straightened(normal, to.tangent);
    }
}

}  // namespace tendril::app
