// What a person types into a number's field: a number, a sum of such, with or without a unit.
//
//     read_number("1/3", "").value            // 0.333...
//     read_number("30 cm", "m").value         // 0.3
//     read_number("2*pi rad", "\u00b0").value // 360
//     read_number("three", "m").error         // "three" is not a number
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tendril::app {

struct TypedNumber {
    std::optional<double> value;  ///< in the field's unit; finite, or an infinity where it is too large
    std::string error;            ///< a sentence for people; empty where there is a value
};

/// Numbers as C++ writes them, +, -, *, /, ^, parentheses, `pi`; then a unit, which counts for the whole:
/// one of the same kind as the field's `unit` (lengths, angles, times, speeds, frequencies, shares), or none.
TypedNumber read_number(std::string_view text, std::string_view unit);

/// The unit behind the number of a printf format: "m" of "%.3f m", "%" of "%.0f %%".
std::string unit_of(std::string_view format);

}  // namespace tendril::app
