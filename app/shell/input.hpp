// The keys and buttons held now, accumulated from events.
#pragma once

#include <array>
#include <bitset>
#include <glm/vec2.hpp>

#include "app/window/event.hpp"

namespace tendril::app {

class Input {
  public:
    /// Takes one event, or none.
    void take(const Event* event);
    /// Releases the keys of a KeyTap; call within its tick, after handling it.
    void end_tap();

    glm::vec2 mouse() const { return mouse_; }
    bool button(MouseButton b) const { return buttons_[static_cast<std::size_t>(b)]; }
    /// True if the last press was a finger's.
    bool by_finger() const { return by_finger_; }
    bool held(Key key) const { return keys_[static_cast<std::size_t>(key)]; }
    /// True if the key is held and was not pressed in a chord with Ctrl or Alt.
    bool held_alone(Key key) const { return held(key) && !in_chord_[static_cast<std::size_t>(key)]; }
    bool ctrl() const { return held(Key::Ctrl); }
    bool shift() const { return held(Key::Shift); }
    bool alt() const { return held(Key::Alt); }
    /// The chord that this tick's event pressed; Key::Unknown if none.
    Chord pressed() const { return pressed_; }
    /// True if the key was already down: a repeat.
    bool repeated() const { return repeated_; }
    const std::bitset<static_cast<std::size_t>(Key::Count)>& keys() const { return keys_; }

  private:
    void hold(Key key, bool down) { keys_[static_cast<std::size_t>(key)] = down; }
    glm::vec2 mouse_{-1.0f};
    std::array<bool, 3> buttons_{};
    std::bitset<static_cast<std::size_t>(Key::Count)> keys_, in_chord_;
    Chord pressed_;
    bool tapped_ = false, repeated_ = false, by_finger_ = false;
    std::bitset<static_cast<std::size_t>(Key::Count)> before_tap_;
};

}  // namespace tendril::app
