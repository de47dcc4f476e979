// Several things that have names, for a command that does the same to all. gives_one() of index_list.hpp
// says whether one is given, or several.
#pragma once

#include <string>
#include <vector>

#include "app/document/argument.hpp"

namespace tendril::app {

/// May be left out: `instead_of` names the one that is given then. `more` is said of it in addition.
Argument name_list_argument(const char* name, const char* instead_of, const char* more = "");
/// As they are given. Throws Refused, with the argument and the value, for what is no text.
std::vector<std::string> name_list(const Arguments& given, const char* name);

/// "Head, LeftHand": of many names only the first, and dots.
std::string name_list_text(const std::vector<std::string>& names);

}  // namespace tendril::app
