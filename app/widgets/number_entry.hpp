// A number that is dragged sideways, or typed after a click.
//
// A click selects the number's text; typing changes nothing until Enter, Tab or a click elsewhere, Escape
// takes it back. What may be typed is in expression.hpp: "1/3", "30 cm". Invalid input turns red, with the
// reason below it. Tab goes on to the next number that can be changed. A drag ends at the range; Shift makes
// it ten times finer.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

namespace tendril::app {

/// The last row that has a field: where it is, and what its number may be, for the text that explains it.
struct RowAbove {
    int frame = -1;         ///< in which it was drawn
    glm::vec2 from{0.0f};   ///< where its name begins
    glm::vec2 field{0.0f};  ///< and its last field
    bool has_range = false;
    double low = 0.0, high = 0.0;
    std::array<char, 48> format{};  ///< for the unit
};

/// What of numbers is the interface's own: which one's text is edited. ImGui's UserData points at it.
struct NumberEditing {
    unsigned id = 0;     ///< of the field; 0: none
    int frame = 0;       ///< in which it was drawn last
    bool begins = true;  ///< the text takes the keyboard
    std::array<char, 128> text{}, before{};
    int tabbed_in = -1;     ///< the frame in which Tab left a number: the next one is edited
    bool entered = false;   ///< a typed number has counted, since this was last asked
    std::string refused{};  ///< what was typed and left though it is invalid, with the reason; empty: nothing
    RowAbove row;
};

/// The new number, in a frame in which a person has changed it. `format` as of printf; behind the number its
/// unit. `whole`: others are invalid.
std::optional<double> number_entry(const char* id, double value, double speed, double low, double high,
                                   const char* format, bool whole = false);

}  // namespace tendril::app
