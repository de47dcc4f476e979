// Texts for people, wherever they come from.
#pragma once

#include <string>
#include <string_view>

namespace tendril::app {

/// True for valid UTF-8 without U+FFFD. Files and recordings replace invalid bytes by U+FFFD, so other text
/// would not read back.
bool is_storable(std::string_view bytes);

/// What any bytes look like in a message: one line of valid UTF-8. Control characters become blanks, so that
/// a file cannot steer a terminal, and bytes that are no UTF-8 become question marks.
std::string printable(std::string_view bytes);

/// The same, and at most 400 bytes: where it is longer, the middle gives way, since a message begins with the
/// place and ends with the reason.
std::string message(std::string_view text);

/// Says on stderr what went wrong, as a message().
void complain(std::string_view what);

/// Letters of ASCII alone: std::tolower would ask the locale.
inline std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

}  // namespace tendril::app
