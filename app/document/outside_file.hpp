// A file that a part of a scene reads besides the JSON, such as a character. The scene stores its name, its
// absolute path and a checksum: {"file": "hero.glb", "path": "/home/ann/hero.glb", "crc32": 907060870}. This
// distinguishes a lab that cannot be read because of its file from one with a wrong value.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/io/json_place.hpp"

namespace tendril::app {

struct OutsideFile {
    std::string file{};                    ///< as the user gave it; empty if there is none
    std::string path{};                    ///< absolute
    std::optional<std::uint32_t> crc32{};  ///< checksum of the file's bytes
    bool operator==(const OutsideFile&) const = default;
};

/// The file at `path`, which was just read; `file`: the user's name for it, if that is different.
OutsideFile outside_file(const std::string& path, const std::string& file = {});
/// The file's members in the scene's JSON.
Json save_outside_file(const OutsideFile& file);

/// A file that a scene names is missing or unreadable. what() names the file as the user does.
class OutsideFileError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Where such a file is: at its path or, on another machine, at the name that the user gave it. Throws
/// OutsideFileError if it is in neither place.
OutsideFile named_file(const JsonPlace& place);

/// read(path, file) for the file that `place` names, with that function's exceptions as OutsideFileError.
auto read_outside_file(const JsonPlace& place, const auto& read) {
    const OutsideFile from = named_file(place);
    try {
        return read(from.path, from.file);
    } catch (const std::exception& error) {
        throw OutsideFileError(error.what());
    }
}

/// Updates the paths of files that moved with the scene. A file missing at its path is looked up by the
/// path's end: under the scene's folder or, with at least one folder, under the two above it.
void find_moved_files(Json& part, const std::filesystem::path& scene_folder);
/// Names the part's changed files: "w.bvh has changed since the scene was saved". Empty if none has.
std::string changed_files_text(const Json& part);

}  // namespace tendril::app
