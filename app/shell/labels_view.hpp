// Draws the text of the view beneath the panels: labels beside their points, the legend, the panes' titles,
// and boxes. The window and pictures (picture_text.hpp) use the same functions.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "app/labs/lab.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"
#include "app/view/panes.hpp"

namespace tendril::app {

void show_labels(const DrawList& drawn, const Camera& camera, const Palette& palette, float scale,
                 std::span<const Rect> overlays = {});

/// A corner of the view: 0 is left or top, 1 right or bottom.
using ViewCorner = glm::vec2;
inline constexpr ViewCorner lower_left{0.0f, 1.0f};

/// The legend's rectangle in a corner of the view; empty if there is none.
Rect legend_box(std::span<const LegendRow> rows, const Rect& view, float scale,
                ViewCorner corner = lower_left);
/// Returns legend_box().
Rect show_legend(std::span<const LegendRow> rows, const Rect& view, const Palette& palette, float scale,
                 ViewCorner corner = lower_left);

/// Titles in the panes' top left corners, and lines between the panes. Draws nothing for a single pane.
/// `axes`: the axis gizmo is in the top right corner of the view.
void show_pane_titles(std::span<const Pane> panes, std::span<const PaneTitle> titles, const Palette& palette,
                      float scale, bool axes);

/// The selection box that the user draws.
void show_selection_box(const Rect& box, const Palette& palette, float scale);
/// The stroke that is being drawn.
void show_stroke(glm::vec2 from, glm::vec2 to, const Palette& palette, float scale);

}  // namespace tendril::app
