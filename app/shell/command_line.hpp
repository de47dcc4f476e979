// A command as it is typed in the palette, `chain.add length=1.5 position=[0,1,0]`: a name, then arguments as
// JSON, where a bare word is a text. What is there so far is read while it is typed.
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
/// Throws std::runtime_error naming the piece that it cannot read.
TypedCommand read_typed_command(const std::string& line);

/// "length=1.5", or "len" where no "=" has been typed yet.
struct TypedArgument {
    std::string name;
    std::string value;
    bool assigned = false;  ///< there is a "=" behind the name
};

/// A line whose first word is a command's name, with a blank behind it.
struct TypedLine {
    const Command* command = nullptr;    ///< of the table; null where the line is no more than a search
    std::vector<TypedArgument> given{};  ///< those with a blank behind them
    TypedArgument last{};                ///< the one that is being typed; empty behind a blank
    std::size_t last_at = 0;             ///< where in the line it begins

    /// What stands for that argument, `last` included where it has its "="; null where it is not given.
    const TypedArgument* find(const std::string& name) const;
};
TypedLine read_typed_line(const CommandTable& table, const std::string& line);

/// The argument of a command of that name; null where it has none.
const Argument* find_argument(const Command& command, const std::string& name);

/// What is wrong with it already, in words; empty where going on typing may still make it right. What is only
/// missing is not wrong yet.
std::string mistake(const TypedLine& line);
/// "length is missing (a number): metres", of the first required argument without a value; empty where there
/// is none.
std::string missing(const TypedLine& line);

/// A text as the line takes it: in quotes where it has blanks, or would be read as something else.
std::string quoted(const std::string& text);

}  // namespace tendril::app
