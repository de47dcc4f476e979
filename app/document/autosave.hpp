// A copy of unsaved work in the config folder, every 30 s of changes, and what a crash left there.
// Each running program has its own file, autosave-<pid>.json, removed when it ends cleanly, and holds
// autosave-<pid>.lock: an autosave whose lock nobody holds was left behind.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "app/document/file_lock.hpp"
#include "app/document/workspace.hpp"

namespace tendril::app {

class Autosave {
  public:
    using Clock = std::chrono::steady_clock;

    explicit Autosave(std::filesystem::path folder, Clock::duration interval = std::chrono::seconds(30));
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// Writes the scene when it has unsaved changes that are not yet in the file, and `interval` has passed
    /// since the first of them. A failure to write is told once, in a toast.
    void update(Workspace& workspace, Clock::time_point now);
    /// A clean end: removes this program's file, or, where unsaved work is to be kept, brings it up to date
    /// and leaves it to be offered at the next start. A program that ends without this call leaves it too.
    void end(Workspace& workspace, bool keep_unsaved);
    std::filesystem::path file() const;

    /// Files of programs that no longer run, the newest first.
    static std::vector<std::filesystem::path> left_behind(const std::filesystem::path& folder);
    /// Such a file for people: the name of the scene that was being worked on, and when it was written.
    static std::string title(const std::filesystem::path& file);
    /// Opens such a file: the workspace then has unsaved changes to the file that was being worked on (the
    /// member "path" beside the scene's own), or to none. Throws as load_scene_file does. The autosave itself
    /// stays.
    static void recover(Workspace& workspace, const std::filesystem::path& file);
    /// Makes such a file this program's own, so that the work in it stays safe until it is saved.
    static void adopt(const std::filesystem::path& file);

  private:
    void write(Workspace& workspace);
    void remove();

    std::filesystem::path folder_;
    std::string stem_;  ///< the process number, with more where another program has the same
    std::unique_ptr<FileLock> lock_{};
    Clock::duration interval_;
    Document written_;
    Clock::time_point changed_at_{};
    bool waiting_ = false;   ///< since changed_at_
    bool has_file_ = false;  ///< holds written_
    bool failed_ = false;
};

}  // namespace tendril::app
