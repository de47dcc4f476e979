// Shared by the command files of this lab; with its preset scenes.
#pragma once

#include <string>
#include <vector>

#include "app/document/camera_pose.hpp"
#include "app/document/command.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// A command that changes a copy of the lab's part. A lab at rest resumes if the world or a swing changes.
Command rope_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                     void (*change)(RopeEdit&, const Arguments&), Effect effect = Effect::Edit);

/// Removes what `of` finds by name, and all references to it.
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
/// For commands that treat several particles in the same way.
Argument particles_argument();

void add_world_commands(CommandTable& table);
void add_body_commands(CommandTable& table);
void add_collider_commands(CommandTable& table);
void add_tie_commands(CommandTable& table);
void add_collision_commands(CommandTable& table);
void add_look_commands(CommandTable& table);

// Preset scenes of the Rope lab: data in presets.json. Metres around the origin, with the ground at y = 0.

struct RopeSceneEntry {
    std::string name, title, help;
    CameraPose view;   ///< the best view of the scene
    SharedJson world;  ///< the input of make_rope_scene()
};

/// In the order of the panel. The lab opens with the first one.
const std::vector<RopeSceneEntry>& rope_scenes();
/// Throws std::runtime_error that begins with the JSON path of the fault: "drape.bodies.0.radius: ...".
RopePart make_rope_scene(const RopeSceneEntry& entry);

}  // namespace tendril::app
