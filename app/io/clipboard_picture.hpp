// A picture on the system's clipboard. GLFW 3.3 can only put text there, so a program does it: wl-copy under
// Wayland, xclip under X11.
#pragma once

#include "app/io/image.hpp"

namespace tendril::app {

/// As PNG. Throws std::runtime_error where neither program is installed, saying what to install, or where it
/// fails, with what it said.
void copy_picture(const Image& image);

}  // namespace tendril::app
