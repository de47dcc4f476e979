// The take at the usual frame rates at once: how far apart its bones come.
//
// Each sees the controls as they are at the ends of its own frames, as games at those rates would; they are
// held against each other at the end of every frame of the slowest. Some of those frames in every tick, so
// that the window stays responsive; how far it is stands in the part.
#pragma once

#include <memory>

#include "app/labs/rig/rig_part.hpp"

namespace tendril::app {

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
