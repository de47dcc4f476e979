#include "app/document/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tendril::app {

std::unique_ptr<FileLock> FileLock::take(const std::filesystem::path& file) {
    constexpr int tries = 10;
    for (int i = 0; i < tries; ++i) {
        const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (fd < 0) return nullptr;
        if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
            ::close(fd);
            return nullptr;
        }
        // The last holder may have removed the file since we opened it: then the lock is on a file that
        // nobody else can find.
        struct stat locked {
        }, named{};
        if (::fstat(fd, &locked) == 0 && ::stat(file.c_str(), &named) == 0 && locked.st_ino == named.st_ino)
            return std::unique_ptr<FileLock>(new FileLock(file, fd));
        ::close(fd);
    }
    return nullptr;
}

bool FileLock::is_held(const std::filesystem::path& file) {
    const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return false;
    const bool held = ::flock(fd, LOCK_SH | LOCK_NB) != 0;
    ::close(fd);
    return held;
}

FileLock::~FileLock() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    ::close(fd_);
}

}  // namespace tendril::app
