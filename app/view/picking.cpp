#include "app/view/picking.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/view/stroke_projection.hpp"

namespace tendril::app {
namespace {

struct Hit {
    int rank = 0;
    bool overlay = false;
    bool inside = false;
    float depth = 0.0f;

    bool beats(const Hit& other) const {
        return std::tuple(rank, overlay, inside, -depth) >
               std::tuple(other.rank, other.overlay, other.inside, -other.depth);
    }
};

/// Depth of the stroke's axis; in perspective the inverse depth is linear across the screen.
float axis_depth(const ProjectedStroke& outline, float along, bool orthographic) {
    if (orthographic) return outline.depth_a + along * (outline.depth_b - outline.depth_a);
    return 1.0f / ((1.0f - along) / outline.depth_a + along / outline.depth_b);
}

/// How far the drawn surface bulges from the axis towards the eye, in pixels.
float bulge(const ProjectedStroke& outline, const StrokeDistance& distance) {
    const float radius = outline.radius_a + distance.along * (outline.radius_b - outline.radius_a);
    const float off_axis = std::clamp(radius + distance.pixels, 0.0f, radius);
    return std::sqrt(radius * radius - off_axis * off_axis);
}

}  // namespace

PickId pick(const DrawList& list, const Camera& camera, glm::vec2 pixel, float slack) {
    if (!camera.viewport().contains(pixel)) return no_pick;
    const bool orthographic = camera.pose().orthographic;
    const StrokeProjector projector(camera);
    PickId best = no_pick;
    Hit best_hit;
    for (const Stroke& stroke : list.strokes) {
        if (stroke.pick == no_pick) continue;
        ProjectedStroke outline;
        if (!projector.project(stroke, outline, slack)) continue;
        StrokeDistance distance = distance_to(outline, pixel);
        if (stroke.shade == Shade::Ring) {
            distance.pixels = std::abs(distance.pixels) - 0.5f * stroke.ring_width;
        }
        if (!(distance.pixels <= slack)) continue;
        float depth = axis_depth(outline, distance.along, orthographic);
        if (stroke.shade == Shade::Lit) {
            const glm::vec3 on_axis = stroke.a + distance.along * (stroke.b - stroke.a);
            depth -= camera.metres_per_pixel(on_axis) * bulge(outline, distance);
        }
        const Hit hit{.rank = stroke.rank,
                      .overlay = stroke.layer == Layer::Overlay,
                      .inside = distance.pixels <= 0.0f,
                      .depth = depth};
        if (best == no_pick || hit.beats(best_hit)) {
            best = stroke.pick;
            best_hit = hit;
        }
    }
    return best;
}

}  // namespace tendril::app
