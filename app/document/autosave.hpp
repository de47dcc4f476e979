// Copies unsaved work to the config folder after 30 s of changes, and recovers what a crash left there. Each
// running program has its own file, autosave-<pid>.json, removed on a clean exit, and holds
// autosave-<pid>.lock: an autosave whose lock is not held was left by a crash. Recovered work keeps a file of
// its own, autosave-<pid>.<n>.json, until it is saved, whatever else is recovered or opened meanwhile.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "app/system/file.hpp"
#include "app/document/workspace.hpp"

namespace tendril::app {

class Autosave {
  public:
    using Clock = std::chrono::steady_clock;

    explicit Autosave(std::filesystem::path folder, Clock::duration interval = std::chrono::seconds(30));
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// Writes the scene when it has unsaved changes that are not yet in the file, and `interval` has passed
    /// since the first of them. The first failure to write is reported in a toast.
    void update(Workspace& workspace, Clock::time_point now);
    /// Call on a clean exit: removes the work's file or, with `keep_unsaved`, updates it so that the next
    /// start offers it. A program that ends without this call leaves the file too.
    void end(Workspace& workspace, bool keep_unsaved);
    /// This program's own autosave file.
    std::filesystem::path file() const;

    /// Files of programs that no longer run, newest first.
    static std::vector<std::filesystem::path> left_behind(const std::filesystem::path& folder);
    /// The title of such a file in the window: the scene's file name and the time of writing.
    static std::string title(const std::filesystem::path& file);
    /// Opens such a file as unsaved changes to its original scene file (the extra member "path"), if it had
    /// one. A lab that cannot be read stays in the file, and a toast says so. Throws as load_scene_file does.
    /// The autosave becomes this program's, so the work in it stays safe until it is saved.
    static void recover(Workspace& workspace, const std::filesystem::path& file);

  private:
    /// The autosave file of the workspace's current work.
    std::filesystem::path file_of(const Workspace& workspace) const {
        return workspace.recovered.empty() ? file() : workspace.recovered;
    }
    void write(Workspace& workspace);

    std::filesystem::path folder_;
    std::string stem_;  ///< the process ID, with a suffix if another program holds that name
    std::unique_ptr<FileLock> lock_{};
    Clock::duration interval_;
    Document written_;
    Clock::time_point changed_at_{};
    bool waiting_ = false;         ///< changed_at_ is set, and nothing was written since
    bool has_file_ = false;        ///< the file holds written_
    std::filesystem::path shown_;  ///< Workspace::recovered, at the last update
    bool failed_ = false;
};

}  // namespace tendril::app
