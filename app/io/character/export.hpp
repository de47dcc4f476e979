// A clip of a character, written to a file and read back: the one way by which the program exports motion.
#pragma once

#include <filesystem>
#include <string>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// What came of an export, measured on what was written.
struct ExportReport {
    std::size_t frames = 0;       ///< at which joints were compared; glTF also between them
    std::string worst_joint{};    ///< the one that is the furthest from where it was
    double worst = 0.0;           ///< by how far, metres
    bool has_feet = false;        ///< feet stand in the clip; what follows is 0 otherwise
    double skating_before = 0.0;  ///< the furthest that a standing foot slides, metres
    double skating_after = 0.0;

    /// "67 frames; worst joint LeftHand, 0.0001 mm; skating 12.1 mm before, 3.0 mm after"
    std::string text() const;
};

struct Export {
    const Character& character;
    std::string file{};               ///< that it came from; empty: from none
    const humanoid::Clip& original;   ///< before anything was corrected
    const humanoid::Clip& corrected;  ///< what is written
    double rate = 60.0;               ///< frames a second
};

inline constexpr double min_rate = 1.0, largest_rate = 1000.0;

/// Whether the name ends as one of the files that can be written: .gltf, .glb and .bvh.
bool ends_as_export(const std::filesystem::path& path);

/// Writes the file beside `path` and renames it; the kind follows from the name's ending. A glTF file keeps
/// what the character's own glTF file has (gltf_write.hpp). Throws std::runtime_error, and nothing is written
/// then.
ExportReport export_clip(const Export& what, const std::filesystem::path& path);

}  // namespace tendril::app
