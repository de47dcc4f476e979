// Finds the lab that opens a file. Each lab lists its kinds of file (Lab::files()); file.open finds the lab
// by the file's ending, or by its text if that does not decide, and opens the file there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/labs/labs.hpp"

namespace tendril::app {

struct FileRoute {
    const Lab* lab = nullptr;  ///< null: a scene, which says itself which lab is open
    FileKind kind;
};

/// Scenes first, then the files that each lab reads.
std::vector<FileRoute> file_routes(const Labs& labs);

bool has_ending(const FileKind& kind, const std::filesystem::path& file);
/// "motions (bvh)"
std::string kind_text(const FileKind& kind);

/// The route that opens the file. Throws Refused with a list of the supported kinds if no lab reads it.
FileRoute file_route(const Labs& labs, const std::filesystem::path& file);

/// file.open
void add_file_command(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
