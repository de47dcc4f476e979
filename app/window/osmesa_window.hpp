// Off screen with OSMesa, Mesa's software rasteriser: needs no display and no graphics card.
#pragma once

#include <memory>

#include "app/window/window.hpp"

namespace tendril::app {

std::unique_ptr<Window> open_osmesa_window(glm::ivec2 size);

}  // namespace tendril::app
