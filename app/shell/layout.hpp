// Divides the window into bars, panels and the 3D view.
#pragma once

#include <glm/vec2.hpp>

#include "app/document/settings.hpp"
#include "app/view/camera.hpp"

namespace tendril::app {

struct Layout {
    Rect top, left, right, timeline, status, canvas, view;
    float scale = 1.0f;
    bool left_open = true, right_open = true;
    bool one_panel = false;  ///< only one side panel fits
};

/// Everything is in window coordinates. `timeline`: height of the time strip at scale 1. In a narrow window
/// the panels shrink before the middle does; a folded panel leaves a slim strip to unfold it. `canvas`: the
/// fraction of the middle, from the left, that the lab's own plots take from the 3D view, 0 to 1.
Layout lay_out(glm::vec2 window, float scale, const Settings& settings, float timeline, float canvas = 0.0f);

}  // namespace tendril::app
