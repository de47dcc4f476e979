// Characters in glTF 2.0 files, text or binary, through tinygltf. Nodes by index: names may be missing or
// double, and are made unique (a node without one is "node_7", by its place in the file). Interpolation stays
// as it is.
//
// Kept as nodes are joints of skins, nodes that are animated, and what those hang on or what hangs between;
// meshes, cameras and lights that hang beside them are not.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// `name` is the file's, for messages; what it names beside itself is looked for in `folder`. Throws
/// std::runtime_error that begins with the name: what cannot be read, has no skeleton, a clip with numbers
/// that are none, or buffers or images that are missing.
Character parse_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder,
                     LoadProgress* progress = nullptr);

}  // namespace tendril::app
