#include "app/view/stroke_projection.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tendril::app {

StrokeProjector::StrokeProjector(const Camera& camera)
    : eye_(camera.eye()),
      forward_(camera.forward()),
      right_(camera.right()),
      up_(camera.up()),
      centre_(camera.viewport().centre()),
      viewport_(camera.viewport()),
      near_(camera.near_plane()),
      orthographic_(camera.pose().orthographic) {
    const float scale = 1.0f / camera.metres_per_pixel(camera.pose().target);
    pixels_per_metre_ = orthographic_ ? scale : scale * camera.depth(camera.pose().target);
}

// In eye space: x right, y up, z along the viewing direction.
bool StrokeProjector::cut_at_near(glm::vec3& a, glm::vec3& b, float& radius_a, float& radius_b) const {
    if (a.z >= near_ && b.z >= near_) return true;
    if (a.z < near_ && b.z < near_) return false;
    const float t = (near_ - a.z) / (b.z - a.z);
    const glm::vec3 point(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), near_);
    const float radius = radius_a + t * (radius_b - radius_a);
    const bool cut_a = a.z < near_;
    (cut_a ? a : b) = point;
    (cut_a ? radius_a : radius_b) = radius;
    return true;
}

bool StrokeProjector::project(const Stroke& stroke, ProjectedStroke& out, float margin) const {
    const auto to_eye_space = [this](glm::vec3 point) {
        const glm::vec3 p = point - eye_;
        return glm::vec3(glm::dot(p, right_), glm::dot(p, up_), glm::dot(p, forward_));
    };
    glm::vec3 a = to_eye_space(stroke.a), b = to_eye_space(stroke.b);
    out.radius_a = stroke.radius_a;
    out.radius_b = stroke.radius_b;
    float scale_a = pixels_per_metre_, scale_b = pixels_per_metre_;
    if (!orthographic_) {
        if (!cut_at_near(a, b, out.radius_a, out.radius_b)) return false;
        scale_a /= a.z;
        scale_b /= b.z;
    }
    out.a = centre_ + scale_a * glm::vec2(a.x, -a.y);
    out.b = centre_ + scale_b * glm::vec2(b.x, -b.y);
    out.depth_a = a.z;
    out.depth_b = b.z;
    if (stroke.unit == Unit::Metres) {
        out.radius_a *= scale_a;
        out.radius_b *= scale_b;
    }
    // Lines are drawn slightly deeper, so that they end behind the balls at their ends, even where they leave
    // a ball towards the eye.
    if (stroke.unit == Unit::Pixels && stroke.shade == Shade::Flat) {
        constexpr float pixels_deeper = 8.0f;
        out.depth_a += pixels_deeper / scale_a;
        out.depth_b += pixels_deeper / scale_b;
    }
    // The sum is not finite if any term is not.
    const float sum = out.a.x + out.a.y + out.b.x + out.b.y + out.radius_a + out.radius_b + a.z + b.z;
    if (!std::isfinite(sum) || out.radius_a < 0.0f || out.radius_b < 0.0f) return false;

    const float reach = std::max(out.radius_a, out.radius_b) + 0.5f * stroke.ring_width + margin;
    const glm::vec2 low = glm::min(out.a, out.b) - reach, high = glm::max(out.a, out.b) + reach;
    return low.x < viewport_.max.x && low.y < viewport_.max.y && high.x > viewport_.min.x &&
           high.y > viewport_.min.y;
}

StrokeDistance distance_to(const ProjectedStroke& stroke, glm::vec2 pixel) {
    const glm::vec2 axis = stroke.b - stroke.a, from_a = pixel - stroke.a;
    const float length = glm::length(axis), narrowing = stroke.radius_a - stroke.radius_b;
    // One circle contains the other: the larger one is the outline.
    if (length <= std::abs(narrowing) + 1e-3f) {
        return narrowing >= 0.0f ? StrokeDistance{glm::length(from_a) - stroke.radius_a, 0.0f}
                                 : StrokeDistance{glm::length(pixel - stroke.b) - stroke.radius_b, 1.0f};
    }
    const glm::vec2 direction = axis / length;
    const float x = glm::dot(from_a, direction);
    const float y = std::abs(from_a.x * direction.y - from_a.y * direction.x);
    // The flank's normal is (sine, cosine) in these coordinates; following it back from the pixel gives the
    // centre of the nearest circle.
    const float sine = narrowing / length, cosine = std::sqrt(1.0f - sine * sine);
    const float foot = x - y * sine / cosine;
    if (foot <= 0.0f) return {glm::length(from_a) - stroke.radius_a, 0.0f};
    if (foot >= length) return {glm::length(pixel - stroke.b) - stroke.radius_b, 1.0f};
    return {x * sine + y * cosine - stroke.radius_a, foot / length};
}

}  // namespace tendril::app
