// The commands of the Humanoid lab, by what they are about.
#pragma once

#include "app/document/command.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {

/// The node of that name; throws std::invalid_argument where there is none.
std::size_t node_named(const HumanoidPart& part, const std::string& name);
/// That of "node", or those of "nodes", in their order. Throws Refused, and as node_named() does.
std::vector<std::size_t> nodes_named(const HumanoidPart& part, const Arguments& given);

/// For the choices of an argument.
std::vector<std::string> bone_names();

/// Offered by name: nodes of the skeleton, clips.
Argument node_argument(const char* name, bool required, const char* help);
Argument clip_argument(const char* name, const char* help);

/// Waits for the file that is being read, if one is, and shows its character. Throws Refused.
void finish_loading(Workspace& workspace);

/// The same command, which in a window keeps the bone map that it has corrected.
Command keeping(Command command);

/// "sign_flip"
std::optional<humanoid::Fault> fault_named(const std::string& name);

void add_character_commands(CommandTable& table);
void add_clip_commands(CommandTable& table);
void add_ik_commands(CommandTable& table);
void add_humanoid_look_commands(CommandTable& table);
/// What hangs on the character.
void add_attachment_commands(CommandTable& table);
/// Springs on nodes of its own.
void add_spring_commands(CommandTable& table);
/// Maps, exports, and cures.
void add_humanoid_file_commands(CommandTable& table);
/// Maps that are kept for node names.
void add_kept_map_commands(CommandTable& table);

}  // namespace tendril::app
