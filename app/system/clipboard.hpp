// A picture for other programs to paste. Text goes through the window's own clipboard.
#pragma once

#include <string_view>

namespace tendril::app {

/// Puts a PNG file's bytes on the clipboard. On Linux wl-copy or xclip does it. Throws std::runtime_error if
/// that is not possible, naming the program to install.
void copy_png(std::string_view png);

}  // namespace tendril::app
