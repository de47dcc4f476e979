// Draws a picture's labels as text beneath the panels.
#pragma once

#include <span>

#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

void show_labels(const DrawList& drawn, const Camera& camera, const Palette& palette, float scale,
                 std::span<const Rect> overlays = {});

}  // namespace tendril::app
