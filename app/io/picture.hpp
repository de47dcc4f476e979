// The view as a picture of its own: of any size, with what lies behind it or without.
#pragma once

#include <functional>

#include "app/io/image.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// What a lab draws, in the colours of a palette.
using DrawScene = std::function<DrawList(const Palette&)>;

/// Draws the scene as `camera` sees it; its viewport is the whole picture. With `transparent` there is
/// nothing behind it, and what is see-through or a shadow is so in the file. Needs a current context; throws
/// std::runtime_error where the driver has no memory for it.
Image draw_picture(Renderer& renderer, const DrawScene& draw, const Camera& camera, const Palette& palette,
                   bool transparent);

}  // namespace tendril::app
