// What the inputs of units do, for tooltips.
#pragma once

#include <string_view>

namespace tendril::app {

/// Of an operation, as scene files name it, and the path of an input (unit_inputs.hpp).
const char* input_help(std::string_view operation, std::string_view path);
/// What an operation does, in a sentence.
const char* operation_help(std::string_view operation);

}  // namespace tendril::app
