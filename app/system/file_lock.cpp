#include "app/system/file_lock.hpp"

namespace tendril::app {

std::unique_ptr<FileLock> FileLock::take(const std::filesystem::path& path) {
    constexpr int tries = 10;
    for (int i = 0; i < tries; ++i) {
        SystemFile file = SystemFile::open_or_create(path);
        if (!file || !file.try_lock()) return nullptr;
        // The last holder may have removed the file since it was opened: the lock is then on a file that
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
