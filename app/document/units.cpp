#include "app/document/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string_view>

namespace tendril::app {
namespace {

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

}  // namespace tendril::app
