// The preset scenes of the lab, from presets.json: each has the members of a scene file.
#pragma once

#include <string>
#include <tendril/rig/definition.hpp>
#include <vector>

#include "app/document/argument_list.hpp"
#include "app/document/camera_pose.hpp"

namespace tendril::app {

struct RigPreset {
    std::string name;         ///< in commands
    std::string title, help;  ///< in the panel
    rig::Definition definition;
    CameraPose view;
};

/// In panel order; the lab opens with the first.
const std::vector<RigPreset>& rig_presets();
/// Throws std::invalid_argument for an unknown name.
const RigPreset& rig_preset(std::string_view name);
/// A list of commands in the first preset: "opening", "calm".
std::vector<CommandCall> rig_script(const char* name);

}  // namespace tendril::app
