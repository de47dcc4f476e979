#include "app/system/atomic_file.hpp"

#include <atomic>
#include <stdexcept>
#include <string>
#include <system_error>

#include "app/system/environment.hpp"
#include "app/system/file.hpp"

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

constexpr char slash = static_cast<char>(fs::path::preferred_separator);

constexpr std::string_view torn_start = ".tendril-", torn_end = ".tmp";

/// A name that no other writer is using, in this program or another.
fs::path temporary_name(const fs::path& folder) {
    static std::atomic<unsigned> counter{0};
    return folder / (std::string(torn_start) + std::to_string(process_id()) + "-" +
                     std::to_string(counter++) + std::string(torn_end));
}

/// Refuses to replace a read-only file; renaming alone would not check.
void check_permission(const fs::path& path) {
    if (!may_write(path)) fail(path, last_error().message());
}

void write_stream(const fs::path& path, std::string_view bytes) {
    SystemFile stream = SystemFile::open_stream(path);
    if (!stream)
        fail(path, last_error() == std::errc::no_such_device_or_address ? "nobody reads from this pipe"
                                                                        : last_error().message());
    if (!stream.write(bytes)) fail(path, last_error().message());
}

}  // namespace

/// A temporary file in the target's folder, deleted unless it is moved over the target.
class AtomicFile::Beside {
  public:
    Beside(const fs::path& target, const fs::path& folder) : target_(target) {
        // A killed program with the same process ID may have left a file of this name.
        constexpr int tries = 1000;
        std::error_code ignored;
        for (int i = 0; i < tries && !file_; ++i) {
            name_ = temporary_name(folder);
            file_ = SystemFile::create(name_);
            if (!file_ && last_error() != std::errc::file_exists) break;
            // Until it is locked, another program may mistake it for a leftover and delete it.
            const bool taken = file_ && !file_.try_lock() && last_error() == std::errc::operation_would_block;
            const bool gone = file_ && !fs::exists(name_, ignored);
            if (taken || gone) file_.close();
        }
        require(static_cast<bool>(file_));
    }
    ~Beside() {
        if (moved_) return;
        std::error_code ignored;
        fs::remove(name_, ignored);
    }
    Beside(const Beside&) = delete;
    Beside& operator=(const Beside&) = delete;

    const fs::path& name() const { return name_; }
    void append(std::string_view bytes) { require(file_.write(bytes)); }
    /// Returns once all data is on disk, under its final name and with the permissions of the file that it
    /// replaces.
    void move_over(const fs::path& file) {
        require(file_.copy_permissions(file) && file_.sync());
        require(replace_file(name_, file));
        moved_ = true;
        file_.close();  // its lock kept it from being deleted as a leftover until here
    }

  private:
    void require(bool done) const {
        if (!done) fail(target_, last_error().message());
    }
    fs::path target_, name_;
    SystemFile file_;
    bool moved_ = false;
};

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
        // Its writer holds the lock while it runs.
        SystemFile file = SystemFile::open(each->path());
        std::error_code ignored;
        if (file && file.try_lock()) fs::remove(each->path(), ignored);
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
    const std::string under = home_folder() + slash;
    if (under.size() > 2 && text.starts_with(under))
        text = std::string("~") + slash + text.substr(under.size());
    if (text.size() <= longest_shown_path) return text;
    const std::size_t first = text.find(slash, 1);
    if (first == text.npos) return text;
    const std::string begin = text.substr(0, first) + slash + "...";
    std::size_t end = text.rfind(slash);
    while (end > first) {
        const std::size_t up = text.rfind(slash, end - 1);
        if (up <= first || begin.size() + text.size() - up > longest_shown_path) break;
        end = up;
    }
    return end > first ? begin + text.substr(end) : text;
}

std::string written_text(const fs::path& path) {
    return "Written: " + shown_path(path);
}

}  // namespace tendril::app
