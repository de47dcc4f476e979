// Completions of a typed command: its arguments, and the values of the argument being typed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/shell/command_line.hpp"

namespace tendril::app {

struct Workspace;

/// One completion.
struct CompletionRow {
    std::string text;    ///< "length=", "reach"
    std::string detail;  ///< "a number, 0 to 1", "now"
    std::string help;
    std::string line;    ///< the whole line after choosing this row
    bool given = false;  ///< the line already contains it
};

/// Further rows are omitted until typing narrows the list.
inline constexpr std::size_t max_rows = 200;

/// At most max_rows completions; none for a line without a command. Values that begin with the typed text
/// come first, then those that contain it. If the argument has no values to offer, or before its "=", the
/// arguments: required ones first, given ones last. Names of existing objects come from `workspace`.
std::vector<CompletionRow> completions(const TypedLine& typed, const std::string& line,
                                       const Workspace& workspace);

/// The line after Tab: extended to the common prefix of all rows that begin with the typed text or, if that
/// adds nothing, to the chosen row.
std::string completed(const TypedLine& typed, const std::string& line, const std::vector<CompletionRow>& rows,
                      std::size_t chosen);

/// The longest common prefix.
std::string common_prefix(const std::vector<std::string>& texts);

}  // namespace tendril::app
