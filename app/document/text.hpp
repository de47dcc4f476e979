// Texts for people, wherever they come from.
#pragma once

#include <string>
#include <string_view>

namespace tendril::app {

/// Control characters, line breaks above all, become blanks: a message stays one line, whatever it quotes.
inline std::string single_line(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return text;
}

/// Letters of ASCII alone: std::tolower would ask the locale.
inline std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

}  // namespace tendril::app
