// Several of many things, for a command that does the same to all: a list of indices, counted from 0; and
// what is not the same for all, another list.
#pragma once

#include <cstddef>
#include <vector>

#include "app/document/argument.hpp"
#include "app/document/json_place.hpp"

namespace tendril::app {

/// May be left out: `instead_of` names the one that is given then.
Argument index_list_argument(const char* name, const char* instead_of);
/// Whether one is given by its index, and not several by a list. Throws Refused where it is neither or both.
bool gives_one(const Arguments& given, const char* index, const char* list);
/// As they are given. Throws Refused, with the argument and the value, for what is no whole number below
/// `count`.
std::vector<std::size_t> index_list(const Arguments& given, const char* name, std::size_t count);

/// A list of values, one for each of the list that is called `of`. May be left out.
Argument each_argument(const char* name, const char* of);
/// Throws, with the argument, unless the list has `count` values.
JsonPlace each_list(const Arguments& given, const char* name, const char* of, std::size_t count);

}  // namespace tendril::app
