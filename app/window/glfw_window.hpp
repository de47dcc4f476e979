// A window on the screen.
#pragma once

#include <memory>

#include "app/window/window.hpp"

namespace tendril::app {

std::unique_ptr<Window> open_glfw_window(glm::ivec2 size);

}  // namespace tendril::app
