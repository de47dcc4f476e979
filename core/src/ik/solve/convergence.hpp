// Detects when iterations no longer converge: one rule for all loops. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace tendril::ik::detail {

/// A loop has stalled after `window` iterations in which the error neither moved nor fell below its last mark
/// by the larger of these amounts.
struct StallRule {
    int window;
    float relative = 0.0f;  ///< fraction of the error, or of a tenth of the reach if that is less
    float absolute = 0.0f;  ///< metres
    /// Metres: an error that changes by more than this in an iteration is moving. A method that overshoots
    /// and recovers has not stalled.
    float moves = std::numeric_limits<float>::infinity();
};

class Convergence {
  public:
    Convergence(const StallRule& rule, float error, float reach) noexcept
        : rule_(rule), scale_(0.1f * reach), best_(error), mark_(error), last_(error) {}

    /// Call after a perturbation: forgets everything except `best`.
    void restart(float error) noexcept {
        mark_ = last_ = error;
        idle_ = 0;
    }
    /// Call to continue from a stalled loop: the next iteration without gain is the last.
    void resume_stalled() noexcept { idle_ = rule_.window - 1; }
    /// Marks the loop as stalled: nothing more can be gained.
    void end() noexcept { idle_ = rule_.window; }
    /// Call after each iteration. True if the error is a new minimum.
    bool record(float error) noexcept {
        // Far from an unreachable target, the gain still possible is bounded.
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
    /// The minimum error of the whole solve.
    float best() const noexcept { return best_; }

  private:
    StallRule rule_;
    float scale_, best_;
    float mark_;  ///< the error when it last fell
    float last_;
    int idle_ = 0;
};

}  // namespace tendril::ik::detail
