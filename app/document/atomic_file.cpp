#include "app/document/atomic_file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace tendril::app {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
    // A name may contain a zero byte; a message cannot.
    throw std::runtime_error("cannot write " + std::string(path.string().c_str()) + ": " + reason);
}

/// Resolves a chain of symbolic links. The final file need not exist.
fs::path follow_links(const fs::path& path) {
    constexpr int max_links = 40;
    fs::path file = path;
    std::error_code error;
    for (int links = 0; fs::is_symlink(fs::symlink_status(file, error)); ++links) {
        if (links == max_links) fail(path, "too many symbolic links");
        const fs::path target = fs::read_symlink(file, error);
        if (error) fail(path, error.message());
        file = target.is_absolute() ? target : file.parent_path() / target;
    }
    return file;
}

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The status of `path`. Throws if no file can be created there.
fs::file_status check_place(const fs::path& path) {
    if (path.empty() || path.string().find('\0') != std::string::npos) fail(path, "not a file name");
    std::error_code error;
    const auto status = fs::status(path, error);
    if (fs::is_directory(status) || !path.has_filename()) fail(path, "is a folder");
    if (status.type() == fs::file_type::none) fail(path, error.message());
    return status;
}

/// A device or a pipe (/dev/stdout) must be written to directly: a rename would replace it.
bool is_stream(const fs::file_status& status) {
    return fs::exists(status) && !fs::is_regular_file(status);
}

constexpr std::string_view torn_start = ".tendril-", torn_end = ".tmp";

/// A name that no other writer is using, in this program or another.
fs::path temporary_name(const fs::path& folder) {
    static std::atomic<unsigned> counter{0};
    return folder / (std::string(torn_start) + std::to_string(::getpid()) + "-" + std::to_string(counter++) +
                     std::string(torn_end));
}

std::string last_error() {
    return std::generic_category().message(errno);
}

/// Refuses to replace a read-only file; rename() alone would not check.
void check_permission(const fs::path& path) {
    if (::access(path.c_str(), W_OK) != 0 && errno != ENOENT) fail(path, last_error());
}

int open_file(const fs::path& path, int flags) {
    int fd = -1;
    do fd = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    while (fd < 0 && errno == EINTR);
    return fd;
}

bool write_all(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(fd, bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

/// Opening a pipe blocks until somebody reads it; this gives up after 5 s.
int open_stream(const fs::path& path) {
    using Time = std::chrono::steady_clock;
    const auto end = Time::now() + std::chrono::seconds(5);
    int fd = -1;
    while ((fd = open_file(path, O_WRONLY | O_NONBLOCK)) < 0 && errno == ENXIO && Time::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (fd < 0) fail(path, errno == ENXIO ? "nobody reads from this pipe" : last_error());
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) & ~O_NONBLOCK);
    return fd;
}

void write_stream(const fs::path& path, std::string_view bytes) {
    const int fd = open_stream(path);
    const bool written = write_all(fd, bytes);
    const std::string reason = last_error();
    ::close(fd);
    if (!written) fail(path, reason);
}

}  // namespace

/// A temporary file in the target's folder, deleted unless it is moved over the target.
class AtomicFile::Beside {
  public:
    Beside(const fs::path& target, const fs::path& folder) : target_(target) {
        // A killed program with the same process ID may have left a file of this name.
        constexpr int tries = 1000;
        for (int i = 0; i < tries && fd_ < 0; ++i) {
            name_ = temporary_name(folder);
            fd_ = open_file(name_, O_WRONLY | O_CREAT | O_EXCL);
            if (fd_ < 0 && errno != EEXIST) break;
            // Until it is locked, another program may mistake it for a leftover and delete it.
            struct stat made {};
            const bool taken = fd_ >= 0 && ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
            if (taken || (fd_ >= 0 && ::fstat(fd_, &made) == 0 && made.st_nlink == 0))
                ::close(std::exchange(fd_, -1));
        }
        if (fd_ < 0) fail(target_, last_error());
    }
    ~Beside() {
        if (fd_ >= 0) ::close(fd_);
        if (!moved_) ::unlink(name_.c_str());
    }
    Beside(const Beside&) = delete;
    Beside& operator=(const Beside&) = delete;

