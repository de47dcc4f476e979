// How the default method goes down to its target where FABRIK's passes within limits alone get stuck, which
// they do in about half of all cases. Not installed.
//
// FABRIK's passes go on as long as a pair brings the tip half way or more. Damped least-squares steps over
// what the limits leave free do the rest; their damping falls with success and grows with failure (Levenberg
// 1944, Marquardt 1963). Passes after these gain nothing and cost twice as much.
#pragma once

#include "ik/solve/convergence.hpp"
#include "ik/solve/problem.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {

/// Where and how a start begins, and how it goes on.
class LimitedDescent {
  public:
    /// `allowance`: no joint goes further than this from where scratch.start has it, metres.
    LimitedDescent(const Problem& problem, float allowance) noexcept;

    /// FABRIK's passes or a least-squares step, taken only where the tip comes nearer.
    template <class Watch>
    void iterate(Problem& problem, Watch watch) noexcept;

    /// From another pose, as far as it takes: what was singular cannot be left by a little.
    void restart(const Problem& problem) noexcept;
    /// Least squares at once, for near the target a step does what FABRIK's passes take several for; with the
    /// damping of a descent that ended here, and if that had stalled, only as long as every step gains.
    void continue_from(float damping, bool stalled) noexcept;

    bool stalled() const noexcept { return convergence_.stalled(); }
    float error() const noexcept { return error_; }
    float damping() const noexcept { return damping_; }
    /// The last step was longer than the allowance.
    bool exceeds_allowance() const noexcept { return exceeds_allowance_; }

  private:
    bool may_take(const Problem& problem) noexcept;
    template <class Watch>
    void reach(Problem& problem, Watch watch) noexcept;
    template <class Watch>
    void step(Problem& problem, Watch watch) noexcept;

    float damping_ = tune::limits::first_damping;  ///< in reach squared
    float error_;                                  ///< of the pose
    float allowance_;
    Convergence convergence_;  ///< of the least-squares steps
    bool reaches_ = true;      ///< FABRIK's passes bring the tip half way or more
    bool exceeds_allowance_ = false;
};

}  // namespace tendril::ik::detail
