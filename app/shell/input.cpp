#include "app/shell/input.hpp"

#include <utility>

namespace tendril::app {

void Input::end_tap() {
    if (std::exchange(tapped_, false)) keys_ = before_tap_;
}

void Input::take(const Event* event) {
    end_tap();
    pressed_ = {};
    repeated_ = false;
    if (event == nullptr) return;

    if (const auto* move = std::get_if<MouseMove>(event)) {
        mouse_ = move->at;
    } else if (const auto* press = std::get_if<MousePress>(event)) {
        buttons_[static_cast<std::size_t>(press->button)] = press->down;
        by_finger_ = press->by_finger;
    } else if (const auto* key = std::get_if<KeyChange>(event)) {
        repeated_ = key->down && held(key->key);
        hold(key->key, key->down);
        if (key->down && !repeated_) in_chord_[static_cast<std::size_t>(key->key)] = ctrl() || alt();
        if (key->down) pressed_ = {key->key, ctrl(), shift(), alt()};
        // "?" is identified by its text, whichever modifiers typed it.
        if (key->key == Key::Question) pressed_.shift = pressed_.alt = false;
    } else if (const auto* key_tap = std::get_if<KeyTap>(event)) {
        before_tap_ = keys_;
        tapped_ = true;
        const Chord& chord = key_tap->chord;
        for (const auto& [modifier, down] :
             {std::pair(Key::Ctrl, chord.ctrl), {Key::Shift, chord.shift}, {Key::Alt, chord.alt}}) {
            if (down) hold(modifier, true);
        }
        hold(chord.key, true);
        pressed_ = {chord.key, ctrl(), shift(), alt()};
    } else if (const auto* focus = std::get_if<Focus>(event); focus != nullptr && !focus->focused) {
        keys_.reset();  // releases in other windows are not reported
        buttons_ = {};
    }
}

}  // namespace tendril::app
