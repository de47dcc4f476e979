// How a typed command may go on: its arguments, and the values that one of them can be given.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/shell/command_line.hpp"

namespace tendril::app {

struct Workspace;

/// A way to go on.
struct CompletionRow {
    std::string text;    ///< "length=", "reach"
    std::string detail;  ///< "a number, 0 to 1", "now"
    std::string help;
    std::string line;    ///< the whole line, once this is chosen
    bool given = false;  ///< it stands in the line already
};

/// More would not be read; typing narrows them down.
inline constexpr std::size_t max_rows = 200;

/// At most that many. Values that begin with what is typed come first, then those that have it in the middle;
/// where an argument has none to offer, and before its "=", the arguments: required ones first, given ones
/// last. What the document has to be named is asked of `workspace`. Of a line without a command: nothing.
std::vector<CompletionRow> completions(const TypedLine& typed, const std::string& line,
                                       const Workspace& workspace);

/// The line as Tab completes it: by what all rows that begin with what is typed have in common, or, where
/// that is no more than is there, by the chosen row.
std::string completed(const TypedLine& typed, const std::string& line, const std::vector<CompletionRow>& rows,
                      std::size_t chosen);

/// What all of them begin with.
std::string common_prefix(const std::vector<std::string>& texts);

}  // namespace tendril::app
