#include "app/shell/input.hpp"

namespace tendril::app {

void Input::tap(const Chord& chord, bool down) {
    if (!down) {
        keys_ = before_tap_;
        return;
    }
    before_tap_ = keys_;
    if (chord.ctrl) hold(Key::Ctrl, true);
    if (chord.shift) hold(Key::Shift, true);
    if (chord.alt) hold(Key::Alt, true);
    hold(chord.key, true);
}

void Input::take(const Event* event) {
    if (tapped_.key != Key::Unknown) {
        tap(tapped_, false);
        tapped_ = {};
    }
    pressed_ = {};
    if (event == nullptr) return;

    if (const auto* move = std::get_if<MouseMove>(event)) {
        mouse_ = move->at;
    } else if (const auto* press = std::get_if<MousePress>(event)) {
        buttons_[static_cast<std::size_t>(press->button)] = press->down;
    } else if (const auto* key = std::get_if<KeyChange>(event)) {
        hold(key->key, key->down);
        if (key->down) pressed_ = {key->key, ctrl(), shift(), alt()};
        // "?" is known by what it writes, whatever is held to write it.
        if (key->key == Key::Question) pressed_.shift = pressed_.alt = false;
    } else if (const auto* key_tap = std::get_if<KeyTap>(event)) {
        tapped_ = key_tap->chord;
        tap(tapped_, true);
        pressed_ = {tapped_.key, ctrl(), shift(), alt()};
    } else if (const auto* focus = std::get_if<Focus>(event); focus != nullptr && !focus->focused) {
        keys_.reset();  // whatever is let go elsewhere is not told here
        buttons_ = {};
    }
}

}  // namespace tendril::app
