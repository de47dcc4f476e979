// Bones and spring bones of a VRM file: a glTF file with the extension VRMC_vrm (VRM 1.0), VRM (0.x) or
// VRMC_vrm_animation (a motion, .vrma), all by the VRM Consortium. Their "humanoid" member names the bones.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <tendril/humanoid/bone_map.hpp>
#include <vector>

#include "app/io/character/character.hpp"
#include "app/io/character/tiny_gltf.hpp"

namespace tendril::app {

struct VrmBones {
    const char* extension = "";
    std::array<int, humanoid::bone_count> nodes{};  ///< the file's node of each bone; -1: none
};

/// None if the file has none of the extensions. Omits bones that a BoneMap lacks (fingers, eyes, jaw). Throws
/// std::runtime_error if a bone's node does not exist, or already has another bone.
std::optional<VrmBones> vrm_bones(const tinygltf::Model& model);

// Spring bones of a VRM file: "secondaryAnimation" of VRM 0.x, and VRMC_springBone of VRM 1.0, both by the
// VRM Consortium.

/// A spring's settings, as in the file.
struct VrmSpring {
    int node = -1;  ///< the file's node; its descendants swing with it
    double stiffness = 1.0, drag = 0.4;
    glm::dvec3 gravity{0.0};  ///< direction times power
    double hit_radius = 0.0;
    std::vector<SpringCollider> colliders{};  ///< on the file's nodes
};

/// Leaves out springs on nodes that do not exist, and clamps numbers to sane ranges.
std::vector<VrmSpring> vrm_springs(const tinygltf::Model& model);

/// The frequency in Hz and damping ratio for a bone of that length, in metres, that points along `direction`.
struct SpringRate {
    double strength = 0.0, critical_damping = 0.0;
};
SpringRate spring_rate(const VrmSpring& spring, double length, const glm::dvec3& direction);

/// The springs on a skeleton. `place`: the skeleton's index for each of the file's nodes; -1: not in it.
/// Omits springs on the body, and springs on other springs. Appends sentences about omissions to `notes`.
std::vector<NamedSpring> named_springs(const std::vector<VrmSpring>& springs, const Character& character,
                                       const std::vector<std::int32_t>& place,
                                       std::vector<std::string>& notes);

/// Appends sentences about colliders and node constraints (VRMC_node_constraint) that are not followed.
void note_unfollowed(const tinygltf::Model& model, std::vector<std::string>& notes);

}  // namespace tendril::app
