// Atomic file writes: a temporary file in the same folder is written, synced to disk and renamed over the old
// one, so a crash leaves either the old file or the new one. The program writes files in no other way. Also
// formats paths for messages.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace tendril::app {

/// Throws std::runtime_error: "cannot write <path>: <reason>"; the old file is then unchanged and no
/// temporary file remains. Keeps the permissions of a file it replaces, follows symbolic links, and writes to
/// devices and pipes directly; a pipe that nobody opens to read within 5 s is refused.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// The same for data written in pieces, or by another program. Throws as above.
class AtomicFile {
  public:
    /// Creates the temporary file. `path` must be a regular file or not exist: no device, no pipe.
    explicit AtomicFile(const std::filesystem::path& path);
    /// Deletes the temporary file unless it was committed.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void append(std::string_view bytes);
    /// The temporary file, for a program that writes it instead of append().
    const std::filesystem::path& beside() const;
    /// Syncs it and renames it over the old one, or to `other` in the same folder.
    void commit(const std::filesystem::path& other = {});

  private:
    class Beside;
    std::filesystem::path path_, file_;  ///< as given, and with symbolic links resolved
    std::unique_ptr<Beside> beside_;
};

/// "stem-1.png", or with the next number that no file in its folder has.
std::filesystem::path numbered_file(const std::filesystem::path& stem, const std::string& extension);

/// Removes the temporary files that programs left in a folder when they were killed.
void remove_torn_files(const std::filesystem::path& folder);

/// Throws, as above, if `path` cannot be written: its folder is missing or not writable, or it is a folder
/// itself. Leaves no file behind.
void check_writable(const std::filesystem::path& path);

inline constexpr std::size_t longest_shown_path = 100;

/// The path for display: "~/pictures/tendril-1.png". A long one loses folders in the middle ("..."), never
/// its file name.
std::string shown_path(const std::filesystem::path& path);

/// "Written: ~/pictures/tendril-1.png"
std::string written_text(const std::filesystem::path& path);

}  // namespace tendril::app
