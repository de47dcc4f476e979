// Expectations about the state that --state writes, for scripts and for cards of things to try.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "app/io/json.hpp"

namespace tendril::app {

/// Compares a value of the state, by its path ("segments.3.length"), by exactly one measure.
/// Equals: deep equality, with numbers compared as 32-bit floats. Near: a number, or a list of them (a
/// point), at a distance of at most `within`. Below and Above: strict comparisons of numbers.
struct Expect {
    enum class Measure { Equals, Near, Below, Above } measure = Measure::Equals;
    std::string path;
    SharedJson value;
    double within = 1e-4;  ///< for Near
};

/// From {"expect": "target.1", "above": 1}. Throws std::runtime_error for anything else.
Expect read_expectation(const Json& line);

/// Finds "segments.3.length" in a state; numbers index lists. Null if there is no such value.
const Json* find_in_state(const Json& state, std::string_view path);

/// Empty if the state is as expected; else one line about the value found.
std::string check_expectation(const Expect& expect, const Json& state);

/// Throws std::runtime_error for a member of `line` that is not in the list.
void check_members(const Json& line, std::initializer_list<std::string_view> known);

}  // namespace tendril::app
