// Text to store and display: made safe, whatever its source; and numbers with their units.
#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

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
/// The file names that a glTF URI may mean, the likeliest first: decoded ("%20"), as written, with slashes.
std::vector<std::string> names_of_uri(const std::string& uri);

/// std::from_chars, which LLVM's library has for numbers with a point only since version 20.
std::from_chars_result read_double(const char* first, const char* last, double& value,
                                   std::chars_format format = std::chars_format::general);

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

// Formats numbers with units for display.

/// A number with a fixed count of decimals; zero never has a sign.
std::string fixed_text(double value, int decimals);

/// Removes the sign of a negative zero: "-0.00 m" becomes "0.00 m".
std::string without_signed_zero(std::string text);

/// "1 joint", "8 joints": for nouns whose plural takes an s.
std::string count_text(std::size_t count, const char* noun);

/// "12.3 mm", "1.20 m": a length in metres, for bodies and rigs.
std::string length_text(double metres);
/// "9.5 mm", "12 cm", "1.20 m": a distance in metres, for sentences.
std::string rounded_length_text(double metres);
/// "1.2 mm"; "none" below a hundredth of a millimetre.
std::string error_text(double metres);

/// Three digits, with an SI prefix if needed: "2.30 m", "4.10 µs", "120 nm", "0 m". `unit` has no prefix
/// ("m", "s"); a value that is not finite becomes "-".
std::string si_text(double value, const char* unit);

/// For curves and tables: SI units as si_text but without trailing zeros ("2 s", "1.5 mm"); others with three
/// significant digits, at most nine decimals and no prefix ("0.0012 %", "12").
std::string short_text(double value, const char* unit);

}  // namespace tendril::app
