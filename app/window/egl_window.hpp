// Off screen through EGL without a surface (EGL_MESA_platform_surfaceless), drawing into a framebuffer
// object. Needed since Mesa 25.1, which removed OSMesa.
#pragma once

#include <memory>

#include "app/window/window.hpp"

namespace tendril::app {

std::unique_ptr<Window> open_egl_window(glm::ivec2 size);

}  // namespace tendril::app
