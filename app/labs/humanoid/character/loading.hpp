// A large character file that is read beside the running program: the figure that is there stays until the
// other has come, and for good where it is refused or cancelled.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <string>
#include <thread>

#include "app/document/workspace.hpp"
#include "app/io/character/progress.hpp"
#include "app/labs/humanoid/character/loaded_character.hpp"

namespace tendril::app {

class Loading {
  public:
    /// Smaller files are read before anybody could look away.
    static constexpr std::uintmax_t large_file = 1u << 20;

    Loading() = default;
    /// Waits for the reader to heed its cancelling.
    ~Loading() { cancel(); }
    Loading(const Loading&) = delete;
    Loading& operator=(const Loading&) = delete;

    /// Begins to read; what was being read before is cancelled.
    void begin(const std::string& file);
    void cancel();
    bool running() const { return thread_.joinable(); }
    const std::string& file() const { return file_; }
    float part() const { return progress_->part(); }
    /// Whether take() has something to give at once.
    bool done() const { return running() && done_; }
    /// The character; waits for it. Throws what reading it threw. Then nothing is running.
    SharedCharacter take();

  private:
    std::string file_;
    std::unique_ptr<LoadProgress> progress_ = std::make_unique<LoadProgress>();
    std::atomic<bool> done_{false};
    SharedCharacter read_;
    std::exception_ptr refused_;
    std::thread thread_;
};

/// Whether it is worth it: in a window, where somebody waits, and a large file.
bool loads_beside(const Workspace& workspace, const std::string& file);

}  // namespace tendril::app
