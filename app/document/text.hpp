// Texts for people, wherever they come from.
#pragma once

#include <string>

namespace tendril::app {

/// Control characters, line breaks above all, become blanks: a message stays one line, whatever it quotes.
inline std::string single_line(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return text;
}

}  // namespace tendril::app
