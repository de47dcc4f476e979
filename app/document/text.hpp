// Makes text from any source safe to store and display.
#pragma once

#include <string>
#include <string_view>

namespace tendril::app {

/// True for valid UTF-8 without U+FFFD. Files and recordings replace invalid bytes by U+FFFD, so other text
/// would not read back unchanged.
bool is_storable(std::string_view bytes);

/// Converts any bytes to one line of valid UTF-8. Control characters become spaces, so that a file cannot
/// control a terminal; invalid bytes become question marks.
std::string printable(std::string_view bytes);

/// The same, shortened to 400 bytes by omitting the middle: a message begins with the location and ends with
/// the reason.
std::string message(std::string_view text);

/// Prints an error to stderr, as a message().
void complain(std::string_view what);

/// Decodes %20 and the like in a URI; an invalid sequence stays.
std::string percent_decoded(std::string_view uri);

/// ASCII letters only: std::tolower depends on the locale.
inline std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

/// "Chest, Toes"
std::string comma_list(const auto& words) {
    std::string text;
    for (const auto& each : words) (text += text.empty() ? "" : ", ") += each;
    return text;
}

/// The text with its first letter in upper case.
inline std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

}  // namespace tendril::app
