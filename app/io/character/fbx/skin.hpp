// The meshes of an FBX file, bound to the skeleton, with their blend shapes.
#pragma once

#include "app/io/character/fbx/body.hpp"
#include "app/io/character/skin.hpp"

namespace tendril::app::fbx {

/// A blend shape channel and its morph in the skin; one for each material of its mesh.
struct MorphChannel {
    std::size_t object = 0;
    double percent = 0.0;  ///< if not animated
    std::size_t morph = 0;
};

struct SkinOfFile {
    Skin skin{};
    std::vector<MorphChannel> morphs{};
};

/// `scale` is metres per unit of the file. Meshes without a skin follow the nearest node above that is in the
/// skeleton; those without one are omitted. Appends sentences to `notes`. Throws std::runtime_error.
SkinOfFile read_skin(const Objects& objects, const Body& body, double scale, std::vector<std::string>& notes);

}  // namespace tendril::app::fbx
