// Characters in FBX files, through Assimp, with pivots preserved: Assimp then splits a node into a chain of
// nodes for its translation, pre-rotation, rotation and so on ("Hips_$AssimpFbx$_Rotation"). Each chain is
// multiplied out into the node that it ends in, at rest and at every time at which one of its parts has a
// key. (With pivots collapsed by Assimp itself, version 5.2.5 mends the nodes and not their animation.)
//
// The skeleton are the nodes, not the bones that meshes list: those leave out what moves no vertex, and a
// file of animation alone has no mesh. Cameras, lights, what they aim at, and nodes of meshes alone are left
// out.
#pragma once

#include <string>
#include <string_view>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// `name` is the file's, for messages. Throws std::runtime_error that begins with it.
Character parse_fbx(std::string_view bytes, const std::string& name, LoadProgress* progress = nullptr);

}  // namespace tendril::app
