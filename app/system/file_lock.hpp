// A lock that the operating system releases when its program ends, even if it is killed or crashes. A process
// ID would not do: IDs are reused, and containers count from 1.
#pragma once

#include <filesystem>
#include <memory>

#include "app/system/file.hpp"

namespace tendril::app {

class FileLock {
  public:
    /// Creates and locks the file; null if another holder has it or it cannot be created.
    static std::unique_ptr<FileLock> take(const std::filesystem::path& path);
    /// Whether any program holds it, including this one.
    static bool is_held(const std::filesystem::path& path);

    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    /// Removes the file.
    ~FileLock();

  private:
    FileLock(std::filesystem::path path, SystemFile file) : path_(std::move(path)), file_(std::move(file)) {}
    std::filesystem::path path_;
    SystemFile file_;
};

}  // namespace tendril::app
