// Window events: the single form in which input is sampled, recorded and applied.
//
// The program handles exactly one event per tick (see app.hpp), so events need no timestamp:
// a recording is a list of events and the empty ticks between them, which makes replays exact.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <variant>
#include <vector>

#include "app/window/keys.hpp"

namespace tendril::app {

enum class MouseButton { Left, Right, Middle };
/// In scripts and gestures.
constexpr const char* button_name(MouseButton button) {
    return button == MouseButton::Left ? "left" : button == MouseButton::Right ? "right" : "middle";
}

/// The pointer moved to `at`: window coordinates, from the top left.
struct MouseMove {
    glm::vec2 at{0.0f};
};
struct MousePress {
    MouseButton button = MouseButton::Left;
    bool down = true;
    bool by_finger = false;
};
/// Notches of the wheel, positive away from the user; a touchpad sends fractions. A tilting wheel or a
/// touchpad also scrolls sideways: positive to the left.
struct MouseWheel {
    float by = 0.0f;
    float sideways = 0.0f;
};
/// A key went down (also on repeats) or up. Keys are named by their labels in the keyboard's layout. Question
/// goes down and up at once, after the key that typed it, with or without Shift.
struct KeyChange {
    Key key = Key::Unknown;
    bool down = true;
};
/// A chord pressed and released within one tick; only scripts create these.
struct KeyTap {
    Chord chord;
};
struct TextInput {
    std::string utf8;
};
/// An unchanged size means that the picture was lost and must be redrawn.
struct Resize {
    glm::ivec2 size{0};
};
struct Drop {
    std::vector<std::string> paths;
};
struct Focus {
    bool focused = true;
};
struct CloseRequest {};
/// The program that encodes a video has ended, successfully or not. Its timing is not deterministic, so it is
/// recorded as an event.
struct VideoEnd {};

using Event = std::variant<MouseMove, MousePress, MouseWheel, KeyChange, KeyTap, TextInput, Resize, Drop,
                           Focus, CloseRequest, VideoEnd>;

}  // namespace tendril::app
