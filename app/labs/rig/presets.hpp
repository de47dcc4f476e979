// The five preset scenes of the lab. Each is a definition that a scene file could contain.
#pragma once

#include <string>
#include <tendril/rig/definition.hpp>
#include <vector>

#include "app/document/camera_pose.hpp"

namespace tendril::app {

struct RigPreset {
    std::string name;   ///< in commands
    std::string title;  ///< in the panel
    rig::Definition (*make)();
    CameraPose view;
};

/// In panel order; the lab opens with the first.
const std::vector<RigPreset>& rig_presets();
/// Throws std::invalid_argument for an unknown name.
const RigPreset& rig_preset(std::string_view name);

}  // namespace tendril::app
