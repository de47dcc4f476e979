// Draws the view as a picture of any size, with or without the background; reads what was drawn.
#pragma once

#include <functional>
#include <vector>

#include "app/io/image.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// Reads the pixels of a framebuffer of the current context; alpha is set to opaque.
Image read_framebuffer(unsigned framebuffer, glm::ivec2 size);

/// Draws a lab's panes in the colours of a palette.
using DrawScene = std::function<std::vector<Pane>(const Palette&)>;

/// Draws over the panes, into the bound framebuffer, in the same colours.
using DrawOver = std::function<void(const std::vector<Pane>&, const Palette&)>;

/// The background. Scene: as in the window, with its grid. On Transparent, transparent surfaces and shadows
/// have partial alpha.
enum class Background { Scene, White, Transparent };

/// Draws the scene in a picture of `size` pixels. `over` may be empty. Needs a current context; throws
/// std::runtime_error if the driver runs out of memory.
Image draw_picture(Renderer& renderer, const DrawScene& draw, const CameraPose& pose, glm::ivec2 size,
                   const Palette& palette, Background background, const DrawOver& over);

}  // namespace tendril::app
