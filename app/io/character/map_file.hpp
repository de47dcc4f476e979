// Bone maps as files: the name of each bone's node.
//
//     {"tendril": "bone map", "version": 1,
//      "bones": {"Hips": "mixamorig:Hips", "LeftUpperArm": "mixamorig:LeftArm"},
//      "nodes": ["mixamorig:Hips", "mixamorig:Spine"]}
//
// A missing bone has no node. `nodes` are the names of all nodes of the map's skeleton, in order; they are
// optional.
//
// The user's maps are also kept in a folder, one for each list of names, and found again for any skeleton
// with the same names.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tendril/humanoid/bone_map.hpp>

namespace tendril::app {

struct SavedMap {
    std::array<std::string, humanoid::bone_count> bones{};  ///< the node's name; empty: none
    std::vector<std::string> nodes{};
    bool operator==(const SavedMap&) const = default;
};

SavedMap saved_map(const humanoid::BoneMap& map, const humanoid::Skeleton& skeleton);
/// The map for a skeleton, with every bone certain and reviewed, since the user has confirmed it. Throws
/// std::runtime_error if the skeleton lacks a node: "LeftHand is node "hand_l", which the character does not
/// have".
humanoid::BoneMap applied(const SavedMap& saved, const humanoid::Skeleton& skeleton);

std::string map_text(const SavedMap& map);
/// `name` is the file's, for messages: `map.json: line 3: bones.Tail: there is no such bone`. Throws
/// std::runtime_error, also if two bones have the same node.
SavedMap parse_map(std::string_view text, const std::string& name);
SavedMap read_map(const std::filesystem::path& path);
/// True if a file that begins with this text may be a saved map.
bool begins_map(std::string_view text);

/// Path in a folder of the kept map for a skeleton with these names, whether or not it exists.
std::filesystem::path kept_map(const std::filesystem::path& folder, const humanoid::Skeleton& skeleton);
/// The map kept there for exactly these names, if there is one. Throws std::runtime_error with the file's
/// name if the file has other names, cannot be read or cannot be applied.
std::optional<SavedMap> find_kept_map(const std::filesystem::path& folder,
                                      const humanoid::Skeleton& skeleton);
/// Keeps a map there, replacing an older one. Throws std::runtime_error.
void keep_map(const std::filesystem::path& folder, const SavedMap& map, const humanoid::Skeleton& skeleton);
/// Removes the kept map; returns whether there was one. Throws std::runtime_error if it cannot be removed.
bool forget_kept_map(const std::filesystem::path& folder, const humanoid::Skeleton& skeleton);

}  // namespace tendril::app
