// Characters in glTF 2.0 files, text or binary, through tinygltf. Nodes are identified by index: names may be
// missing or repeated, and are made unique (a node without one becomes "node_7", by its index in the file).
// Keeps the interpolation of keys.
//
// The skeleton consists of the skins' joints, VRM bones, animated nodes, and all ancestors of these; other
// nodes, such as those of meshes, cameras and lights, are omitted.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// `name` is the file's name, for messages; external files are read from `folder`. Throws std::runtime_error
/// that begins with the name if the file cannot be read, has no skeleton, has a clip with numbers that are
/// not finite, or lacks buffers or images.
Character parse_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder,
                     LoadProgress* progress = nullptr);

}  // namespace tendril::app
