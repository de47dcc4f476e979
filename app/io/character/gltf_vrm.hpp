// The bones named in a VRM file: a glTF file with the extension VRMC_vrm (VRM 1.0), VRM (0.x) or
// VRMC_vrm_animation (a motion, .vrma), all by the VRM Consortium, in their "humanoid" member.
#pragma once

#include <array>
#include <optional>
#include <tendril/humanoid/bone_map.hpp>

#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

struct VrmBones {
    const char* extension = "";
    std::array<int, humanoid::bone_count> nodes{};  ///< the file's node of each bone; -1: none
};

/// None if the file has none of the extensions. Omits bones that a BoneMap lacks (fingers, eyes, jaw). Throws
/// std::runtime_error if a bone's node does not exist or is already another bone's.
std::optional<VrmBones> vrm_bones(const tinygltf::Model& model);

}  // namespace tendril::app
