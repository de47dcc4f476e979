// Draws the view as a picture of any size, with or without the background.
#pragma once

#include <functional>

#include "app/io/image.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// Draws a lab's panes in the colours of a palette.
using DrawScene = std::function<std::vector<Pane>(const Palette&)>;

/// Draws the scene in a picture of `size` pixels. With `transparent` it has no background, and transparent
/// surfaces and shadows have partial alpha. Needs a current context; throws std::runtime_error if the driver
/// has not enough memory.
Image draw_picture(Renderer& renderer, const DrawScene& draw, const CameraPose& pose, glm::ivec2 size,
                   const Palette& palette, bool transparent);

}  // namespace tendril::app
