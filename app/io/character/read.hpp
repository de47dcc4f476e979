// Reads a character from any supported file, by its extension: glTF and GLB (including VRM), FBX, BVH.
#pragma once

#include <cstdint>
#include <filesystem>

#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// Throws std::runtime_error that begins with the file's name if the file does not exist, has an unknown
/// format, is invalid, has no skeleton, has more nodes than Skeleton::max_nodes, or has a clip that
/// humanoid::check() refuses. May run in its own thread.
Character read_character(const std::filesystem::path& path, LoadProgress* progress = nullptr);

/// The first `most` bytes of such a file, up to 1 GB. Throws std::runtime_error that begins with the file's
/// name.
std::string character_bytes(const std::filesystem::path& path, std::uintmax_t most = UINTMAX_MAX);

/// Whether the file name has the extension of a supported file.
bool ends_as_character(const std::filesystem::path& path);

}  // namespace tendril::app
