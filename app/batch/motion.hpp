// `tendril lint` and `tendril bake`: check the clips of a character file, and write them with corrections.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tendril::app {

struct LintOptions {
    std::string file;    ///< path of the character
    std::string motion;  ///< path of a file with another character's clips; empty: the character's own
    bool json = false;   ///< one JSON object instead of lines
};
/// Prints the faults of each of the file's clips. Returns the number of findings. Throws std::runtime_error
/// if the file cannot be read or the output cannot be written.
std::size_t run_lint(const LintOptions& options);

struct BakeOptions {
    std::string file;    ///< path of the character
    std::string motion;  ///< path of a file with another character's clips; empty: the character's own
    std::string clip;    ///< by name; empty: the first
    bool all = false;    ///< every clip, each to a file of its own
    std::string ground = "none";
    bool travel = false;          ///< moves a clip that walks in place at its standing foot's speed
    std::optional<double> fps{};  ///< frames per second; the clip's own by default
    std::string out;              ///< path; empty: FILE_baked beside the file
    bool force = false;           ///< replaces glTF, GLB and BVH files that exist
};
/// The names of the grounds.
std::vector<std::string> bake_grounds();
/// Writes the clip, reads it back and prints the difference. Throws std::runtime_error if the file cannot be
/// read, has no such clip, lacks the legs that a ground needs, or cannot be written.
void run_bake(const BakeOptions& options);

/// For --help.
extern const char* const lint_help;
extern const char* const bake_help;

}  // namespace tendril::app
