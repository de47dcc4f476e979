// Windows of the system: on the screen, or hidden to draw off screen.
#pragma once

#include <memory>

#include "app/window/window.hpp"

namespace tendril::app {

std::unique_ptr<Window> open_glfw_window(glm::ivec2 size);
std::unique_ptr<Window> open_hidden_window(glm::ivec2 size);

}  // namespace tendril::app
