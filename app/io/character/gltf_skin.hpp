// The meshes of a glTF file, bound to the skeleton's nodes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/io/character/gltf_keys.hpp"
#include "app/io/character/skin.hpp"
#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

struct GltfNodes {
    std::vector<std::int32_t> parents;  ///< parents of the file's nodes
    std::vector<std::int32_t> place;    ///< index in the skeleton of each of the file's nodes; -1: not in it
};

/// `local` has the local transform of each of the file's nodes. Omits meshes with no ancestor in the
/// skeleton, points and lines, and compressed meshes; a surface whose picture cannot be read is gray. Counts
/// dropped morph keys. Appends sentences about other omissions to `notes`. Throws std::runtime_error.
Skin gltf_skin(const tinygltf::Model& model, const GltfNodes& nodes,
               const std::vector<humanoid::Placement>& local, DroppedKeys& dropped,
               std::vector<std::string>& notes);

}  // namespace tendril::app
