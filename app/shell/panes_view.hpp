// What is written and drawn flat over the panes of the view.
#pragma once

#include <span>

#include "app/view/palette.hpp"
#include "app/view/panes.hpp"

namespace tendril::app {

/// Titles in the panes' top left corners, and lines between the panes. Nothing where there is one pane.
void show_pane_titles(std::span<const Pane> panes, std::span<const PaneTitle> titles, const Palette& palette,
                      float scale);

/// The box that is drawn with the mouse, to select what is in it.
void show_selection_box(const Rect& box, const Palette& palette, float scale);

}  // namespace tendril::app
