// What is written over the panes of a divided view.
#pragma once

#include <span>

#include "app/view/palette.hpp"
#include "app/view/panes.hpp"

namespace tendril::app {

/// Titles in the panes' top left corners, and lines between the panes. Nothing where there is one pane.
void show_pane_titles(std::span<const Pane> panes, std::span<const PaneTitle> titles, const Palette& palette,
                      float scale);

}  // namespace tendril::app
