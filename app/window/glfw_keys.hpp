// From GLFW's key codes, which name places on the keyboard, to what is written on the keys.
#pragma once

#include <string>

#include "app/window/keys.hpp"

namespace tendril::app {

/// The key as the current layout labels it: Ctrl+Z is where Z is written. Keys of other scripts (Cyrillic,
/// Greek) keep the name of their place on a US keyboard. The number pad counts as digits.
Key translated_key(int glfw_key, int scancode);

std::string utf8(unsigned codepoint);

}  // namespace tendril::app
