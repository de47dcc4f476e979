// Text and boxes drawn over the view's panes.
#pragma once

#include <span>

#include "app/view/palette.hpp"
#include "app/view/panes.hpp"

namespace tendril::app {

/// Titles in the panes' top left corners, and lines between the panes. Draws nothing for a single pane.
/// `axes`: the axis gizmo is in the top right corner of the view.
void show_pane_titles(std::span<const Pane> panes, std::span<const PaneTitle> titles, const Palette& palette,
                      float scale, bool axes);

/// The selection box that the user draws.
void show_selection_box(const Rect& box, const Palette& palette, float scale);
/// The stroke that is being drawn.
void show_stroke(glm::vec2 from, glm::vec2 to, const Palette& palette, float scale);

}  // namespace tendril::app