    const fs::path& name() const { return name_; }
    void append(std::string_view bytes) { require(write_all(fd_, bytes)); }
    /// Returns once all data is on disk, with the permissions of `old` if that exists.
    void finish(const fs::path& old) {
        struct stat before {};
        if (::stat(old.c_str(), &before) == 0) require(::fchmod(fd_, before.st_mode & 07777) == 0);
        require(::fsync(fd_) == 0);
    }
    void move_over(const fs::path& file) {
        require(::rename(name_.c_str(), file.c_str()) == 0);
        moved_ = true;
        ::close(std::exchange(fd_, -1));  // until here its lock showed that it is not torn
        // The rename has succeeded; a file system that cannot sync a folder is no error.
        const int folder = open_file(folder_of(file), O_RDONLY | O_DIRECTORY);
        if (folder < 0) return;
        ::fsync(folder);
        ::close(folder);
    }

  private:
    void require(bool done) const {
        if (!done) fail(target_, last_error());
    }
    fs::path target_, name_;
    int fd_ = -1;
    bool moved_ = false;
};

namespace {

/// Signals that would end the program wait until the temporary file is gone.
class SignalsWait {
  public:
    SignalsWait() {
        sigset_t set;
        ::sigemptyset(&set);
        for (const int each : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&set, each);
        ::pthread_sigmask(SIG_BLOCK, &set, &before_);
    }
    ~SignalsWait() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalsWait(const SignalsWait&) = delete;
    SignalsWait& operator=(const SignalsWait&) = delete;

  private:
    sigset_t before_{};
};

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view bytes) {
    if (is_stream(check_place(path))) return write_stream(path, bytes);
    const SignalsWait wait;
    AtomicFile file(path);
    file.append(bytes);
    file.commit();
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
    if (is_stream(check_place(path))) fail(path, "is not a regular file");
    check_permission(path);
    file_ = follow_links(path);
    beside_ = std::make_unique<Beside>(path, folder_of(file_));
}

AtomicFile::~AtomicFile() = default;

void AtomicFile::append(std::string_view bytes) {
    beside_->append(bytes);
}

const fs::path& AtomicFile::beside() const {
    return beside_->name();
}

void AtomicFile::commit(const fs::path& other) {
    const fs::path& file = other.empty() ? file_ : other;
    beside_->finish(file);
    beside_->move_over(file);
}

fs::path numbered_file(const fs::path& stem, const std::string& extension) {
    std::error_code ignored;
    for (int i = 1;; ++i)
        if (fs::path path = stem.string() + "-" + std::to_string(i) + extension; !fs::exists(path, ignored))
            return path;
}

void remove_torn_files(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error)) {
        const std::string name = each->path().filename().string();
        if (!name.starts_with(torn_start) || !name.ends_with(torn_end)) continue;
        const int fd = open_file(each->path(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
        if (fd < 0) continue;
        // Its writer holds the lock as long as it runs.
        if (::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(each->path().c_str());
        ::close(fd);
    }
}

void check_writable(const fs::path& path) {
    const bool stream = is_stream(check_place(path));
    check_permission(path);
    // Creates a file to find out: permissions do not reveal read-only and virtual file systems.
    if (stream) return;
    const SignalsWait wait;
    AtomicFile{path};
}

std::string shown_path(const fs::path& path) {
    std::error_code ignored;
    std::string text = fs::absolute(path, ignored).lexically_normal().string();
    const char* const home = std::getenv("HOME");
    const std::string under = home != nullptr ? std::string(home) + '/' : std::string();
    if (under.size() > 2 && text.starts_with(under)) text = "~/" + text.substr(under.size());
    if (text.size() <= longest_shown_path) return text;
    const std::size_t first = text.find('/', 1);
    if (first == text.npos) return text;
    const std::string begin = text.substr(0, first) + "/...";
    std::size_t end = text.rfind('/');
    while (end > first) {
        const std::size_t up = text.rfind('/', end - 1);
        if (up <= first || begin.size() + text.size() - up > longest_shown_path) break;
        end = up;
    }
    return end > first ? begin + text.substr(end) : text;
}

std::string written_text(const fs::path& path) {
    return "Written: " + shown_path(path);
}

}  // namespace tendril::app
