// Checks a value against its argument, and describes in words what the argument accepts.
#pragma once

#include <string>

#include "app/document/argument.hpp"

namespace tendril::app {

/// "a number", "a point [x, y, z]"
std::string type_text(ArgumentType type);
/// With range and choices: "a number, 0 to 1", "one of dark, light".
std::string rule_text(const Argument& argument);

/// Throws Refused if the value does not fit. The message begins with `where`: "chain.add: length".
void check_value(const Argument& argument, const Json& value, const std::string& where);

}  // namespace tendril::app
