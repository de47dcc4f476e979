// The meshes of an FBX file, bound to the skeleton's nodes.
#pragma once

#include "app/io/character/fbx_scene.hpp"
#include "app/io/character/skin.hpp"

namespace tendril::app {

/// `scale` is metres per unit of the file. Meshes without bones are bound to the nearest ancestor that is a
/// joint, or omitted if there is none. Appends sentences about other omissions to `notes`. Throws
/// std::runtime_error.
Skin fbx_skin(const aiScene& scene, const std::vector<FbxJoint>& joints, double scale,
              std::vector<std::string>& notes);

}  // namespace tendril::app
