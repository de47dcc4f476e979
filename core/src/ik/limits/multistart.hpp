// How the default method arrives where FABRIK's pulls within limits alone get stuck, which they do in about
// half of all cases. Not installed.
//
// - Where a pair of pulls brings the tip less than half way, a damped least-squares step over the angles that
//   the limits leave free goes on from the nearer of the poses before and after the pulls. Its damping falls
//   with success and grows with failure (Levenberg 1944, Marquardt 1963).
// - Where both stall, the chain tries again from another pose within its limits: the best of four that are
//   drawn by a fixed rule, the same for the same chain, first near the best pose so far, then anywhere.
#pragma once

#include "ik/limits/pose.hpp"

namespace tendril::ik::detail {

class LimitedSearch {
  public:
    explicit LimitedSearch(float error) noexcept : last_(error) {}

    template <class Watch>
    void iterate(Problem& problem, Watch watch) noexcept;

    /// It stalled at least once.
    bool stalled() const noexcept { return tries_ > 0 || stalls(); }
    /// It stalled, and there is no other pose left to try.
    bool exhausted() const noexcept;
    /// Whether a pose with this error takes the place of the nearest one so far. A pose that another start
    /// led to must be clearly nearer than where the chain came by itself: it may lie elsewhere, and a chain
    /// whose target is out of its limits should not jump about for nothing.
    bool takes(float error, float nearest, bool arrived) const noexcept;

  private:
    bool stalls() const noexcept;
    void draw_start(Problem& problem) noexcept;
    template <class Watch>
    void start_from_trial(Problem& problem, Phase phase, Watch watch) noexcept;

    float damping_ = 1e-3f;  ///< in reach squared
    float last_;             ///< the error before
    float home_ = 0.0f;      ///< another start must lead to less than this
    int slow_ = 0;           ///< for how many iterations there was little progress
    int tries_ = 0;
    bool reaches_ = true;    ///< FABRIK's passes bring the tip half way or more
    bool polishes_ = false;  ///< goes on from the nearest pose to the end
};

}  // namespace tendril::ik::detail
