// Shared by the command files of this lab.
#pragma once

#include <vector>

#include "app/document/command.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A command that changes a copy of the lab's part.
Command rig_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                    void (*change)(RigPart&, const Arguments&));
/// Arguments completed with the names of elements, controls or units.
Argument element_argument(const char* name, bool required, const char* help);
Argument control_argument(const char* name, bool required, const char* help);
Argument unit_argument(const char* name, bool required, const char* help);
/// Indices in the definition. Refuses unknown element names; the message has the argument and the value.
std::vector<std::size_t> element_list(const RigPart& part, const Arguments& given, const char* name);
/// The elements given by `name` or `names`, without duplicates, in definition order. Refuses an empty list.
std::vector<std::size_t> elements_given(const RigPart& part, const Arguments& given);
/// An argument of any JSON form; the command parses it.
Argument json_argument(const char* name, bool required, const char* help);

void add_element_commands(CommandTable& table);
void add_unit_commands(CommandTable& table);
void add_solve_commands(CommandTable& table);
void add_time_commands(CommandTable& table);

}  // namespace tendril::app
