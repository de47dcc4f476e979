// What the files of this lab's commands share.
#pragma once

#include <vector>

#include "app/document/command.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/rope_edit.hpp"

namespace tendril::app {

/// A command on a copy of the lab's part; what it changes in the world wakes it.
Command rope_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                     void (*change)(RopeEdit&, const Arguments&), Effect effect = Effect::Edit);

/// Offered by name: what hangs in the world, and what it meets.
Argument body_argument(const char* name, bool required, const char* help);
Argument collider_argument(const char* name, bool required, const char* help);
Argument rope_argument(bool required, const char* help);
Argument particle_argument(bool required, const char* help);
/// Several, for a command that does the same to all.
Argument particles_argument();

void add_world_commands(CommandTable& table);
void add_body_commands(CommandTable& table);
void add_collider_commands(CommandTable& table);
void add_look_commands(CommandTable& table);

}  // namespace tendril::app
