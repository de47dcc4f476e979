// Expectations of the state that --state writes: of scripts, and of the cards of things to try.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "app/document/json.hpp"

namespace tendril::app {

/// A value of the state, by its path ("segments.3.length"), held against exactly one measure.
/// Equals: the same value throughout, numbers as 32-bit floats. Near: a number, or a list of them (a point),
/// whose distance is at most `within`. Below and Above: a number strictly so.
struct Expect {
    enum class Measure { Equals, Near, Below, Above } measure = Measure::Equals;
    std::string path;
    SharedJson value;
    double within = 1e-4;  ///< for Near
};

/// From {"expect": "target.1", "above": 1}. Throws std::runtime_error for what is none.
Expect read_expectation(const Json& line);

/// Finds "segments.3.length" in a state, a number being an index into a list; nothing where there is no such
/// value.
const Json* find_in_state(const Json& state, std::string_view path);

/// Empty when the state is as expected; else what was found, in one line.
std::string check_expectation(const Expect& expect, const Json& state);

/// Throws std::runtime_error for a member of `line` that is not in the list.
void check_members(const Json& line, std::initializer_list<std::string_view> known);

}  // namespace tendril::app
