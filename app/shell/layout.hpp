// Where everything is: the window divided into bars, panels and the 3D view.
#pragma once

#include <glm/vec2.hpp>

#include "app/document/settings.hpp"
#include "app/view/camera.hpp"

namespace tendril::app {

struct Layout {
    Rect top, left, right, timeline, status, canvas, view;
    float scale = 1.0f;
    bool left_open = true, right_open = true;
    bool one_panel = false;  ///< there is room for one side panel only
};

/// Everything in window coordinates. `timeline`: how high the strip of time is, at scale 1. In a narrow
/// window the panels give way before the middle does; of a folded panel a slim strip stays, to bring it back
/// with. `canvas` is the part of the middle, from the left, that the lab's own picture takes from the 3D
/// view: 0 to 1.
Layout lay_out(glm::vec2 window, float scale, const Settings& settings, float timeline, float canvas = 0.0f);

}  // namespace tendril::app
