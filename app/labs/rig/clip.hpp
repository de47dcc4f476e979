// Baking a take into a clip, and solving a clip backward.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

/// The first `frames` ticks of the take, and its start. Throws std::invalid_argument where the rig has no
/// bones, or where that would be more than a clip holds or take too long.
RigClip record_clip(const RigPart& part, std::size_t frames, rig::Workspace& scratch);

/// Begins a backward solve of the clip. Throws std::invalid_argument where there is no clip, where it is of
/// other bones than the rig has, or where a single frame would take too long.
void start_clip_solve(RigPart& part);
/// What start_clip_solve refuses.
void check_clip_solve(const RigPart& part);
/// As many frames of it as a tick has time for, by count and not by the clock: so that it comes out the same.
void continue_clip_solve(RigPart& part, rig::Workspace& scratch);

/// Frames one after the other that the rig cannot express, with the worst of them.
struct LeftRun {
    std::size_t first = 0, last = 0;  ///< frames, the last included
    std::size_t worst = 0;
};
std::vector<LeftRun> left_runs(const ClipSolve& solve);
/// The frame with the most left; none where none was solved.
std::optional<std::size_t> worst_frame(const ClipSolve& solve);
double amount(const FrameLeft& left);  ///< as of a residual
/// "12.3 mm, 8.1 degrees", and the scale where it shows: ", scale 0.250"
std::string left_text(double mm, double degrees, double scale);

// The take at the usual frame rates at once: how far apart its bones come.
//
// Each sees the controls as they are at the ends of its own frames, as games at those rates would; they are
// held against each other at the end of every frame of the slowest. Some of those frames in every tick, so
// that the window stays responsive; how far it is stands in the part.

inline constexpr double max_rate_seconds = 10.0;
inline constexpr std::size_t max_rate_frames = 1000;  ///< of the slowest rate

/// Begins with the first so many ticks of the take. Throws std::invalid_argument where that would take too
/// long.
void start_rates(RigPart& part, std::uint32_t ticks);
/// Part of all that there is to compare, 0 to 1.
float rates_done(const RateDifference& rates);

/// The takes on their way. They follow from the part: those that were thrown away are made again, as far as
/// the part says that they are.
class RatesWork {
  public:
    RatesWork();
    ~RatesWork();
    /// As many frames as a tick has time for, by count and not by the clock: so that it comes out the same.
    void advance(RigPart& part);

  private:
    struct Takes;
    std::unique_ptr<Takes> takes_;
};

}  // namespace tendril::app
