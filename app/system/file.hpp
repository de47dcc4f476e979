// Files of the operating system: locking, syncing, renaming, identity. atomic_file.hpp uses these to save files.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace tendril::app {

/// Reason why the last call below failed.
std::error_code last_error();

/// An open file, closed by its destructor. Calls return false on failure; last_error() then says why.
class SystemFile {
  public:
    /// Creates a file for writing. Fails if `path` exists.
    static SystemFile create(const std::filesystem::path& path);
    /// Opens a file to lock, and creates it if it is missing. On Linux only this user may read it.
    static SystemFile open_or_create(const std::filesystem::path& path);
    /// Opens an existing file. Follows no symbolic link and never waits.
    static SystemFile open(const std::filesystem::path& path);
    /// Opens a pipe or a device for writing. Waits up to 5 s for a reader of a pipe.
    static SystemFile open_stream(const std::filesystem::path& path);

    SystemFile() = default;
    SystemFile(SystemFile&& other) noexcept : handle_(std::exchange(other.handle_, none)) {}
    SystemFile& operator=(SystemFile&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~SystemFile() { close(); }

    explicit operator bool() const { return handle_ != none; }
    void close();
    bool write(std::string_view bytes);
    /// Locks it until it is closed or the program ends for any reason; false if another holder has it. A
    /// shared lock only excludes exclusive ones.
    bool try_lock(bool shared = false);
    /// True if `path` still names this file.
    bool has_name(const std::filesystem::path& path) const;
    /// Takes the permissions of the file at `path`, if there is one.
    bool copy_permissions(const std::filesystem::path& path);
    /// Returns once all written data is on disk.
    bool sync();

  private:
    static constexpr std::intptr_t none = -1;
    explicit SystemFile(std::intptr_t handle) : handle_(handle) {}
    std::intptr_t handle_ = none;
};

/// A lock that the operating system releases when its program ends, even if it is killed or crashes. A
/// process ID would not do: IDs are reused, and containers count from 1.
class FileLock {
  public:
    /// Creates and locks the file; null if another holder has it or it cannot be created.
    static std::unique_ptr<FileLock> take(const std::filesystem::path& path);
    /// True if any program holds it, including this one.
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

/// Renames a file over another and syncs their folder. `from` may be open here.
bool replace_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// True if an existing file may be written to; true for a missing one.
bool may_write(const std::filesystem::path& path);

/// Changes whenever another program writes the file. All 0: no file.
struct FileStamp {
    std::uint64_t device = 0, file = 0, size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  ///< last written, Unix time
    bool operator==(const FileStamp&) const = default;
};
FileStamp file_stamp(const std::filesystem::path& path);

/// Waits until a named pipe has something to read; throws std::runtime_error after 5 s. Null for any other
/// file. Release the result once the pipe is open for reading.
[[nodiscard]] std::shared_ptr<void> await_pipe(const std::filesystem::path& path);

/// Opens a file for std::fread; null on failure, with errno.
std::FILE* open_to_read(const std::filesystem::path& path);

/// Delays signals that would end the program during its lifetime.
class SignalsWait {
  public:
    SignalsWait();
    ~SignalsWait();
    SignalsWait(const SignalsWait&) = delete;
    SignalsWait& operator=(const SignalsWait&) = delete;

  private:
    struct Before;
    std::unique_ptr<Before> before_;
};

}  // namespace tendril::app
