// What lies under a pixel, judged by the same geometry that is drawn.
#pragma once

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

/// The pick id under the pixel, or no_pick. Shapes count up to `slack` pixels beyond their drawn edge.
PickId pick(const DrawList& list, const Camera& camera, glm::vec2 pixel, float slack = 3.0f);

}  // namespace tendril::app
