// Which files this program may write over: one rule for every writer, in the window and in a terminal.
//
// New or empty files, devices and pipes are always written. An input file, such as a glTF or a buffer or
// picture that it names, or a file of another kind, is never replaced, whatever its name. A file that this
// session has opened or written is replaced, unless another program has changed it since; so is one that
// already holds the same bytes, and, for --screenshot and --state, an earlier picture or state. A window
// replaces any other file if it is asked once more; a terminal needs --force.
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
    /// At the end of long work, which must not be lost: the path and no refusal or, where check() now refuses
    /// it, a free name beside it and why.
    struct Place {
        std::filesystem::path path;
        std::string refusal{};
    };
    Place place_at_end(const std::filesystem::path& path, OutputKind kind);
    /// Checks, writes atomically and owns the file. Throws std::runtime_error; the old file is then as it
    /// was.
    void write(const std::filesystem::path& path, OutputKind kind, std::string_view bytes,
               bool redraws = false);
    /// The session has opened or written this file when its stamp was that: it may replace it.
    void own(const std::filesystem::path& path, const FileStamp& stamp);

  private:
    std::map<std::filesystem::path, FileStamp> owned_;
    std::map<std::filesystem::path, FileStamp> asked_;  ///< refused because they existed like this
    std::string asked_loss_{};                          ///< refused by confirm()

    const char* again() const {
        return in_window ? ". Do the same again to replace it" : "; --force replaces it";
    }
};

}  // namespace tendril::app
