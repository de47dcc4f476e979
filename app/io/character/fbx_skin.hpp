// The meshes of an FBX file, over the nodes that were chosen for the skeleton.
#pragma once

#include "app/io/character/fbx_scene.hpp"
#include "app/io/character/skin.hpp"

namespace tendril::app {

/// In metres: `scale` is what a unit of the file is. Meshes without bones hang on the nearest node above that
/// is a joint; where there is none they are left out. `notes` takes sentences about what else is. Throws
/// std::runtime_error.
Skin fbx_skin(const aiScene& scene, const std::vector<FbxJoint>& joints, double scale,
              std::vector<std::string>& notes);

}  // namespace tendril::app
