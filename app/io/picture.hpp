// The view as a picture of its own: of any size, with what lies behind it or without.
#pragma once

#include <functional>

#include "app/io/image.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// What a lab draws in its panes, in the colours of a palette.
using DrawScene = std::function<std::vector<Pane>(const Palette&)>;

/// Draws the scene as the camera sees it, in a picture of `size` pixels. With `transparent` there is
/// nothing behind it, and what is see-through or a shadow is so in the file. Needs a current context; throws
/// std::runtime_error where the driver has no memory for it.
Image draw_picture(Renderer& renderer, const DrawScene& draw, const CameraPose& pose, glm::ivec2 size,
                   const Palette& palette, bool transparent);

}  // namespace tendril::app
