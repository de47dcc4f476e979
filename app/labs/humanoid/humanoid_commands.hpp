// Shared by the command files of the Humanoid lab.
#pragma once

#include "app/document/command.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {

struct ShownPose;
class Solvers;

/// The node of that name; throws std::invalid_argument if there is none.
std::size_t node_named(const HumanoidPart& part, const std::string& name);
/// The nodes given by "node" or "nodes", in that order. Throws Refused, or as node_named() does.
std::vector<std::size_t> nodes_named(const HumanoidPart& part, const Arguments& given);

/// Choices for an argument.
std::vector<std::string> bone_names();

/// Arguments completed with names of nodes or clips.
Argument node_argument(const char* name, bool required, const char* help);
Argument clip_argument(const char* name, const char* help);

/// If a file is being read, waits for it and shows its character. Throws Refused.
void finish_loading(Workspace& workspace);

/// Wraps a command so that a window keeps the bone map that it corrected.
Command keeping(Command command);

/// Wraps a command so that the camera follows the character to a clip's start, as in playback.
Command followed(Command command);

/// "sign_flip"
std::optional<humanoid::Fault> fault_named(const std::string& name);

/// State that a command may read while it changes the part.
struct IkNow {
    const ShownPose& shown;
    Solvers& solvers;
};

/// Changes the part, then solves so that the resulting state of IK is stored.
Command ik_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                   void (*change)(const IkNow&, HumanoidPart&, const Arguments&));

/// A Point with double precision.
glm::dvec3 exact_point(const Json& json);
/// Throws std::invalid_argument with the reason if there is no body.
void require_body(const IkNow& now, const HumanoidPart& part);

/// A complete program: skeleton, bone map and the current pose as data, then feet, targets, gaze, hands and
/// springs with their settings, in the lab's order. It prints every node's position, equal to the lab's.
/// Leaves out attachments, the fading after a target is released, and the triangles of a ground mesh.
std::string humanoid_code(const HumanoidPart& part, Solvers& solvers);

void add_character_commands(CommandTable& table);
void add_clip_commands(CommandTable& table);
void add_motion_commands(CommandTable& table);
void add_ik_commands(CommandTable& table);
void add_hand_commands(CommandTable& table);
void add_humanoid_look_commands(CommandTable& table);
void add_attachment_commands(CommandTable& table);
void add_spring_commands(CommandTable& table);
void add_bone_curve_commands(CommandTable& table);
/// Bone maps, clip export and cures.
void add_humanoid_file_commands(CommandTable& table);
void add_kept_map_commands(CommandTable& table);

}  // namespace tendril::app
