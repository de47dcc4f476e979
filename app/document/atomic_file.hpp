// Files that are either the old one or the new one, whatever happens in between: written beside, synced
// to disk, and renamed over the old name. The one way this program writes a file.
#pragma once

#include <filesystem>
#include <string_view>

namespace tendril::app {

/// Throws std::runtime_error: "cannot write <path>: <reason>"; the old file is then as it was, and nothing is
/// left beside it. Keeps the permissions of a file it replaces and writes through a symbolic link.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Throws, as above, where `path` could not be written later: its folder is missing or not writable, or it is
/// a folder itself. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

}  // namespace tendril::app
