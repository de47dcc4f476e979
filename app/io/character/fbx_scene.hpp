// Shared by the parts of the FBX reader: conversions of Assimp's values, and the chains of nodes into which
// it splits a node with pivots.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <tendril/humanoid/clip.hpp>
#include <vector>

namespace tendril::app {

/// A node of the skeleton: Assimp's chain for it, from the outermost pivot to the node itself.
struct FbxJoint {
    std::vector<const aiNode*> chain;
    std::int32_t parent;
};

std::string name_of(const aiNode& node);
/// Whether Assimp added the node for a pivot.
bool is_pivot(const aiNode& node);
/// The name without Assimp's suffix.
std::string plain_name(std::string name);
humanoid::Placement placement_of(const aiMatrix4x4& matrix);
/// Shear is lost.
rig::Transform transform_of(humanoid::Placement placement);

/// An animation in the file's unit, over the skeleton's nodes. Throws std::runtime_error.
humanoid::Clip fbx_clip(const aiAnimation& animation, unsigned index, const std::vector<FbxJoint>& joints);

}  // namespace tendril::app
