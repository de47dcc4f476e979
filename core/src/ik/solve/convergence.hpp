// How a solve goes on: whether the tip still comes nearer, and when the chain is to be perturbed. Not
// installed.
#pragma once

#include <algorithm>
#include <cmath>

#include "tendril/ik/solver.hpp"

namespace tendril::ik::detail {

class Convergence {
  public:
    explicit Convergence(float residual) noexcept : best_(residual), nearest_(residual), last_(residual) {}

    /// After a perturbation: what came before no longer counts.
    void restart(float residual) noexcept {
        nearest_ = last_ = residual;
        idle_ = slow_ = 0;
    }

    /// After an iteration. True where no pose of the whole solve has been nearer.
    bool record(float residual, float reach) noexcept {
        // A method that overshoots and comes back has not stalled.
        const bool moves = std::abs(residual - last_) > 1e-5f * reach;
        idle_ = moves || residual < nearest_ ? 0 : idle_ + 1;
        slow_ = residual > 0.8f * last_ ? slow_ + 1 : 0;
        nearest_ = std::min(nearest_, residual);
        last_ = residual;
        if (!(residual < best_)) return false;
        best_ = residual;
        return true;
    }

    bool stalled() const noexcept { return idle_ >= 10; }

    /// Before a stall is believed. Without it, of 20 000 hostile chains (folded, straight, bones of no
    /// length), 72 instead of 1 stall with DLS, 168 instead of 15 with CCD, 278 instead of 25 with the
    /// transpose, and FABRIK leaves 606 instead of 576 short. The fast FABRIK takes all of the residual away
    /// in an iteration or two, unless the chain lies folded nearly on a line: then it is not waited for.
    bool wants_perturbation(Method method) const noexcept {
        if (method == Method::FabrikPlain || perturbations_ >= 4) return false;
        return stalled() || (method == Method::Fabrik && slow_ >= 2);
    }
    /// Which one it is, from 0.
    int count_perturbation() noexcept { return perturbations_++; }

    /// The smallest residual of the whole solve.
    float best() const noexcept { return best_; }

  private:
    float best_;
    float nearest_;  ///< since the last perturbation
    float last_;
    int idle_ = 0;  ///< iterations in which the residual neither fell below `nearest_` nor changed
    int slow_ = 0;  ///< iterations that left over 80 % of the residual
    int perturbations_ = 0;
};

}  // namespace tendril::ik::detail
