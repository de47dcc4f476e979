// Characters in FBX files, binary or text, versions 6.0 to 7.7. What a file says in ways that are not read is
// left out and said in the character's notes.
//
//     record.hpp     the file as records
//     objects.hpp    objects, their properties and connections
//     node.hpp       models as nodes, and how they are placed
//     curve.hpp, animation.hpp    stacks, layers and curves, evaluated as written
//     body.hpp       which nodes are the skeleton
//     clip.hpp       the stacks as its clips
//     mesh.hpp, material.hpp, skin.hpp    what is drawn
#pragma once

#include <string>
#include <string_view>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// `name` is the file's name. Throws std::runtime_error that begins with it.
Character parse_fbx(std::string_view bytes, const std::string& name, LoadProgress* progress = nullptr);

}  // namespace tendril::app
