// Decides which files this program may overwrite: one rule for every writer, in the window and in a terminal.
//
// New or empty files, devices and pipes are always written. Input files (a glTF, or a buffer or picture that
// it names) and files of another kind are never replaced, whatever their names. A file that this session has
// opened or written is replaced, unless another program has changed it since; so is one that already holds
// the same bytes and, for --screenshot and --state, an earlier picture or state. To replace any other file, a
// window asks for a second save and a terminal needs --force.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/system/file.hpp"

namespace tendril::app {

enum class OutputKind { Scene, Recording, State, Picture, Video, Motion, BoneMap, Csv, Trace };

class Outputs {
  public:
    bool force = false;                         ///< --force
    bool in_window = false;                     ///< for the message: a window asks, a terminal refuses
    std::vector<std::filesystem::path> inputs;  ///< files that the session reads
    std::vector<std::filesystem::path> in_use;  ///< files that the document reads again when it is opened

    /// Throws std::runtime_error if one of the files must not be written over. `redraws`: a command line asks
    /// for a picture or a state, which replaces an earlier one.
    void check(const std::vector<std::filesystem::path>& paths, OutputKind kind, bool redraws = false);
    /// Throws std::runtime_error with `loss`, unless that is empty, --force is given or a window asks again.
    void confirm(const std::string& loss);
    /// Where long work, which must not be lost, can be written at its end: the given path or, if check() now
    /// refuses it, a free name beside it with the refusal.
    struct Place {
        std::filesystem::path path;
        std::string refusal{};
    };
    Place place_at_end(const std::filesystem::path& path, OutputKind kind);
    /// Checks, writes atomically and owns the file. Throws std::runtime_error; the old file is then
    /// unchanged.
    void write(const std::filesystem::path& path, OutputKind kind, std::string_view bytes,
               bool redraws = false);
    /// The session opened or wrote this file when it had this stamp, so it may replace it.
    void own(const std::filesystem::path& path, const FileStamp& stamp);

  private:
    std::map<std::filesystem::path, FileStamp> owned_;
    std::map<std::filesystem::path, FileStamp> asked_;  ///< refused files, with their stamps then
    std::string asked_loss_{};                          ///< refused by confirm()

    const char* again() const {
        return in_window ? ". Do the same again to replace it" : "; --force replaces it";
    }
};

}  // namespace tendril::app
