// Parses text typed into a number field: a number or an arithmetic expression, with or without a unit.
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
    std::optional<double> value;  ///< in the field's unit; finite, or infinite on overflow
    std::string error;            ///< a sentence to display; empty if there is a value
};

/// Accepts numbers in C++ syntax, +, -, *, /, ^, parentheses and `pi`, then optionally a unit of the whole:
/// one of the same kind as the field's `unit` (lengths, angles, times, speeds, angular speeds, frequencies,
/// percentages).
TypedNumber read_number(std::string_view text, std::string_view unit);

/// The unit that follows the number in a printf format: "m" of "%.3f m", "%" of "%.0f %%".
std::string unit_of(std::string_view format);

}  // namespace tendril::app
