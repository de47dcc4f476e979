#include "app/document/units.hpp"

#include <cmath>
#include <cstdio>
#include <iterator>

namespace tendril::app {

std::string si_text(double value, const char* unit) {
    static constexpr const char* prefixes[] = {"p", "n", "\xc2\xb5", "m", "", "k", "M", "G"};
    constexpr int plain = 4, last = static_cast<int>(std::size(prefixes)) - 1;
    if (!std::isfinite(value)) return "-";
    if (std::abs(value) < 5e-15) return std::string("0 ") + unit;  // less than any prefix shows
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
