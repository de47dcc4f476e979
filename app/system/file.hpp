// Files as the operating system has them: locked, synced, renamed, told apart. The files that the program
// saves are made of these in atomic_file.hpp.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace tendril::app {

/// Why the last call below failed.
std::error_code last_error();

/// An open file, closed by its destructor. Calls return false on failure; last_error() then says why.
class SystemFile {
  public:
    /// A new file, to be written. Fails if `path` exists.
    static SystemFile create(const std::filesystem::path& path);
    /// A file to be locked, made if it is missing. On Linux only this user may read it.
    static SystemFile open_or_create(const std::filesystem::path& path);
    /// An existing file. Follows no symbolic link and never waits.
    static SystemFile open(const std::filesystem::path& path);
    /// A pipe or a device, to be written. Waits up to 5 s for somebody to read from a pipe.
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
    /// Locks it until it is closed, or the program ends in whatever way; false if another holder has it. A
    /// shared lock only keeps out one that is not.
    bool try_lock(bool shared = false);
    /// Whether `path` still names this file.
    bool has_name(const std::filesystem::path& path) const;
    /// Takes the permissions of the file at `path`, if there is one.
    bool copy_permissions(const std::filesystem::path& path);
    /// Returns once all that was written is on disk.
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

/// Renames a file over another and syncs their folder. `from` may be open here.
bool replace_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Whether an existing file may be written to; true for a missing one.
bool may_write(const std::filesystem::path& path);

/// Changes whenever another program writes the file. All 0: there is no file.
struct FileStamp {
    std::uint64_t device = 0, file = 0, size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;  ///< last written, Unix time
    bool operator==(const FileStamp&) const = default;
};
FileStamp file_stamp(const std::filesystem::path& path);

/// Waits until there is something to read from a named pipe; throws std::runtime_error after 5 s without.
/// Null for anything else. Release the result once the pipe is opened to read.
[[nodiscard]] std::shared_ptr<void> await_pipe(const std::filesystem::path& path);

/// Opens a file for std::fread; null on failure, with errno.
std::FILE* open_to_read(const std::filesystem::path& path);

/// Signals that would end the program wait as long as this lives.
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
