// Commands as typed in the palette, `chain.add length=1.5 position=[0,1,0]`: a name, then arguments as JSON,
// where a bare word is a text. Unfinished lines are parsed too, while the user types.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/document/json.hpp"

namespace tendril::app {

struct Argument;
struct Command;
class CommandTable;

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

}  // namespace tendril::app
