// Characters in FBX files, binary or text, versions 6.0 to 7.7. Unsupported contents are left out and listed
// in the character's notes.
//
//     record.hpp     the file as records, and as objects with properties and connections
//     node.hpp       models as nodes, and their transforms
//     animation.hpp  stacks, layers and curves, evaluated as written
//     body.hpp       the nodes that form the skeleton
//     clip.hpp       the stacks as clips
//     surface.hpp    meshes, materials and skins
#pragma once

#include <string>
#include <string_view>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// `name` is the file's name. Throws std::runtime_error that begins with it.
Character parse_fbx(std::string_view bytes, const std::string& name, LoadProgress* progress = nullptr);

}  // namespace tendril::app
