// A character read from a file, and the data derived from it. Immutable; copies of the document share it.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/lint.hpp>
#include <thread>
#include <variant>
#include <vector>

#include "app/document/outside_file.hpp"
#include "app/document/workspace.hpp"
#include "app/io/character/character.hpp"
#include "app/labs/humanoid/ik/ik_settings.hpp"

namespace tendril::app {

/// Which faults of a clip were fixed: all, those of one kind or node, or those in one frame.
struct ClipCure {
    std::string clip;
    std::optional<humanoid::Fault> fault{};  ///< none: all kinds
    std::string node{};                      ///< empty: all
    std::optional<std::size_t> frame{};
    bool operator==(const ClipCure&) const = default;
};

struct LoadedCharacter;
using SharedCharacter = std::shared_ptr<const LoadedCharacter>;

/// The bones that the user has mapped to other nodes than the file's names suggest; -1: to none.
using Corrections = std::map<humanoid::Bone, std::int32_t>;

/// The settings on which a clip depends when it is retargeted or fixed.
struct Reading {
    double scale = 1.0;  ///< Character::scale
    FileSpace space{};
    Corrections bones{};
    LimitsFrom limits = LimitsFrom::Defaults;
    bool operator==(const Reading&) const = default;
};

/// A clip retargeted from another file.
struct LoadedMotion : OutsideFile {
    std::string clip;                  ///< its name there
    std::vector<std::string> notes{};  ///< RetargetedMotion::notes
    /// The clip's character, with its fixes; null: as its file is read.
    SharedCharacter source{};
    Reading source_as{};
    bool operator==(const LoadedMotion&) const = default;
};

/// A clip that was added or changed. A scene file stores `what` and `as`; loading repeats the edit.
struct ClipEdit {
    std::variant<LoadedMotion, ClipCure> what;
    Reading as{};                                     ///< settings at the time
    std::shared_ptr<const humanoid::Clip> clip;       ///< in the metres and axes of `as`
    std::shared_ptr<const humanoid::Clip> unfixed{};  ///< a motion before its fixes; null: it has none
};

/// The stick figure if there is no file.
struct LoadedCharacter : OutsideFile {
    Character character;
    std::vector<ClipEdit> edits{};                    ///< edits of its clips, in order
    std::shared_ptr<const LoadedCharacter> source{};  ///< as first read from its file; null: this one
    std::map<std::string, std::shared_ptr<const humanoid::Clip>> unfixed{};  ///< originals of fixed clips
    humanoid::BoneMap matched;              ///< from the file's names, or matched by the library
    std::vector<humanoid::Placement> rest;  ///< placements of all nodes at rest
    RestBounds bounds{};                    ///< at rest
    const humanoid::Skeleton& skeleton() const { return character.skeleton; }
    const std::vector<humanoid::Clip>& clips() const { return character.clips; }
    std::size_t clip_called(const std::string& name) const;  ///< throws std::invalid_argument
    /// The clip before its fixes.
    const humanoid::Clip& clip_unfixed(std::size_t clip) const;
    double height() const { return bounds.height(); }
    std::optional<UnitDoubt> doubted_unit(const humanoid::BoneMap& map) const {
        return app::doubted_unit(height(), character.scale, map);
    }
};

/// An empty path gives the stick figure. `file`: the user's name for the file, if it differs. Throws
/// std::runtime_error that begins with the file name.
SharedCharacter load_character(const std::string& path, LoadProgress* progress = nullptr,
                               const std::string& file = {});
/// The same character with a unit of `metres` and other axes, independent of any earlier unit and axes.
/// Throws std::runtime_error.
SharedCharacter read_as(const SharedCharacter& character, double metres, const FileSpace& space);
/// The same character with one more edit, made in its current unit and axes.
SharedCharacter edited(const SharedCharacter& character, ClipEdit edit);
/// The bone map as matched, with corrections. A node given to one bone is taken from any other.
humanoid::BoneMap corrected(const LoadedCharacter& character, const Corrections& corrections);

// Reads a large file, or fixes a long clip, in the background. The document changes only once that succeeds.

class Loading {
  public:
    /// Smaller files load fast enough to wait for.
    static constexpr std::uintmax_t large_file = 1u << 20;

    /// Puts the result into the workspace.
    using Change = std::function<void(Workspace&)>;
    struct Work {
        std::string command;                       ///< the command of the undo step
        std::string what;                          ///< "Loading walk.bvh"
        std::string from;                          ///< the lab that was open; undo returns to it
        std::function<Change(LoadProgress&)> run;  ///< in another thread
    };

    Loading() = default;
    /// Cancels, and waits.
    ~Loading();
    Loading(const Loading&) = delete;
    Loading& operator=(const Loading&) = delete;

    /// Cancels any running work.
    void begin(Work work);
    /// Does not wait for the thread, which stops when it next reports its progress.
    void cancel();
    bool running() const { return job_ != nullptr; }
    /// The running work; only while running().
    const Work& work() const { return job_->work; }
    float part() const { return job_->progress.part(); }
    /// True if take() would return without waiting.
    bool done() const { return running() && job_->done; }
    /// Waits for the change and returns it. Throws the work's exception. Nothing runs afterwards.
    Change take();

  private:
    struct Job {
        Work work{};
        LoadProgress progress{};
        std::atomic<bool> done{false};
        Change change{};
        std::exception_ptr refused{};
        std::thread thread{};
    };
    std::unique_ptr<Job> job_;
    std::vector<std::unique_ptr<Job>> cancelled_;
};

/// Whether to load in the background: a large file, in a window with a user.
bool loads_beside(const Workspace& workspace, const std::string& file);

}  // namespace tendril::app
