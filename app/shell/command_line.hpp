// Commands as typed in the palette, `chain.add length=1.5 position=[0,1,0]`: parsed, completed, and found by
// a few words. A line is a name, then arguments as JSON, where a bare word is a text. Unfinished lines are
// parsed too, while the user types.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/io/json.hpp"

namespace tendril::app {

struct Argument;
struct Command;
class CommandTable;
struct Workspace;

struct TypedCommand {
    std::string name;
    SharedJson arguments;
};
/// Throws std::runtime_error naming the piece that is not valid.
TypedCommand read_typed_command(const std::string& line);

/// "length=1.5", or "len" before its "=" is typed.
struct TypedArgument {
    std::string name;
    std::string value;
    bool assigned = false;  ///< the name is followed by "="
};

/// A line that begins with a command's name and a blank.
struct TypedLine {
    const Command* command = nullptr;    ///< in the table; null if the line is only a search
    std::vector<TypedArgument> given{};  ///< arguments followed by a blank
    TypedArgument last{};                ///< the argument being typed; empty after a blank
    std::size_t last_at = 0;             ///< its offset in the line

    /// The typed argument of that name, including `last` if it has its "="; null if not given.
    const TypedArgument* find(const std::string& name) const;
};
TypedLine read_typed_line(const CommandTable& table, const std::string& line);

/// The command's argument of that name; null if it has none.
const Argument* find_argument(const Command& command, const std::string& name);

/// The mistake in the line; empty if more typing may still make it valid. Missing arguments are not mistakes.
std::string mistake(const TypedLine& line);
/// "length is missing (a number): metres", for the first required argument without a value; empty if there is
/// none.
std::string missing(const TypedLine& line);

/// A text in the line's syntax: quoted if it has blanks or would be parsed as something else.
std::string quoted(const std::string& text);

// Completions of a typed command: its arguments, and the values of the argument being typed.

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

// Finds commands by a few words, the likeliest first.

/// Commands that contain every word of the query in title, name, help or the name of an argument, ignoring
/// case. A command named exactly as the query comes first; then the open lab's and the program's own.
/// Among these, matches at the start of a word in the title rank before matches in the name, then come
/// matches inside the title, in the help, in the arguments. Among equal matches, commands that add
/// come first and commands that remove last. Without a query the most recently run come first (`recent`,
/// newest first). Arguments in the query are ignored.
std::vector<const Command*> search_commands(const CommandTable& table, const std::string& query,
                                            std::string_view open_lab = {},
                                            std::span<const std::string> recent = {});

}  // namespace tendril::app
