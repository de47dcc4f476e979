// Off screen through EGL with no surface at all (EGL_MESA_platform_surfaceless), drawing into a framebuffer
// object. Mesa 25.1 removed OSMesa; this is what is left there.
#pragma once

#include <memory>

#include "app/window/window.hpp"

namespace tendril::app {

std::unique_ptr<Window> open_egl_window(glm::ivec2 size);

}  // namespace tendril::app
