// The five scenes of the lab, as data: each a definition that could have been written in a scene file.
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

/// In the order of the panel; the first is what the lab opens on.
const std::vector<RigPreset>& rig_presets();
/// Throws std::invalid_argument for an unknown name.
const RigPreset& rig_preset(const std::string& name);

}  // namespace tendril::app
