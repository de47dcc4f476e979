// A number field that is dragged sideways, or typed into after a click.
//
// A click selects the number's text; typing takes effect on Enter, Tab or a click elsewhere, and Escape
// cancels it. read_number() defines the syntax: "1/3", "30 cm". Invalid input turns red, with the reason
// below it. Tab moves to the next enabled number. A drag is clamped to the range; Shift makes it ten times
// finer.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "app/widgets/fields.hpp"

namespace tendril::app {

struct RowSearch;

/// The last row with a field: its position, and its number's range, for explain().
struct RowAbove {
    int frame = -1;         ///< the frame in which it was drawn
    glm::vec2 from{0.0f};   ///< start of its name
    glm::vec2 field{0.0f};  ///< start of its last field
    bool has_range = false;
    double low = 0.0, high = 0.0;
    std::array<char, 48> format{};  ///< for the unit
};

/// The text field being edited; its text outlives the frame in which another item takes the focus.
struct TextEditing {
    unsigned id = 0;  ///< the field's; 0: none
    int frame = 0;    ///< the last frame in which it was drawn
    std::array<char, 1024> text{}, before{};
    unsigned wanted = 0;   ///< the field that is about to take the keyboard
    int wanted_until = 0;  ///< the last frame in which it may take it
};

/// The state of number fields: the one being edited, and its text. ImGui's UserData points to it.
struct NumberEditing {
    unsigned id = 0;     ///< the field's; 0: none
    int frame = 0;       ///< the last frame in which it was drawn
    bool begins = true;  ///< the text must take the keyboard focus
    std::array<char, 128> text{}, before{};
    int tabbed_in = -1;     ///< the frame in which Tab left a number: edit the next one
    bool entered = false;   ///< a typed number took effect since this was last read and reset
    std::string refused{};  ///< invalid text that the user left, with the reason; empty: none
    TextEditing typed;
    RowAbove row;
    OpenList list;
    glm::vec2 middle_min{0.0f}, middle_max{0.0f};  ///< between panels and bars: see tooltip.hpp
    bool covered = false;                          ///< a sheet lies over panels and bars
    RowSearch* search = nullptr;                   ///< the search in progress; see row_search.hpp
};

NumberEditing& number_editing();

/// Returns the new number in a frame in which the user changed it. `format` is a printf format with the unit
/// after the number. `whole`: only whole numbers are valid. `at_zero`: shown instead of 0, such as "never".
std::optional<double> number_entry(const char* id, double value, double speed, double low, double high,
                                   const char* format, bool whole = false, const char* at_zero = nullptr);

// Parses text typed into a number field: a number or an arithmetic expression, with or without a unit.
//
//     read_number("1/3", "").value            // 0.333...
//     read_number("30 cm", "m").value         // 0.3
//     read_number("2*pi rad", "\u00b0").value // 360
//     read_number("three", "m").error         // "three" is not a number

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
