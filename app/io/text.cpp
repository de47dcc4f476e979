#include "app/io/text.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string_view>

namespace tendril::app {
namespace {

constexpr std::size_t max_message = 400;
constexpr std::size_t message_end = 120;  ///< bytes kept of a shortened message's end

bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Size of the UTF-8 character at `at`; 0 if none begins there. Overlong forms and surrogates are invalid.
std::size_t character_at(std::string_view bytes, std::size_t at) {
    const auto first = static_cast<unsigned char>(bytes[at]);
    if (first < 0x80) return 1;
    const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || size > bytes.size() - at) return 0;
    std::uint32_t code = first & (0x7fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if (!is_continuation(bytes[at + i])) return 0;
        code = (code << 6) | (static_cast<unsigned char>(bytes[at + i]) & 0x3fu);
    }
    if (size == 3 && (code < 0x800 || (code >= 0xd800 && code <= 0xdfff))) return 0;
    if (size == 4 && (code < 0x10000 || code > 0x10ffff)) return 0;
    return size;
}

bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return first < 0x20 || first == 0x7f;
    return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;  // U+0080 to U+009F
}

/// "2.50" as "2.5", "2.00" as "2".
std::string without_last_zeros(std::string number) {
    if (number.find('.') == number.npos) return number;
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return number;
}

bool takes_prefix(std::string_view unit) {
    return unit == "m" || unit == "s" || unit == "J" || unit == "N";
}

}  // namespace

bool is_storable(std::string_view bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t size = character_at(bytes, at);
        if (size == 0 || bytes.substr(at, size) == "\xEF\xBF\xBD") return false;
        at += size;
    }
    return true;
}

std::string printable(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size());
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t size = character_at(bytes, at);
        const std::string_view character = bytes.substr(at, size);
        if (size == 0)
            text += '?';
        else if (is_control(character))
            text += ' ';
        else
            text += character;
        at += size == 0 ? 1 : size;
    }
    return text;
}

std::string message(std::string_view text) {
    std::string shown = printable(text);
    if (shown.size() <= max_message) return shown;
    constexpr std::string_view gap = " ... ";
    std::size_t head = max_message - message_end - gap.size(), tail = shown.size() - message_end;
    while (is_continuation(shown[head])) --head;
    while (is_continuation(shown[tail])) ++tail;
    return shown.substr(0, head) + std::string(gap) + shown.substr(tail);
}

std::string percent_decoded(std::string_view uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned char byte = 0;
        const char* const hex = uri.data() + i + 1;
        const bool coded =
            uri[i] == '%' && i + 2 < uri.size() && std::from_chars(hex, hex + 2, byte, 16).ptr == hex + 2;
        result += coded ? static_cast<char>(byte) : uri[i];
        if (coded) i += 2;
    }
    return result;
}

std::vector<std::string> names_of_uri(const std::string& uri) {
    const std::string decoded = percent_decoded(uri);
    std::string slashes = decoded;
    std::ranges::replace(slashes, '\\', '/');
    return {decoded, uri, slashes};
}

void complain(std::string_view what) {
    std::fprintf(stderr, "tendril: %s\n", message(what).c_str());
}

std::string without_signed_zero(std::string text) {
    const std::size_t end = text.find_first_not_of("0.", 1);
    const bool number_ends = end == text.npos || (text[end] != 'e' && (text[end] < '0' || text[end] > '9'));
    if (text.size() > 1 && text[0] == '-' && end != 1 && number_ends) text.erase(0, 1);
    return text;
}

std::string fixed_text(double value, int decimals) {
    char text[400];  // a double has up to 309 digits before its point
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return without_signed_zero(text);
}

std::string length_text(double metres) {
    return std::abs(metres) < 1.0 ? fixed_text(1000.0 * metres, 1) + " mm" : fixed_text(metres, 2) + " m";
}

std::string rounded_length_text(double metres) {
    return metres < 0.0095  ? length_text(metres)
           : metres < 0.995 ? fixed_text(100.0 * metres, 0) + " cm"
                            : fixed_text(metres, 2) + " m";
}

std::string error_text(double metres) {
    return std::abs(metres) < 1e-5 ? "none" : si_text(metres, "m");
}

std::string count_text(std::size_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string short_text(double value, const char* unit) {
    if (takes_prefix(unit)) {
        const std::string text = si_text(value, unit);
        const std::size_t space = text.find(' ');
        return space == text.npos ? text : without_last_zeros(text.substr(0, space)) + text.substr(space);
    }
    if (!std::isfinite(value)) return "-";
    const int power = value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
    const std::string number = without_last_zeros(fixed_text(value, std::clamp(2 - power, 0, 9)));
    return *unit == '\0' ? number : number + " " + unit;
}

std::string si_text(double value, const char* unit) {
    static constexpr const char* prefixes[] = {"p", "n", "\xc2\xb5", "m", "", "k", "M", "G"};
    constexpr int plain = 4, last = static_cast<int>(std::size(prefixes)) - 1;
    if (!std::isfinite(value)) return "-";
    if (std::abs(value) < 5e-15) return std::string("0 ") + unit;  // smaller than the smallest prefix shows
    int prefix = plain;
    // 999.5 would be written 1000.
    while (std::abs(value) >= 999.5 && prefix < last) value /= 1000.0, ++prefix;
    while (std::abs(value) < 0.9995 && prefix > 0) value *= 1000.0, --prefix;
    const double size = std::abs(value);
    const int decimals = size < 9.995 ? 2 : size < 99.95 ? 1 : 0;
    char text[48];
    std::snprintf(text, sizeof text, "%.*f %s%s", decimals, value, prefixes[prefix], unit);
    return text;
}

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
std::from_chars_result read_double(const char* first, const char* last, double& value,
                                   std::chars_format format) {
    const bool hex = format == std::chars_format::hex;
    const std::string_view digits = hex ? "0123456789abcdefABCDEF" : "0123456789";
    const char* at = first;
    const auto take_digits = [&] {
        const char* const before = at;
        while (at != last && digits.find(*at) != digits.npos) ++at;
        return at - before;
    };
    const auto take = [&](char lower) { return at != last && (*at | 0x20) == lower ? ++at, true : false; };
    std::string number;
    if (at != last && *at == '-') number += *at++;
    const char* const unsigned_start = at;
    for (const std::string_view word : {"infinity", "inf", "nan"})
        if (lower_case({at, std::min(last, at + word.size())}) == word) {
            at += word.size();
            break;
        }
    if (at == unsigned_start) {
        auto count = take_digits();
        if (at != last && *at == '.') {
            ++at;
            count += take_digits();
        }
        if (count == 0) return {first, std::errc::invalid_argument};
        const char* const mantissa_end = at;
        if (take(hex ? 'p' : 'e')) {
            if (at != last && (*at == '+' || *at == '-')) ++at;
            const char* const exponent = at;
            while (at != last && *at >= '0' && *at <= '9') ++at;
            if (at == exponent) at = mantissa_end;
        }
        if (hex) number += "0x";
    }
    number.append(unsigned_start, at);
    errno = 0;
    const double read = std::strtod(number.c_str(), nullptr);  // rounds as from_chars does
    if (errno == ERANGE && (std::isinf(read) || read == 0.0)) return {at, std::errc::result_out_of_range};
    value = read;
    return {at, std::errc()};
}
#else
std::from_chars_result read_double(const char* first, const char* last, double& value,
                                   std::chars_format format) {
    return std::from_chars(first, last, value, format);
}
#endif

}  // namespace tendril::app
