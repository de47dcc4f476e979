// Whether an iteration still gets anywhere: one rule for all loops. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace tendril::ik::detail {

/// When a loop has stalled: after `window` iterations in which the error neither fell, by both of these since
/// it last did so, nor moved.
struct StallRule {
    int window;
    float relative = 0.0f;  ///< of the error, or of a tenth of the reach where that is less
    float absolute = 0.0f;  ///< metres
    /// Metres: an error that changes by more in an iteration moves. A method that overshoots and comes back
    /// has not stalled.
    float moves = std::numeric_limits<float>::infinity();
};

class Convergence {
  public:
    Convergence(const StallRule& rule, float error, float reach) noexcept
        : rule_(rule), scale_(0.1f * reach), best_(error), mark_(error), last_(error) {}

    /// After a perturbation: what came before no longer counts, but for `best`.
    void restart(float error) noexcept {
        mark_ = last_ = error;
        idle_ = 0;
    }
    /// Of a loop that goes on from one that had stalled: the next iteration that gains nothing is the last.
    void resume_stalled() noexcept { idle_ = rule_.window - 1; }
    /// Nothing can be gained any more.
    void end() noexcept { idle_ = rule_.window; }
    /// After an iteration. True where the error has never been smaller.
    bool record(float error) noexcept {
        // Far from a target that cannot be reached only so much may still be gained.
        const float gain = std::max(rule_.relative * std::min(mark_, scale_), rule_.absolute);
        const bool fell = error<mark_ - gain, moved = std::abs(error - last_)> rule_.moves;
        idle_ = fell || moved ? 0 : idle_ + 1;
        if (fell) mark_ = error;
        last_ = error;
        if (!(error < best_)) return false;
        best_ = error;
        return true;
    }
    bool stalled() const noexcept { return idle_ >= rule_.window; }
    float last() const noexcept { return last_; }
    /// The smallest error of the whole solve.
    float best() const noexcept { return best_; }

  private:
    StallRule rule_;
    float scale_, best_;
    float mark_;  ///< where the error last fell to
    float last_;
    int idle_ = 0;
};

}  // namespace tendril::ik::detail
