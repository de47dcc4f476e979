// Descent of the default method within limits. FABRIK's passes alone get stuck in about half of all cases.
// Not installed.
//
// FABRIK's passes continue while a pair at least halves the error. Then damped least-squares steps on the
// remaining degrees of freedom take over; their damping falls with success and grows with failure (Levenberg
// 1944, Marquardt 1963). More passes after these gain nothing and cost twice as much.
#pragma once

#include "ik/solve/convergence.hpp"
#include "ik/solve/problem.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {

/// State of one descent from one start pose.
class LimitedDescent {
  public:
    /// `allowance`: how far a joint may move from its position in scratch.start, metres.
    LimitedDescent(const Problem& problem, float allowance) noexcept;

    /// FABRIK's passes or a least-squares step, kept only if the tip comes nearer.
    template <class Watch>
    void iterate(Problem& problem, Watch watch) noexcept;

    /// Starts over from another pose, without an allowance: small moves cannot leave a singular pose.
    void restart(const Problem& problem) noexcept;
    /// Continues an earlier descent, which ended with this damping. Uses least squares at once, because near
    /// the target one step does as much as several passes. If the earlier descent had stalled, continues only
    /// while every step gains.
    void continue_from(float damping, bool stalled) noexcept;

    bool stalled() const noexcept { return convergence_.stalled(); }
    float error() const noexcept { return error_; }
    float damping() const noexcept { return damping_; }
    /// True if the last step was rejected because it exceeded the allowance.
    bool exceeds_allowance() const noexcept { return exceeds_allowance_; }

  private:
    bool may_take(const Problem& problem) noexcept;
    template <class Watch>
    void reach(Problem& problem, Watch watch) noexcept;
    template <class Watch>
    void step(Problem& problem, Watch watch) noexcept;

    float damping_ = tune::limits::first_damping;  ///< in reach squared
    float error_;                                  ///< error of the current pose
    float allowance_;
    Convergence convergence_;  ///< convergence of the least-squares steps
    bool reaches_ = true;      ///< FABRIK's passes still at least halve the error
    bool exceeds_allowance_ = false;
};

}  // namespace tendril::ik::detail
