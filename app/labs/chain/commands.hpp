// The Chain lab's commands, chain.*, and declarations that their files share.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/command.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/mouse.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {

using ChainChange = void (*)(ChainPart&, const Arguments&);
/// A change that also solves, with the lab's solvers.
using ChainSolve = std::function<void(ChainPart&, const Arguments&, ChainRuntime&)>;

/// A command that edits a copy of the lab's part.
Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainChange change, Effect effect = Effect::Edit);
Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainSolve change, Effect effect = Effect::Edit);

Argument index_argument(bool required, const char* help);

std::size_t index_of(const Arguments& given);
/// Throws Refused if there is no such segment.
void check_index(const ChainPart& part, std::size_t index);

/// An optional list of joints, for a command that sets the same on all.
Argument joints_argument();
/// The joints that `index` or `joints` names, in the order given. Throws Refused if both or neither are
/// given, or if a joint does not exist.
std::vector<std::size_t> joints_of(const Arguments& given, const ChainPart& part);

/// The same, ascending and without duplicates; at least one.
std::vector<std::size_t> joints_to_set(const Arguments& given, const ChainPart& part);

/// Pulls joints as chain.pull does; ascending and without duplicates.
void pull_joints(ChainPart& part, const std::vector<JointPull>& pulls, ChainRuntime& runtime);
/// A chain with one joint at each point.
Chain chain_through(const std::vector<glm::vec3>& points);
/// Replaces the chain and puts the target on its tail or, in a trailing mode, on the led joint. Removes
/// limits and the pole target.
void take_chain(ChainPart& part, Chain chain);
/// Solves again for the current target, in mode Reach.
void reach_again(ChainPart& part, ChainRuntime& runtime);

/// Throws Refused if no race is open.
void check_race(const ChainPart& part);

void add_shape_commands(CommandTable& table);
void add_mode_commands(CommandTable& table);
void add_reach_commands(CommandTable& table);
void add_curve_command(CommandTable& table);
void add_study_commands(CommandTable& table);
/// race.copy, race.save and race.record.
void add_race_file_commands(CommandTable& table);
void add_copy_commands(CommandTable& table);
void add_paste_command(CommandTable& table);
/// chain.save_trace: writes the strip's moments in the format that `tendril trace` reads.
void add_save_trace_command(CommandTable& table);

/// Whether a file's text begins like a trace, for Lab::files().
bool begins_like_trace(std::string_view text);

/// Whether pasted text is a trace: two frames or more, or a pose with a target.
bool holds_trace(const std::string& text);

class CommandTable;

void add_chain_commands(CommandTable& table);

}  // namespace tendril::app
