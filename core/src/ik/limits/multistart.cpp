#include "ik/limits/multistart.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "ik/limits/fabrik.hpp"
#include "ik/limits/least_squares.hpp"
#include "ik/limits/pose.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::limits;

/// SplitMix64 (Steele, Lea, Flood 2014), from 0 to under 1.
float random_unit(std::uint64_t& state) noexcept {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return static_cast<float>(z >> 40) * (1.0f / 16777216.0f);
}

float between(float a, float b, float part) noexcept {
    return a + (b - a) * part;
}

JointAngles sampled_angles(const LimitedJoint& joint, std::uint64_t& state) noexcept {
    const float a = random_unit(state), b = random_unit(state), c = random_unit(state);
    if (joint.hinge()) return {between(joint.min, joint.max, a), 0.0f, 0.0f};
    if (joint.free()) return {between(-2.0f, 2.0f, a), between(-2.0f, 2.0f, b), between(-2.0f, 2.0f, c)};
    return within(joint, {between(-joint.down, joint.up, a), between(-joint.right, joint.left, b),
                          between(joint.twist_min, joint.twist_max, c)});
}

}  // namespace

void sample(const Problem& problem, int number) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    std::uint64_t state = static_cast<std::uint64_t>(number) * 7919u;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        scratch.trial.local[i] = rotation_of(scratch.limits[i], sampled_angles(scratch.limits[i], state));
    }
    forward_kinematics(problem, scratch.trial);
}

LimitedDescent::LimitedDescent(const Problem& problem, float allowance) noexcept
    : error_(error_of(problem, problem.scratch.limited.pose)),
      allowance_(allowance),
      convergence_(step_stall, error_, problem.scratch.reach) {}

void LimitedDescent::restart(const Problem& problem) noexcept {
    *this = LimitedDescent(problem, std::numeric_limits<float>::infinity());
}

void LimitedDescent::continue_from(float damping, bool stalled) noexcept {
    damping_ = damping;
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
    reaches_ = reached < reaching_pays * error_;
    if (reached < error_ && may_take(problem)) {
        scratch.swap_pose(scratch.trial);
        error_ = reached;
    } else {
        reaches_ = false;
        report_moves(problem, scratch.trial, scratch.pose, Phase::RestoreBest, watch);
    }
    convergence_.restart(error_);
}

/// A damped step, taken where it brings the tip nearer, or else one with more damping.
template <class Watch>
void LimitedDescent::step(Problem& problem, Watch watch) noexcept {
    const Wanted wanted = wanted_of(problem);
    Normal normal = linearize(problem, wanted);
    for (int attempt = 0; attempt < 2; ++attempt) {
        const Wanted by = projected_step(problem, Descent::Damped, damping_, wanted, normal);
        if (predicted_gain(normal, wanted, by) < min_gain) return convergence_.end();
        rotate_joints(problem, by);
        const float then = error_of(problem, problem.scratch.limited.trial);
        if (then < error_ && may_take(problem)) {
            accept_trial(problem, Phase::Gradient, watch);
            error_ = then;
            damping_ = std::max(damping_falls * damping_, min_damping);
            ++problem.least_squares_steps;
            return;
        }
        damping_ = std::min(damping_grows * damping_, max_damping);
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
