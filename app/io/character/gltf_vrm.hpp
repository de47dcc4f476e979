// The bones that a VRM file names: a glTF file with the extension VRMC_vrm (VRM 1.0) or VRM (0.x), both by
// the VRM Consortium, "humanoid" in either.
#pragma once

#include <array>
#include <optional>
#include <tendril/humanoid/bone_map.hpp>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

struct VrmBones {
    const char* extension = "";
    std::array<int, humanoid::bone_count> nodes{};  ///< of the file; -1: none
};

/// None where the file has neither extension. Bones that a BoneMap does not have (fingers, eyes, jaw) are
/// left out. Throws std::runtime_error where a bone is a node that is not there, or that another bone is.
std::optional<VrmBones> vrm_bones(const tinygltf::Model& model);

}  // namespace tendril::app
