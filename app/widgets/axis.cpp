#include "app/widgets/axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "app/document/units.hpp"

namespace tendril::app {

double axis_step(double smallest) {
    smallest = std::max(smallest, 1e-12) * (1.0 - 1e-6);  // 0.1 may come as a rounded 0.3 / 3
    const double decade = std::pow(10.0, std::floor(std::log10(smallest)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (decade * factor >= smallest) return decade * factor;
    return 10.0 * decade;
}

std::string axis_text(double value, double step, double largest, const char* unit) {
    const std::string longest = short_text(largest, unit);  // "500 ms"
    const std::size_t space = longest.find(' ');
    const double shown = std::strtod(longest.c_str(), nullptr);
    const double thousands = shown != 0.0 ? std::round(std::log10(largest / shown) / 3.0) : 0.0;
    const double factor = std::pow(1000.0, thousands);
    const int decimals = static_cast<int>(std::ceil(-std::log10(std::max(step / factor, 1e-9)) - 1e-4));
    std::string text = fixed_text(value / factor, std::clamp(decimals, 0, 9));
    if (text.find('.') != text.npos) text.erase(text.find_last_not_of("0") + 1);
    if (text.back() == '.') text.pop_back();
    return space == longest.npos ? text : text + longest.substr(space);
}

}  // namespace tendril::app
