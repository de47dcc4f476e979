// Preset scenes of the Rope lab: data in presets.json. Metres around the origin, with the ground at y = 0.
#pragma once

#include <string>
#include <vector>

#include "app/document/camera_pose.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

struct RopeSceneEntry {
    std::string name, title, help;
    CameraPose view;   ///< the best view of the scene
    SharedJson world;  ///< what make_rope_scene() reads
};

/// In the order of the panel. The lab opens with the first one.
const std::vector<RopeSceneEntry>& rope_scenes();
/// Throws std::runtime_error that begins with the JSON path of the fault: "drape.bodies.0.radius: ...".
RopePart make_rope_scene(const RopeSceneEntry& entry);

}  // namespace tendril::app
