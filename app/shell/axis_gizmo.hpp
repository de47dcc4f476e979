// The axis gizmo in the view's corner, which shows the viewing direction. A click on an axis looks along it.
#pragma once

#include "app/shell/shell.hpp"

namespace tendril::app {

/// Pixels from the right edge of the view to the left edge of the gizmo; 0 if the view is too small for it.
float axis_gizmo_width(glm::vec2 pane, float scale);
/// Draws the gizmo and returns its rectangle, which is empty if the view is too small.
Rect show_axis_gizmo(const ShellFrame& frame, Emit& emit);

}  // namespace tendril::app
