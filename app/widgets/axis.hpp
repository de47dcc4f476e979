// The marks of an axis: their spacing and their texts.
#pragma once

#include <string>

namespace tendril::app {

/// The smallest of ..., 0.1, 0.2, 0.5, 1, 2, 5, ... that is at least `smallest`.
double axis_step(double smallest);
/// All marks have the unit of the largest one, and the decimals that a step needs: "0.5 s" and "2 s" for
/// steps of 0.5 up to 2, "100 ms" for steps of 0.1 up to 0.5.
std::string axis_text(double value, double step, double largest, const char* unit);

}  // namespace tendril::app
