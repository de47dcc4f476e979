// Helpers for scanning unparsed JSON text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace tendril::app {

/// The line, from 1, that contains `offset`.
inline int line_at(std::string_view text, std::size_t offset) {
    const auto before = text.substr(0, offset);
    return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
}

/// The end of the string that opens at `at`: past its closing quote, or the end of the text.
inline std::size_t string_end(std::string_view text, std::size_t at) {
    for (++at; at < text.size(); ++at) {
        if (text[at] == '\\')
            ++at;
        else if (text[at] == '"')
            return at + 1;
    }
    return text.size();
}

inline std::size_t skip_space(std::string_view text, std::size_t at) {
    return std::min(text.find_first_not_of(" \t\r\n", at), text.size());
}

/// The end of the value at `at`, by brackets and quotes alone; parsing it finds errors.
inline std::size_t skip_value(std::string_view text, std::size_t at) {
    int depth = 0;
    while (at < text.size()) {
        const char c = text[at];
        if (depth == 0 && (c == ',' || c == ']' || c == '}')) break;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        at = c == '"' ? string_end(text, at) : at + 1;
    }
    return at;
}

}  // namespace tendril::app
