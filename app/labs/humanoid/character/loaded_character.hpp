// A character as the lab has it: what was read from a file, with what follows from that alone. It never
// changes, and copies of the document share it.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/lint.hpp>
#include <thread>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/progress.hpp"

namespace tendril::app {

/// A fault of a clip that was mended: all of that kind, or those of one node, or the one at a frame.
struct ClipCure {
    std::string clip;
    humanoid::Fault fault = humanoid::Fault::SignFlip;
    std::string node{};  ///< empty: all
    std::optional<std::size_t> frame{};
    bool operator==(const ClipCure&) const = default;
};

struct LoadedCharacter {
    std::string file;  ///< as it was named; empty: the stick figure
    std::string path;  ///< where that is, whatever the working folder; empty with it
    Character character;
    std::vector<ClipCure> cures{};          ///< what was done to its clips since, in that order
    humanoid::BoneMap matched;              ///< as the file names it, or the library matches it
    std::vector<humanoid::Placement> rest;  ///< of every node
    glm::dvec3 low{0.0}, high{0.0};         ///< of a box around them and the skin, metres
    const humanoid::Skeleton& skeleton() const { return character.skeleton; }
    const std::vector<humanoid::Clip>& clips() const { return character.clips; }
    double height() const { return high.y - low.y; }
};
using SharedCharacter = std::shared_ptr<const LoadedCharacter>;

/// Without a file name the stick figure. Throws std::runtime_error that begins with the file's name.
SharedCharacter load_character(const std::string& file, LoadProgress* progress = nullptr);
/// The same character with so many metres to a unit of its file.
SharedCharacter rescaled(const LoadedCharacter& character, double metres);

// A large character file that is read beside the running program: the figure that is there stays until the
// other has come, and for good where it is refused or cancelled.

class Loading {
  public:
    /// Smaller files are read before anybody could look away.
    static constexpr std::uintmax_t large_file = 1u << 20;

    Loading() = default;
    /// Waits for the reader to heed its cancelling.
    ~Loading() { cancel(); }
    Loading(const Loading&) = delete;
    Loading& operator=(const Loading&) = delete;

    /// Begins to read; what was being read before is cancelled.
    void begin(const std::string& file);
    void cancel();
    bool running() const { return thread_.joinable(); }
    const std::string& file() const { return file_; }
    float part() const { return progress_->part(); }
    /// Whether take() has something to give at once.
    bool done() const { return running() && done_; }
    /// The character; waits for it. Throws what reading it threw. Then nothing is running.
    SharedCharacter take();

  private:
    std::string file_;
    std::unique_ptr<LoadProgress> progress_ = std::make_unique<LoadProgress>();
    std::atomic<bool> done_{false};
    SharedCharacter read_;
    std::exception_ptr refused_;
    std::thread thread_;
};

/// Whether it is worth it: in a window, where somebody waits, and a large file.
bool loads_beside(const Workspace& workspace, const std::string& file);

}  // namespace tendril::app
