#include "ik/limits/descent.hpp"

#include <algorithm>
#include <limits>

#include "ik/limits/least_squares.hpp"
#include "ik/limits/methods.hpp"
#include "ik/limits/pose.hpp"

namespace tendril::ik::detail {

using namespace tune::limits;

LimitedDescent::LimitedDescent(const Problem& problem, float allowance) noexcept
    : error_(error_of(problem, problem.scratch.limited.pose)),
      allowance_(allowance),
      convergence_(step_stall, error_, problem.scratch.reach) {}

void LimitedDescent::restart(const Problem& problem) noexcept {
    *this = LimitedDescent(problem, std::numeric_limits<float>::infinity());
}

void LimitedDescent::continue_from(float damping, bool stalled) noexcept {
    damping_ = std::max(damping, tune::limits::min_damping);
    reaches_ = false;
    if (stalled) convergence_.resume_stalled();
}

bool LimitedDescent::may_take(const Problem& problem) noexcept {
    const LimitedScratch& scratch = problem.scratch.limited;
    exceeds_allowance_ = allowance_ < std::numeric_limits<float>::infinity() &&
                         furthest_moved(problem, scratch.start, scratch.trial) > allowance_;
    return !exceeds_allowance_;
}

template <class Watch>
void LimitedDescent::reach(Problem& problem, Watch watch) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    limited_reaching(problem, watch);
    const float reached = error_of(problem, scratch.trial);
    reaches_ = reached < max_reach_ratio * error_;
    if (reached < error_ && may_take(problem)) {
        scratch.swap_pose(scratch.trial);
        error_ = reached;
    } else {
        reaches_ = false;
        report_moves(problem, scratch.trial, scratch.pose, Phase::RestoreBest, watch);
    }
    convergence_.restart(error_);
}

/// One damped step, kept if it brings the tip nearer; otherwise one retry with more damping.
template <class Watch>
void LimitedDescent::step(Problem& problem, Watch watch) noexcept {
    const TipDelta wanted = requested_delta(problem);
    Normal normal = linearize(problem, wanted);
    for (int attempt = 0; attempt < 2; ++attempt) {
        const TipDelta by = projected_step(problem, Descent::Damped, damping_, wanted, normal);
        if (predicted_gain(normal, wanted, by) < min_gain) return convergence_.end();
        rotate_joints(problem, by);
        const float then = error_of(problem, problem.scratch.limited.trial);
        if (then < error_ && may_take(problem)) {
            accept_trial(problem, Phase::Gradient, watch);
            error_ = then;
            damping_ = std::max(tune::limits::damping_falls * damping_, tune::limits::min_damping);
            ++problem.least_squares_steps;
            return;
        }
        damping_ = std::min(tune::limits::damping_grows * damping_, tune::limits::max_damping);
    }
}

template <class Watch>
void LimitedDescent::iterate(Problem& problem, Watch watch) noexcept {
    if (reaches_) return reach(problem, watch);
    step(problem, watch);
    convergence_.record(error_);
}

template void LimitedDescent::iterate(Problem&, Unwatched) noexcept;
template void LimitedDescent::iterate(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
