#include "app/window/keys.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace tendril::app {
namespace {

/// `first` plus the offset of `code` from `first_code`, for runs of keys in the same order in both
/// enumerations.
Key key_in_run(Key first, int code, int first_code) {
    return static_cast<Key>(static_cast<int>(first) + code - first_code);
}

Key from_position(int code) {
    if (code >= GLFW_KEY_A && code <= GLFW_KEY_Z) return key_in_run(Key::A, code, GLFW_KEY_A);
    if (code >= GLFW_KEY_0 && code <= GLFW_KEY_9) return key_in_run(Key::Num0, code, GLFW_KEY_0);
    if (code >= GLFW_KEY_KP_0 && code <= GLFW_KEY_KP_9) return key_in_run(Key::Num0, code, GLFW_KEY_KP_0);
    if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12) return key_in_run(Key::F1, code, GLFW_KEY_F1);
    switch (code) {
        case GLFW_KEY_ESCAPE:
            return Key::Escape;
        case GLFW_KEY_ENTER:
        case GLFW_KEY_KP_ENTER:
            return Key::Enter;
        case GLFW_KEY_TAB:
            return Key::Tab;
        case GLFW_KEY_BACKSPACE:
            return Key::Backspace;
        case GLFW_KEY_DELETE:
            return Key::Delete;
        case GLFW_KEY_INSERT:
            return Key::Insert;
        case GLFW_KEY_SPACE:
            return Key::Space;
        case GLFW_KEY_LEFT:
            return Key::Left;
        case GLFW_KEY_RIGHT:
            return Key::Right;
        case GLFW_KEY_UP:
            return Key::Up;
        case GLFW_KEY_DOWN:
            return Key::Down;
        case GLFW_KEY_HOME:
            return Key::Home;
        case GLFW_KEY_END:
            return Key::End;
        case GLFW_KEY_PAGE_UP:
            return Key::PageUp;
        case GLFW_KEY_PAGE_DOWN:
            return Key::PageDown;
        case GLFW_KEY_PERIOD:
        case GLFW_KEY_KP_DECIMAL:
            return Key::Period;
        case GLFW_KEY_COMMA:
            return Key::Comma;
        case GLFW_KEY_SLASH:
        case GLFW_KEY_KP_DIVIDE:
            return Key::Slash;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            return Key::Minus;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_EQUAL:
            return Key::Equal;
        case GLFW_KEY_LEFT_SHIFT:
        case GLFW_KEY_RIGHT_SHIFT:
            return Key::Shift;
        case GLFW_KEY_LEFT_CONTROL:
        case GLFW_KEY_RIGHT_CONTROL:
            return Key::Ctrl;
        case GLFW_KEY_LEFT_ALT:
            return Key::Alt;  // the right one is AltGr, which types characters
        case GLFW_KEY_LEFT_SUPER:
        case GLFW_KEY_RIGHT_SUPER:
            return Key::Super;
        default:
            return Key::Unknown;
    }
}

bool is_letter_or_sign(int code) {
    return code >= GLFW_KEY_APOSTROPHE && code <= GLFW_KEY_WORLD_2;
}

}  // namespace

Key translated_key(int glfw_key, int scancode) {
    const Key place = from_position(glfw_key);
    // The space bar and the number pad are the same everywhere.
    if (!is_letter_or_sign(glfw_key)) return place;
    const char* const written = glfwGetKeyName(glfw_key, scancode);
    if (written == nullptr) return place;
    return key_from_name(written).value_or(place);
}

std::string utf8(unsigned codepoint) {
    const auto byte = [](unsigned bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
    std::string text;
    if (codepoint < 0x80) {
        text += byte(codepoint);
    } else if (codepoint < 0x800) {
        text += byte(0xC0 | (codepoint >> 6));
    } else if (codepoint < 0x10000) {
        text += byte(0xE0 | (codepoint >> 12));
        text += byte(0x80 | ((codepoint >> 6) & 0x3F));
    } else {
        text += byte(0xF0 | ((codepoint >> 18) & 0x07));
        text += byte(0x80 | ((codepoint >> 12) & 0x3F));
        text += byte(0x80 | ((codepoint >> 6) & 0x3F));
    }
    if (codepoint >= 0x80) text += byte(0x80 | (codepoint & 0x3F));
    return text;
}

}  // namespace tendril::app
