// Keys by name: the names that scripts, recordings, the shortcut table and the README share; and GLFW's codes
// for them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tendril::app {

enum class Key {
    Unknown,
    A,
    B,
    C,
    D,
    E,
    F,
    G,
    H,
    I,
    J,
    K,
    L,
    M,
    N,
    O,
    P,
    Q,
    R,
    S,
    T,
    U,
    V,
    W,
    X,
    Y,
    Z,
    Num0,
    Num1,
    Num2,
    Num3,
    Num4,
    Num5,
    Num6,
    Num7,
    Num8,
    Num9,
    F1,
    F2,
    F3,
    F4,
    F5,
    F6,
    F7,
    F8,
    F9,
    F10,
    F11,
    F12,
    Escape,
    Enter,
    Tab,
    Backspace,
    Delete,
    Insert,
    Space,
    Left,
    Right,
    Up,
    Down,
    Home,
    End,
    PageUp,
    PageDown,
    Period,
    Comma,
    Slash,
    Minus,
    Equal,
    Question,
    Shift,
    Ctrl,
    Alt,
    Super,
    Count
};

/// A key and the modifiers held with it.
struct Chord {
    Key key = Key::Unknown;
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
    bool operator==(const Chord&) const = default;
};

/// "a", "escape", "page_up", "."; empty for Unknown.
std::string_view key_name(Key key);
/// The inverse of key_name, ignoring case; none for an unknown name.
std::optional<Key> key_from_name(std::string_view name);

/// "ctrl+shift+z": modifiers in that order, lower case.
std::string chord_name(const Chord& chord);
/// "Ctrl+Shift+Z", for display.
std::string chord_label(const Chord& chord);
/// Parses chord_name's form, with modifiers in any order and any case.
std::optional<Chord> chord_from_name(std::string_view name);

// Converts GLFW's key codes, which are positions on the keyboard, to the keys' labels.

/// The key as labelled by the current layout: Ctrl+Z is at the key labelled Z. Keys of other scripts
/// (Cyrillic, Greek) are named by their position on a US keyboard. Number pad keys map to digits.
Key translated_key(int glfw_key, int scancode);

std::string utf8(unsigned codepoint);

}  // namespace tendril::app
