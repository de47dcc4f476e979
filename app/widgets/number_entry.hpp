// A number that is dragged sideways, or typed after a click.
//
// A click selects the number's text; typing changes nothing until Enter, Tab or a click elsewhere, Escape takes
// it back. What may be typed is in expression.hpp: "1/3", "30 cm". What is no number is red, with the reason
// below it. Tab goes on to the next number that is drawn. A drag ends at the range; Shift makes it ten times
// finer.
#pragma once

#include <optional>
#include <string>

namespace tendril::app {

/// The new number, in a frame in which a person has changed it. `format` as of printf; behind the number its
/// unit.
std::optional<double> number_entry(const char* id, double value, double speed, double low, double high,
                                   const char* format);

/// What was typed and left though it is no number, with the reason, since the last call; empty: nothing.
std::string refused_entry();

}  // namespace tendril::app
