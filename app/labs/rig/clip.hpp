// Recording a take as a clip, solving a clip backward, and comparing a take at the usual frame rates.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/io/character/character.hpp"
#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

class RigRuntime;

/// Throws std::invalid_argument if the rig has no bones.
void check_records(const RigPart& part);
std::string seconds_text(std::size_t ticks);  ///< "12.3 s"
/// The most ticks that fit in a clip of this rig; 0 if it has no bones.
std::size_t clip_room(const RigPart& part);
/// Keeps the end of the first `ticks` ticks of `played` as the part's clip, as much as fits, and ends a
/// recording. Returns which part is missing; empty if none is. Throws as check_records does.
std::string keep_clip(RigPart& part, RigPart played, std::size_t ticks, RigRuntime& runtime);

/// The rig's bones and the clip, as the writers of files take them. Throws std::invalid_argument if there is
/// no clip, or if its bones differ from the rig's.
Character clip_character(const RigPart& part);
/// "; bones scaled unequally: hand is 12.3 mm off". The rig multiplies scales axis by axis; files multiply
/// matrices, which shears. Empty if no bone is far off.
std::string sheared_text(const Character& character);

/// Starts a backward solve of the clip. Throws std::invalid_argument if there is no clip, if its bones differ
/// from the rig's, or if a single frame would take too long.
void start_clip_solve(RigPart& part);
/// Throws as start_clip_solve does.
void check_clip_solve(const RigPart& part);
/// Solves the frames that fit in one tick. Counts work instead of time, so results are reproducible.
void continue_clip_solve(RigPart& part, rig::Workspace& scratch);

/// Consecutive frames that the rig cannot express.
struct LeftRun {
    std::size_t first = 0, last = 0;  ///< inclusive
    std::size_t worst = 0;
};
std::vector<LeftRun> left_runs(const ClipSolve& solve);
/// The frame with the largest residual; none if no frame was solved.
std::optional<std::size_t> worst_frame(const ClipSolve& solve);
double amount(const FrameLeft& left);  ///< the same measure as for a residual
/// "12.3 mm, 8.1 degrees", followed by ", scale 0.250" if that is large enough to show
std::string left_text(double mm, double degrees, double scale);

// Plays the take at all usual frame rates and measures how far apart its bones get.
//
// Each rate samples the controls at the ends of its own frames, as a game at that rate would. The takes are
// compared at the end of each frame of the slowest rate. Each tick processes only a few of those frames, so
// that the window stays responsive; the part stores the progress.

inline constexpr double max_rate_seconds = 10.0;
inline constexpr std::size_t max_rate_frames = 1000;  ///< at the slowest rate

/// Starts comparing the first `ticks` ticks of the take. Throws std::invalid_argument if that takes too long.
void start_rates(RigPart& part, std::uint32_t ticks);
/// Progress, 0 to 1.
float rates_done(const RateDifference& rates);

/// The takes in progress. A cache: if discarded, they are replayed up to the progress that the part stores.
class RatesWork {
  public:
    RatesWork();
    ~RatesWork();
    /// Processes the frames that fit in one tick. Counts work instead of time, so results are reproducible.
    void advance(RigPart& part);

  private:
    struct Takes;
    std::unique_ptr<Takes> takes_;
};

}  // namespace tendril::app
