// The arguments that the commands of every lab are put together from.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/names.hpp"

namespace tendril::app {

Argument choice_argument(const char* name, bool required, const char* help, std::vector<std::string> choices);
// These may be left out.
Argument integer_argument(const char* name, const char* help, double low, double high);
Argument number_argument(const char* name, const char* help, double low, double high);
Argument switch_argument(const char* name, const char* help);
// These may be left out where not `required`.
Argument text_argument(const char* name, bool required, const char* help);
Argument point_argument(const char* name, bool required, const char* help);
/// One of `count` things that are counted from 0.
Argument index_argument(const char* name, bool required, const char* help, std::size_t count);
/// The same argument, for which the palette offers what is there to be named.
Argument offering(Argument argument, std::function<std::vector<std::string>(const Workspace&)> known);
/// "0", "1", ... to before `count`: for things that are counted.
std::vector<std::string> places(std::size_t count);

}  // namespace tendril::app
