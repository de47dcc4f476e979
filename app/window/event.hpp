// What can happen to a window: the one form in which input is sampled, recorded and applied.
//
// The program takes exactly one event a tick (see app.hpp), so an event carries no time of its own:
// a recording is a list of events and of empty ticks between them, and that makes a replay exact.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <variant>
#include <vector>

#include "app/window/keys.hpp"

namespace tendril::app {

enum class MouseButton { Left, Right, Middle };

/// The pointer went to `at`: window coordinates, from the top left.
struct MouseMove {
    glm::vec2 at{0.0f};
};
struct MousePress {
    MouseButton button = MouseButton::Left;
    bool down = true;
};
/// Notches of the wheel, positive away from the person; a touchpad's two fingers send parts of one. Of a
/// wheel that tilts, or two fingers, sideways too: positive to the left.
struct MouseWheel {
    float by = 0.0f;
    float sideways = 0.0f;
};
/// A key went down (repeats come as further downs) or up. Keys are named by what the keyboard's layout writes
/// on them. Question comes down and up at once, wherever it is typed, after the key (with Shift or without)
/// that typed it.
struct KeyChange {
    Key key = Key::Unknown;
    bool down = true;
};
/// A chord pressed and let go within one tick; only scripts make these.
struct KeyTap {
    Chord chord;
};
struct TextInput {
    std::string utf8;
};
/// The same size again means that the picture was lost and is to be drawn anew.
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
/// The program that writes a video has come to its end, well or not. How long that takes is its own business:
/// so that a recording has it, it is an event.
struct VideoEnd {};

using Event = std::variant<MouseMove, MousePress, MouseWheel, KeyChange, KeyTap, TextInput, Resize, Drop,
                           Focus, CloseRequest, VideoEnd>;

}  // namespace tendril::app
