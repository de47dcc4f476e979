// Converts GLFW's key codes, which are positions on the keyboard, to the keys' labels.
#pragma once

#include <string>

#include "app/window/keys.hpp"

namespace tendril::app {

/// The key as labelled by the current layout: Ctrl+Z is at the key labelled Z. Keys of other scripts
/// (Cyrillic, Greek) are named by their position on a US keyboard. Number pad keys map to digits.
Key translated_key(int glfw_key, int scancode);

std::string utf8(unsigned codepoint);

}  // namespace tendril::app
