// The meshes of a glTF file, over the nodes that were chosen for the skeleton.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/io/character/skin.hpp"
#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

struct GltfNodes {
    std::vector<std::int32_t> parents;  ///< of the file's nodes
    std::vector<std::int32_t> place;    ///< of the file's nodes in the skeleton; -1: not in it
};

/// As glTF has it; `local(node)` is a node's own transform. What hangs on no node of the skeleton is left
/// out; so are points and lines. `notes` takes sentences about what else is. Throws std::runtime_error.
Skin gltf_skin(const tinygltf::Model& model, const GltfNodes& nodes,
               const std::vector<humanoid::Placement>& local, std::vector<std::string>& notes);

}  // namespace tendril::app
