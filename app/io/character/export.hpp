// Writes a character's clip to a file and verifies it by reading it back: the program's only export of
// motion.
#pragma once

#include <filesystem>
#include <string>
#include <tendril/humanoid/ground.hpp>
#include <vector>

#include "app/io/character/gltf_write.hpp"
#include "app/io/outputs.hpp"

namespace tendril::app {

/// The quality of an export, measured on the written bytes.
struct ExportReport {
    std::size_t frames = 0;       ///< frames compared; glTF is also compared between frames
    std::string worst_joint{};    ///< the joint with the largest deviation
    double worst = 0.0;           ///< its deviation, metres
    bool has_feet = false;        ///< whether both clips have standing feet; if not, skating is 0
    double skating_before = 0.0;  ///< maximum sliding of a standing foot, metres
    double skating_after = 0.0;
    double rate = 60.0;                       ///< frames per second
    double unit = 1.0;                        ///< metres per unit of a glTF file that keeps its own unit
    std::size_t findings = 0;                 ///< the lint's findings in the written clip
    bool on_ground = false;                   ///< whether the lint used a slope, stairs, hills or a mesh
    std::vector<std::string> new_findings{};  ///< findings that the original lacks
    std::vector<std::string> worn{};          ///< names of the worn and held things that were written

    /// "67 frames at 60 fps; read back within 0.0001 mm, worst at LeftHand; feet skate 3.0 mm, before fixes
    /// and IK 12.1 mm; 7 findings in the written clip, 2 of them new: LeftLowerLeg pops by 12 degrees ..."
    std::string text() const;
};

/// "; read back within 0.0001 mm, worst at LeftHand"
std::string read_back_text(const ExportReport& report);

struct Export {
    const Character& character;
    std::string file{};                        ///< the character's source file; empty: none
    const humanoid::Clip& original;            ///< before fixes and IK
    const humanoid::Clip& corrected;           ///< the clip to write
    double rate = 60.0;                        ///< frames per second
    const humanoid::Ground* ground = nullptr;  ///< the ground under its feet, for the lint
    Worn worn{};                               ///< its nodes are in `corrected`; glTF only
    Outputs* outputs = nullptr;  ///< decides which existing files are replaced; null: any glTF, GLB or BVH
};

inline constexpr double min_rate = 1.0, largest_rate = 1000.0;

/// True if the file name has the extension of a format that can be written: .gltf, .glb or .bvh.
bool ends_as_export(const std::filesystem::path& path);

/// "1 of 14 clips: Walking"; empty if the character has no other clip.
std::string one_of_clips_text(const Character& character, const std::string& clip);
/// One file for each of the character's clips: "robot.glb" and "Walking" give "robot_Walking.glb". Characters
/// that file names cannot contain become '_', and no two paths are the same.
std::vector<std::filesystem::path> paths_of_clips(const Character& character,
                                                  const std::filesystem::path& path);
/// "14 clips; read back within 0.0012 mm, worst at Head; no new findings in them"
std::string sum_text(const std::vector<ExportReport>& reports);

/// Writes the file atomically, in the format of its extension, with the hierarchy of the character's file,
/// which is never replaced. A glTF file keeps the contents of the character's own glTF file (gltf_write.hpp).
/// Throws std::runtime_error and then writes nothing.
ExportReport export_clip(const Export& what, const std::filesystem::path& path);

}  // namespace tendril::app
