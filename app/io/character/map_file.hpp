// Bone maps as files: which node, by name, is which bone.
//
//     {"tendril": "bone map", "version": 1,
//      "bones": {"Hips": "mixamorig:Hips", "LeftUpperArm": "mixamorig:LeftArm"},
//      "nodes": ["mixamorig:Hips", "mixamorig:Spine"]}
//
// A bone that is not among them has no node. `nodes` are the names of the skeleton's nodes that the map was
// made for, in its order; a file without them can be read all the same.
//
// Maps that a person makes are kept in a folder, too, one for each list of names, and found there again for
// any skeleton of the same names.
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
/// Each bone that the file names, sure because a person has said so, and reviewed. Throws std::runtime_error
/// where the skeleton has no node of a name: "LeftHand is node "hand_l", which the character does not have".
humanoid::BoneMap applied(const SavedMap& saved, const humanoid::Skeleton& skeleton);

std::string map_text(const SavedMap& map);
/// `name` is the file's, for messages: `map.json: line 3: bones.Tail: there is no such bone`. Throws
/// std::runtime_error. One node is one bone at most.
SavedMap parse_map(std::string_view text, const std::string& name);
SavedMap read_map(const std::filesystem::path& path);

/// Where the map of a skeleton of those names is kept in a folder, whether or not it is there now.
std::filesystem::path kept_map(const std::filesystem::path& folder, const humanoid::Skeleton& skeleton);
/// The map that is kept there for exactly those names, and can be applied; nothing where there is none.
/// Throws std::runtime_error, with the file's name, where the file is another's, or cannot be read.
std::optional<SavedMap> find_kept_map(const std::filesystem::path& folder,
                                      const humanoid::Skeleton& skeleton);
/// Keeps it there, in place of an older one. Throws std::runtime_error.
void keep_map(const std::filesystem::path& folder, const SavedMap& map, const humanoid::Skeleton& skeleton);
/// Whether there was one. Throws std::runtime_error where it cannot be removed.
bool forget_kept_map(const std::filesystem::path& folder, const humanoid::Skeleton& skeleton);

}  // namespace tendril::app
