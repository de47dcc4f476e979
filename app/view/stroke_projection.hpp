// Projects a stroke to its outline on the screen. The renderer and picking both use it, so that the visible
// shape is the one picked.
//
// A ball is drawn as a circle of its radius at the depth of its centre, anywhere in the picture. (True
// perspective stretches it towards the corners, which looks like a flaw.) The hull of two balls is bounded by
// the two lines tangent to both circles.
#pragma once

#include <glm/vec2.hpp>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// In window pixels from the top left, like Camera::project; depths in metres along the viewing direction.
struct ProjectedStroke {
    glm::vec2 a{0.0f}, b{0.0f};
    float radius_a = 0.0f, radius_b = 0.0f;
    float depth_a = 0.0f, depth_b = 0.0f;

    float depth() const { return 0.5f * (depth_a + depth_b); }
};

/// Projects many strokes for one camera.
class StrokeProjector {
  public:
    explicit StrokeProjector(const Camera& camera);

    /// False if the stroke is invisible: behind the near plane, outside the viewport, or not finite. A stroke
    /// that crosses the near plane is cut there. `margin`: pixels around the viewport that still count as
    /// inside.
    bool project(const Stroke& stroke, ProjectedStroke& out, float margin = 2.0f) const;

  private:
    bool cut_at_near(glm::vec3& a, glm::vec3& b, float& radius_a, float& radius_b) const;

    glm::vec3 eye_, forward_, right_, up_;
    glm::vec2 centre_;
    Rect viewport_;
    float pixels_per_metre_;  ///< perspective: at a depth of 1 m; orthographic: everywhere
    float near_;
    bool orthographic_;
};

/// The point of a stroke's outline nearest to a pixel.
struct StrokeDistance {
    float pixels = 0.0f;  ///< negative inside
    float along = 0.0f;   ///< 0 at a, 1 at b
};
StrokeDistance distance_to(const ProjectedStroke& stroke, glm::vec2 pixel);

}  // namespace tendril::app
