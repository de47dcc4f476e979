#include "app/window/keys.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "app/io/text.hpp"

namespace tendril::app {
namespace {

struct KeyText {
    std::string_view name;   ///< in scripts: lower case
    std::string_view label;  ///< for display
};

// In the order of Key.
// clang-format off
constexpr std::array<KeyText, static_cast<std::size_t>(Key::Count)> texts{{
    {"", ""},
    {"a", "A"}, {"b", "B"}, {"c", "C"}, {"d", "D"}, {"e", "E"}, {"f", "F"}, {"g", "G"},
    {"h", "H"}, {"i", "I"}, {"j", "J"}, {"k", "K"}, {"l", "L"}, {"m", "M"}, {"n", "N"},
    {"o", "O"}, {"p", "P"}, {"q", "Q"}, {"r", "R"}, {"s", "S"}, {"t", "T"}, {"u", "U"},
    {"v", "V"}, {"w", "W"}, {"x", "X"}, {"y", "Y"}, {"z", "Z"},
    {"0", "0"}, {"1", "1"}, {"2", "2"}, {"3", "3"}, {"4", "4"},
    {"5", "5"}, {"6", "6"}, {"7", "7"}, {"8", "8"}, {"9", "9"},
    {"f1", "F1"}, {"f2", "F2"}, {"f3", "F3"}, {"f4", "F4"}, {"f5", "F5"}, {"f6", "F6"},
    {"f7", "F7"}, {"f8", "F8"}, {"f9", "F9"}, {"f10", "F10"}, {"f11", "F11"}, {"f12", "F12"},
    {"escape", "Esc"}, {"enter", "Enter"}, {"tab", "Tab"}, {"backspace", "Backspace"},
    {"delete", "Delete"}, {"insert", "Insert"}, {"space", "Space"},
    {"left", "Left"}, {"right", "Right"}, {"up", "Up"}, {"down", "Down"},
    {"home", "Home"}, {"end", "End"}, {"page_up", "Page Up"}, {"page_down", "Page Down"},
    {".", "."}, {",", ","}, {"/", "/"}, {"-", "-"}, {"=", "="}, {"?", "?"},
    {"shift", "Shift"}, {"ctrl", "Ctrl"}, {"alt", "Alt"}, {"super", "Super"},
}};
// clang-format on

const KeyText& text_of(Key key) {
    const auto index = static_cast<std::size_t>(key);
    return index < texts.size() ? texts[index] : texts[0];
}

template <typename Text>
std::string joined(const Chord& chord, Text text) {
    std::string result;
    if (chord.ctrl) result.append(text(Key::Ctrl)).append("+");
    if (chord.shift) result.append(text(Key::Shift)).append("+");
    if (chord.alt) result.append(text(Key::Alt)).append("+");
    return result.append(text(chord.key));
}

/// Sets the modifier; false if the name is not a modifier or a repeated one.
bool add_modifier(Chord& chord, std::string_view name) {
    bool* const modifier = name == "ctrl"    ? &chord.ctrl
                           : name == "shift" ? &chord.shift
                           : name == "alt"   ? &chord.alt
                                             : nullptr;
    if (modifier == nullptr || *modifier) return false;
    *modifier = true;
    return true;
}

}  // namespace

std::string_view key_name(Key key) {
    return text_of(key).name;
}

std::optional<Key> key_from_name(std::string_view name) {
    if (name.empty()) return std::nullopt;
    const std::string wanted = lower_case(name);
    const auto found =
        std::find_if(texts.begin(), texts.end(), [&](const KeyText& t) { return t.name == wanted; });
    if (found == texts.end()) return std::nullopt;
    return static_cast<Key>(found - texts.begin());
}

std::string chord_name(const Chord& chord) {
    return joined(chord, [](Key key) { return text_of(key).name; });
}

std::string chord_label(const Chord& chord) {
    return joined(chord, [](Key key) { return text_of(key).label; });
}

std::optional<Chord> chord_from_name(std::string_view name) {
    std::string rest = lower_case(name);
    Chord chord;
    for (std::size_t plus = rest.find('+'); plus != std::string::npos; plus = rest.find('+')) {
        if (!add_modifier(chord, std::string_view(rest).substr(0, plus))) return std::nullopt;
        rest.erase(0, plus + 1);
    }
    const std::optional<Key> key = key_from_name(rest);
    if (!key) return std::nullopt;
    chord.key = *key;
    return chord;
}

}  // namespace tendril::app
