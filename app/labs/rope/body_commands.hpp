// Shared by the command files of this lab.
#pragma once

#include <vector>

#include "app/document/command.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/rope_edit.hpp"

namespace tendril::app {

/// A command that changes a copy of the lab's part. A lab at rest resumes if the world or a swing changes.
Command rope_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                     void (*change)(RopeEdit&, const Arguments&), Effect effect = Effect::Edit);

/// Removes what `of` finds by its name, and all that refers to it.
template <auto of, auto removal>
void remove_named(RopeEdit& edit, const Arguments& given) {
    of(edit.seen(), given.text("name"));
    edit.world().change(given.text("name"), removal);
    forget_missing(edit.part);
}

/// Arguments completed with the names of bodies, colliders or ties.
Argument body_argument(const char* name, bool required, const char* help);
Argument collider_argument(const char* name, bool required, const char* help);
Argument tie_argument(const char* name, bool required, const char* help);
Argument rope_argument(bool required, const char* help);
Argument particle_argument(bool required, const char* help);
/// For commands that treat several particles alike.
Argument particles_argument();

void add_world_commands(CommandTable& table);
void add_body_commands(CommandTable& table);
void add_collider_commands(CommandTable& table);
void add_tie_commands(CommandTable& table);
void add_collision_commands(CommandTable& table);
void add_look_commands(CommandTable& table);

}  // namespace tendril::app
