// What the files of this lab's commands share.
#pragma once

#include <vector>

#include "app/document/command.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// A command on a copy of the lab's part.
Command rig_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                    void (*change)(RigPart&, const Arguments&));
/// Offered by name: elements, those of them that are controls, units.
Argument element_argument(const char* name, bool required, const char* help);
Argument control_argument(const char* name, bool required, const char* help);
Argument unit_argument(const char* name, bool required, const char* help);
/// The places in the definition. Refuses, with the argument and the value, what is no name of an element.
std::vector<std::size_t> element_list(const RigPart& part, const Arguments& given, const char* name);
/// Of one by `name`, or of several by `names`: each once, in the order of the definition. Refuses an empty
/// list.
std::vector<std::size_t> elements_given(const RigPart& part, const Arguments& given);
/// A value that is no number, text or point; the command reads it itself.
Argument json_argument(const char* name, bool required, const char* help);

void add_element_commands(CommandTable& table);
void add_unit_commands(CommandTable& table);
void add_solve_commands(CommandTable& table);
void add_time_commands(CommandTable& table);

}  // namespace tendril::app
