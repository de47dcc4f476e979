// Files that are either the old one or the new one, whatever happens in between: written beside, synced
// to disk, and renamed over the old name. The one way this program writes a file.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace tendril::app {

/// Throws std::runtime_error: "cannot write <path>: <reason>"; the old file is then as it was, and nothing is
/// left beside it. Keeps the permissions of a file it replaces and writes through a symbolic link.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// The same for what is written piece by piece, or by another program. Throws as above.
class AtomicFile {
  public:
    /// Makes the file beside. What stands at `path` must be a regular file or nothing: no device, no pipe.
    explicit AtomicFile(const std::filesystem::path& path);
    /// Unless it was committed, nothing is left of it.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void append(std::string_view bytes);
    /// The file beside, for a program that writes it in append()'s stead.
    const std::filesystem::path& beside() const;
    /// Syncs it and renames it over the old one.
    void commit();

  private:
    class Beside;
    std::filesystem::path path_, file_;  ///< as given, and where its links lead
    std::unique_ptr<Beside> beside_;
};

/// Throws, as above, where `path` could not be written later: its folder is missing or not writable, or it is
/// a folder itself. Leaves nothing behind.
void check_writable(const std::filesystem::path& path);

}  // namespace tendril::app
