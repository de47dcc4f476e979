// Reads points from text that was copied anywhere: a table, a spreadsheet, JSON, or source code.
//
// A row is three numbers, on a line of their own or in brackets of their own. Spaces, tabs, commas and
// semicolons separate numbers; (), [] and {} may nest; x=, Y=, "z": name coordinates; constructors such as
// Vector3(1, 2, 3), vec3(...) and new Vector3(1f, 2f, 3f) are read like brackets. A first line "x y z" is
// skipped. Anything else, and any number that is not finite and at most 1e9 in magnitude, is refused.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

namespace tendril::app {

/// At least one and at most `most` points. Throws std::runtime_error with the line, from 1, and what was
/// found there: `line 3: expected three numbers, found two`.
std::vector<glm::vec3> read_points(std::string_view text, std::size_t most);

inline constexpr std::size_t max_pasted_points = 10'000;

}  // namespace tendril::app
