// What the files of this lab's commands share.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {

using ChainChange = void (*)(ChainPart&, const Arguments&);
/// One that solves too, with the lab's solvers.
using ChainSolve = std::function<void(ChainPart&, const Arguments&, ChainRuntime&)>;

/// A command on a copy of the lab's part.
Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainChange change, Effect effect = Effect::Edit);
Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainSolve change, Effect effect = Effect::Edit);

Argument index_argument(bool required, const char* help);

std::size_t index_of(const Arguments& given);
/// Throws Refused.
void check_index(const ChainPart& part, std::size_t index);

/// One joint or several, for a command that sets the same on all.
Argument joints_argument();
/// Those that `index` or `joints` names, as they are given. Throws Refused where neither or both are given,
/// or a joint is not there.
std::vector<std::size_t> joints_of(const Arguments& given, const ChainPart& part);

/// The same, ascending and each once, to set something on; one at least.
std::vector<std::size_t> joints_to_set(const Arguments& given, const ChainPart& part);

void add_shape_commands(CommandTable& table);
void add_mode_commands(CommandTable& table);
void add_reach_commands(CommandTable& table);
void add_study_commands(CommandTable& table);
void add_copy_commands(CommandTable& table);

// The Chain lab's commands: chain.*.

class CommandTable;

void add_chain_commands(CommandTable& table);

}  // namespace tendril::app
