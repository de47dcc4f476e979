// Characters in glTF 2.0 files, text or binary, through tinygltf. Nodes are identified by index: names may be
// missing or repeated, and are made unique (a node without one becomes "node_7", by its index in the file).
// Keeps the interpolation of keys.
//
// The skeleton consists of the skins' joints, VRM bones, animated nodes, and all ancestors of these; other
// nodes, such as those of meshes, cameras and lights, are omitted. In a file without a skin it is the whole
// tree of the animated nodes and VRM bones.
//
// The character also gets a VRM file's springs (gltf_vrm.hpp).
//
// Mended, each with a note: keys before 0 s, keys at the same time as another, rotations of length 0, and
// nodes of scale 0. Left out with a note: compressed meshes, pictures that are missing or neither PNG nor
// JPEG, and targets of KHR_animation_pointer other than nodes. Not followed, with a note: a VRM's node
// constraints, and spring colliders that are planes or hold springs inside.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// `name` is the file's name, for messages; external files are read from `folder`. Throws std::runtime_error
/// that begins with the name if the file cannot be read, has no skeleton, has a clip whose numbers are
/// compressed or not finite, lacks buffers, or refers to files outside `folder`.
Character parse_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder,
                     LoadProgress* progress = nullptr);

}  // namespace tendril::app
