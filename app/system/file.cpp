#include "app/system/file.hpp"

#include <cstdio>
#include <stdexcept>
#include <string>

#ifdef _WIN32
#include <winsock2.h>  // WSAEWOULDBLOCK

#include <windows.h>
#else
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>
#endif

#ifdef __EMSCRIPTEN__
#include <emscripten/em_js.h>
#endif

namespace tendril::app {
namespace fs = std::filesystem;

#ifdef _WIN32
namespace {

/// Other programs may read, write, rename and delete files that this one has open, as on other systems.
constexpr DWORD share_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

HANDLE handle_of(std::intptr_t handle) {
    return reinterpret_cast<HANDLE>(handle);
}

std::intptr_t open_handle(const fs::path& path, DWORD access, DWORD how,
                          DWORD flags = FILE_ATTRIBUTE_NORMAL) {
    return reinterpret_cast<std::intptr_t>(
        ::CreateFileW(path.c_str(), access, share_all, nullptr, how, flags, nullptr));
}

FileStamp stamp_of(HANDLE handle) {
    BY_HANDLE_FILE_INFORMATION found{};
    if (::GetFileInformationByHandle(handle, &found) == 0) return {};
    const auto whole = [](DWORD high, DWORD low) { return std::uint64_t{high} << 32 | low; };
    // Windows counts units of 100 ns from the year 1601.
    constexpr std::int64_t ticks = 10'000'000, unix_start = 11'644'473'600;
    const auto time = static_cast<std::int64_t>(
        whole(found.ftLastWriteTime.dwHighDateTime, found.ftLastWriteTime.dwLowDateTime));
    return {found.dwVolumeSerialNumber, whole(found.nFileIndexHigh, found.nFileIndexLow),
            whole(found.nFileSizeHigh, found.nFileSizeLow), time / ticks - unix_start, time % ticks * 100};
}

}  // namespace

std::error_code last_error() {
    return {static_cast<int>(::GetLastError()), std::system_category()};
}

SystemFile SystemFile::create(const fs::path& path) {
    return SystemFile(open_handle(path, GENERIC_READ | GENERIC_WRITE, CREATE_NEW));
}

SystemFile SystemFile::open_or_create(const fs::path& path) {
    return SystemFile(open_handle(path, GENERIC_READ | GENERIC_WRITE, OPEN_ALWAYS));
}

SystemFile SystemFile::open(const fs::path& path) {
    return SystemFile(open_handle(path, GENERIC_READ, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT));
}

SystemFile SystemFile::open_stream(const fs::path& path) {
    return SystemFile(open_handle(path, GENERIC_WRITE, OPEN_EXISTING));
}

void SystemFile::close() {
    if (*this) ::CloseHandle(handle_of(std::exchange(handle_, none)));
}

bool SystemFile::write(std::string_view bytes) {
    constexpr std::size_t most = 1 << 30;
    while (!bytes.empty()) {
        DWORD count = 0;
        const auto wanted = static_cast<DWORD>(std::min(bytes.size(), most));
        if (::WriteFile(handle_of(handle_), bytes.data(), wanted, &count, nullptr) == 0) return false;
        bytes.remove_prefix(count);
    }
    return true;
}

bool SystemFile::try_lock(bool shared) {
    // Windows stops others from reading and writing locked bytes, so lock one byte far past the end.
    OVERLAPPED far_away{};
    far_away.OffsetHigh = 1 << 30;
    const DWORD kind = LOCKFILE_FAIL_IMMEDIATELY | (shared ? 0 : LOCKFILE_EXCLUSIVE_LOCK);
    if (::LockFileEx(handle_of(handle_), kind, 0, 1, 0, &far_away) != 0) return true;
    if (::GetLastError() == ERROR_LOCK_VIOLATION)
        ::SetLastError(WSAEWOULDBLOCK);  // the code of a taken lock elsewhere
    return false;
}

bool SystemFile::has_name(const fs::path& path) const {
    const FileStamp mine = stamp_of(handle_of(handle_)), named = file_stamp(path);
    return named != FileStamp() && mine.device == named.device && mine.file == named.file;
}

bool SystemFile::copy_permissions(const fs::path&) {
    return true;  // permissions come from the folder
}

bool SystemFile::sync() {
    return ::FlushFileBuffers(handle_of(handle_)) != 0;
}

bool replace_file(const fs::path& from, const fs::path& to) {
    // While another program, such as a virus scanner, reads the old file, Windows does not replace it: retry.
    constexpr DWORD pause = 20, tries = 50;  // ms; a second in all
    for (DWORD i = 0; i < tries; ++i) {
        if (::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0)
            return true;
        const DWORD why = ::GetLastError();
        if (why != ERROR_ACCESS_DENIED && why != ERROR_SHARING_VIOLATION) return false;
        if (i + 1 < tries) ::Sleep(pause);
    }
    return false;
}

bool may_write(const fs::path& path) {
    const DWORD found = ::GetFileAttributesW(path.c_str());
    if (found == INVALID_FILE_ATTRIBUTES || (found & FILE_ATTRIBUTE_READONLY) == 0) return true;
    ::SetLastError(ERROR_ACCESS_DENIED);
    return false;
}

FileStamp file_stamp(const fs::path& path) {
    const HANDLE handle =
        handle_of(open_handle(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS));
    if (handle == INVALID_HANDLE_VALUE) return {};
    const FileStamp stamp = stamp_of(handle);
    ::CloseHandle(handle);
    return stamp;
}

std::shared_ptr<void> await_pipe(const fs::path&) {
    return nullptr;  // named pipes are not supported here
}

std::FILE* open_to_read(const fs::path& path) {
    return ::_wfopen(path.c_str(), L"rb");
}

// Ctrl+C runs its handler in a separate thread, and the handler only sets a flag.
struct SignalsWait::Before {};
SignalsWait::SignalsWait() = default;
SignalsWait::~SignalsWait() = default;

#else
namespace {

int open_handle(const fs::path& path, int flags, mode_t mode = 0666) {
    int handle = -1;
    do handle = ::open(path.c_str(), flags | O_CLOEXEC, mode);
    while (handle < 0 && errno == EINTR);
    return handle;
}

int descriptor(std::intptr_t handle) {
    return static_cast<int>(handle);
}

}  // namespace

std::error_code last_error() {
    return {errno, std::generic_category()};
}

SystemFile SystemFile::create(const fs::path& path) {
    return SystemFile(open_handle(path, O_WRONLY | O_CREAT | O_EXCL));
}

SystemFile SystemFile::open_or_create(const fs::path& path) {
    return SystemFile(open_handle(path, O_RDWR | O_CREAT, 0600));
}

SystemFile SystemFile::open(const fs::path& path) {
    return SystemFile(open_handle(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK));
}

SystemFile SystemFile::open_stream(const fs::path& path) {
    using Time = std::chrono::steady_clock;
    const auto end = Time::now() + std::chrono::seconds(5);
    int handle = -1;
    while ((handle = open_handle(path, O_WRONLY | O_NONBLOCK)) < 0 && errno == ENXIO && Time::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (handle >= 0) ::fcntl(handle, F_SETFL, ::fcntl(handle, F_GETFL) & ~O_NONBLOCK);
    return SystemFile(handle);
}

void SystemFile::close() {
    if (*this) ::close(descriptor(std::exchange(handle_, none)));
}

bool SystemFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor(handle_), bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

bool SystemFile::try_lock(bool shared) {
    return ::flock(descriptor(handle_), (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0;
}

bool SystemFile::has_name(const fs::path& path) const {
    struct stat mine {
    }, named{};
    return ::fstat(descriptor(handle_), &mine) == 0 && ::stat(path.c_str(), &named) == 0 &&
           mine.st_dev == named.st_dev && mine.st_ino == named.st_ino;
}

bool SystemFile::copy_permissions(const fs::path& path) {
    struct stat found {};
    return ::stat(path.c_str(), &found) != 0 || ::fchmod(descriptor(handle_), found.st_mode & 07777) == 0;
}

bool SystemFile::sync() {
    return ::fsync(descriptor(handle_)) == 0;
}

#ifdef __EMSCRIPTEN__
EM_JS(void, offer_download, (const char* path), { tendrilDownload(UTF8ToString(path)); });
#endif

bool replace_file(const fs::path& from, const fs::path& to) {
    if (::rename(from.c_str(), to.c_str()) != 0) return false;
#ifdef __EMSCRIPTEN__
    offer_download(to.c_str());
#endif
    // The rename has succeeded; a file system that cannot sync a folder is not an error.
    const fs::path folder = to.has_parent_path() ? to.parent_path() : fs::path(".");
    if (const int handle = open_handle(folder, O_RDONLY | O_DIRECTORY); handle >= 0) {
        ::fsync(handle);
        ::close(handle);
    }
    return true;
}

bool may_write(const fs::path& path) {
    return ::access(path.c_str(), W_OK) == 0 || errno == ENOENT;
}

FileStamp file_stamp(const fs::path& path) {
    struct stat found {};
    if (::stat(path.c_str(), &found) != 0) return {};
    return {found.st_dev, found.st_ino, static_cast<std::uint64_t>(found.st_size), found.st_mtim.tv_sec,
            found.st_mtim.tv_nsec};
}

std::shared_ptr<void> await_pipe(const fs::path& path) {
    std::error_code error;
    // The shell's own pipes, /dev/stdin and /dev/fd/63, already have a writer.
    const std::string name = path.string();
    if (!fs::is_fifo(path, error) || name.starts_with("/dev/") || name.starts_with("/proc/")) return nullptr;
    const auto open_end = [&](int flags) {
        return std::shared_ptr<const int>(new int(open_handle(path, flags | O_NONBLOCK)),
                                          [](const int* handle) {
                                              if (*handle >= 0) ::close(*handle);
                                              delete handle;
                                          });
    };
    const auto reader = open_end(O_RDONLY);
    struct pollfd wanted {};
    wanted.fd = *reader;
    wanted.events = POLLIN;
    constexpr int patience = 5000;  // ms
    int ready = 1;
    if (*reader >= 0) do
            ready = ::poll(&wanted, 1, patience);
        while (ready < 0 && errno == EINTR);
    if (ready == 0) throw std::runtime_error(name + ": nothing came through this pipe for 5 s");
    // This end also writes, so the next open for reading does not block.
    return std::make_shared<std::pair<std::shared_ptr<const int>, std::shared_ptr<const int>>>(
        reader, open_end(O_RDWR));
}

std::FILE* open_to_read(const fs::path& path) {
    return std::fopen(path.c_str(), "rb");
}

struct SignalsWait::Before {
    sigset_t set{};
};

SignalsWait::SignalsWait() : before_(std::make_unique<Before>()) {
    sigset_t set;
    ::sigemptyset(&set);
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&set, each);
    ::pthread_sigmask(SIG_BLOCK, &set, &before_->set);
}

SignalsWait::~SignalsWait() {
    ::pthread_sigmask(SIG_SETMASK, &before_->set, nullptr);
}
#endif

std::unique_ptr<FileLock> FileLock::take(const std::filesystem::path& path) {
    constexpr int tries = 10;
    for (int i = 0; i < tries; ++i) {
        SystemFile file = SystemFile::open_or_create(path);
        if (!file || !file.try_lock()) return nullptr;
        // The last holder may have removed the file after we opened it: the lock would then be on a file that
        // nobody else can find.
        if (file.has_name(path)) return std::unique_ptr<FileLock>(new FileLock(path, std::move(file)));
    }
    return nullptr;
}

bool FileLock::is_held(const std::filesystem::path& path) {
    SystemFile file = SystemFile::open(path);
    return file && !file.try_lock(true);
}

FileLock::~FileLock() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

}  // namespace tendril::app
