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

}  // namespace tendril::app
