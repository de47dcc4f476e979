// A character read from a file, and the data derived from it. Immutable; copies of the document share it.
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

/// Which faults of a clip were mended: all, those of one kind or node, or those at a frame.
struct ClipCure {
    std::string clip;
    std::optional<humanoid::Fault> fault{};  ///< none: all kinds
    std::string node{};                      ///< empty: all
    std::optional<std::size_t> frame{};
    bool operator==(const ClipCure&) const = default;
};

/// A clip of another file that was carried over.
struct LoadedMotion {
    std::string file;                  ///< as given
    std::string path;                  ///< absolute
    std::string clip;                  ///< its name there
    std::vector<std::string> notes{};  ///< RetargetedMotion::notes
    bool operator==(const LoadedMotion&) const = default;
};

struct LoadedCharacter {
    std::string file;  ///< as given; empty: the stick figure
    std::string path;  ///< absolute path; empty for the stick figure
    Character character;
    std::vector<LoadedMotion> motions{};    ///< its last clips before they were cured
    std::vector<ClipCure> cures{};          ///< applied to its clips, in this order
    humanoid::BoneMap matched;              ///< as named in the file, or as matched by the library
    std::vector<humanoid::Placement> rest;  ///< of all nodes
    RestBounds bounds{};                    ///< at rest
    const humanoid::Skeleton& skeleton() const { return character.skeleton; }
    const std::vector<humanoid::Clip>& clips() const { return character.clips; }
    double height() const { return bounds.height(); }
    std::optional<UnitDoubt> doubted_unit(const humanoid::BoneMap& map) const {
        return app::doubted_unit(height(), character.scale, map);
    }
};
using SharedCharacter = std::shared_ptr<const LoadedCharacter>;

/// An empty file name gives the stick figure. Throws std::runtime_error that begins with the file name.
SharedCharacter load_character(const std::string& file, LoadProgress* progress = nullptr);
/// The same character with a unit of `metres` and other axes. Throws std::runtime_error.
SharedCharacter read_as(const LoadedCharacter& character, double metres, const FileSpace& space);

// Loads a large character file in the background. The current figure stays until loading succeeds.

class Loading {
  public:
    /// Smaller files load fast enough to wait for.
    static constexpr std::uintmax_t large_file = 1u << 20;

    Loading() = default;
    /// Cancels, and waits for the reader.
    ~Loading() { cancel(); }
    Loading(const Loading&) = delete;
    Loading& operator=(const Loading&) = delete;

    /// Starts reading; cancels a read in progress. `from`: the open lab, to which undo goes back.
    void begin(const std::string& file, const std::string& from);
    void cancel();
    bool running() const { return thread_.joinable(); }
    const std::string& file() const { return file_; }
    const std::string& from() const { return from_; }
    float part() const { return progress_->part(); }
    /// Whether take() would return without waiting.
    bool done() const { return running() && done_; }
    /// Waits for the character and returns it. Throws what reading it threw. Nothing runs afterwards.
    SharedCharacter take();

  private:
    std::string file_, from_;
    std::unique_ptr<LoadProgress> progress_ = std::make_unique<LoadProgress>();
    std::atomic<bool> done_{false};
    SharedCharacter read_;
    std::exception_ptr refused_;
    std::thread thread_;
};

/// Whether to load in the background: a large file, and a window whose user waits.
bool loads_beside(const Workspace& workspace, const std::string& file);

}  // namespace tendril::app
