// `tendril lint` and `tendril bake`: the clips of a character's file, judged, and written anew.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tendril::app {

struct LintOptions {
    std::string file;   ///< path of the character
    bool json = false;  ///< one JSON object instead of lines
};
/// Prints what is wrong with each of the file's clips. Returns the number of findings. Throws
/// std::runtime_error where the file cannot be read or the output cannot be written.
std::size_t run_lint(const LintOptions& options);

struct BakeOptions {
    std::string file;  ///< path of the character
    std::string clip;  ///< by name; empty: the first
    std::string ground = "none";
    double fps = 60.0;
    std::string out;  ///< path; empty: FILE_baked beside the file
};
/// The grounds that can be named.
std::vector<std::string> bake_grounds();
/// Writes the clip, reads it back and prints how far it is from what it was. Throws std::runtime_error where
/// the file cannot be read, has no such clip or no legs that ground would need, or nothing can be written.
void run_bake(const BakeOptions& options);

/// For --help.
extern const char* const lint_help;
extern const char* const bake_help;

}  // namespace tendril::app
