// A lock that a running program holds and that is gone with it, however it ends: killed, crashed or switched
// off. A process number says less: it is used again, and containers count from 1.
#pragma once

#include <filesystem>
#include <memory>

namespace tendril::app {

class FileLock {
  public:
    /// Makes the file and locks it; null where another holds it or it cannot be made.
    static std::unique_ptr<FileLock> take(const std::filesystem::path& file);
    /// Whether a program, this one too, holds it.
    static bool is_held(const std::filesystem::path& file);

    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    /// Removes the file.
    ~FileLock();

  private:
    FileLock(std::filesystem::path file, int fd) : file_(std::move(file)), fd_(fd) {}
    std::filesystem::path file_;
    int fd_;
};

}  // namespace tendril::app
