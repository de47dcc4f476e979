// Copies a picture to the system's clipboard. GLFW 3.3 only supports text, so another program does it:
// wl-copy under Wayland, xclip under X11.
#pragma once

#include "app/io/image.hpp"

namespace tendril::app {

/// Copies PNG. Throws std::runtime_error that says what to install if neither program is found, or with the
/// program's error if it fails.
void copy_picture(const Image& image);

}  // namespace tendril::app
