// What the parameters of filters do, for tooltips.
#pragma once

#include <string_view>

namespace tendril::app {

/// Of a kind of filter and a parameter of it, both as the library's table names them. Empty for an unknown
/// one.
const char* parameter_help(std::string_view kind, std::string_view parameter);

}  // namespace tendril::app
