// A character from any file that is known: glTF and GLB (VRM too), FBX, BVH, chosen by what the file is
// called.
#pragma once

#include <filesystem>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// Throws std::runtime_error that begins with the file's name: what is not there, is of no known kind, is
/// broken, has no skeleton, more nodes than Skeleton::max_nodes, or a clip that humanoid::check() refuses.
/// It may be read in a thread of its own.
Character read_character(const std::filesystem::path& path, LoadProgress* progress = nullptr);

/// The bytes of such a file, up to 1 GB. Throws std::runtime_error that begins with the file's name.
std::string character_bytes(const std::filesystem::path& path);

/// Whether the name ends as one of those files.
bool ends_as_character(const std::filesystem::path& path);

}  // namespace tendril::app
