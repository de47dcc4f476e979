// Characters in FBX files, through Assimp, with pivots preserved: Assimp then splits a node into a chain of
// nodes for its translation, pre-rotation, rotation and so on ("Hips_$AssimpFbx$_Rotation"). Each chain is
// multiplied into its last node, at rest and at every time at which one of its parts has a key. (If Assimp
// 5.2.5 itself collapses pivots, it corrects the nodes but not their animation.)
//
// The skeleton consists of the nodes, not of the meshes' bones: those omit joints that move no vertex, and a
// file with only animation has no mesh. Cameras, lights, their targets, and nodes that only hold meshes are
// omitted.
#pragma once

#include <string>
#include <string_view>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// `name` is the file's name. Throws std::runtime_error that begins with it.
Character parse_fbx(std::string_view bytes, const std::string& name, LoadProgress* progress = nullptr);

}  // namespace tendril::app
