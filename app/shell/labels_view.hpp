// Draws the text of the view beneath the panels: labels beside their points, and the legend. The window and
// pictures (picture_text.hpp) use the same functions.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "app/labs/lab.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"

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

}  // namespace tendril::app
