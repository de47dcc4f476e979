#include "ik/limits/multistart.hpp"

#include <cstdint>

#include "ik/limits/fabrik.hpp"
#include "ik/limits/step.hpp"

namespace tendril::ik::detail {
namespace {

constexpr int slow_iterations = 3;
constexpr float slow = 0.02f;        ///< progress by less than this part of what is left is little
constexpr float crawling = 0.002f;   ///< the same while the nearest pose is polished
constexpr int last_iterations = 15;  ///< in which it is
constexpr int near_tries = 3;        ///< of these, how many lie near the best so far
constexpr int drawn = 4;             ///< poses from which the nearest is taken
constexpr float clearly = 0.02f;     ///< of the reach

/// SplitMix64 (Steele, Lea, Flood 2014), from 0 to under 1.
float chance(std::uint64_t& state) noexcept {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return static_cast<float>(z >> 40) * (1.0f / 16777216.0f);
}

float between(float a, float b, float part) noexcept {
    return a + (b - a) * part;
}

JointAngles drawn_angles(const LimitedJoint& joint, std::uint64_t& state) noexcept {
    const float a = chance(state), b = chance(state), c = chance(state);
    if (joint.hinge()) return {between(joint.min, joint.max, a), 0.0f, 0.0f};
    if (joint.free()) return {between(-2.0f, 2.0f, a), between(-2.0f, 2.0f, b), between(-2.0f, 2.0f, c)};
    return within(joint, {between(-joint.down, joint.up, a), between(-joint.right, joint.left, b),
                          between(joint.twist_min, joint.twist_max, c)});
}

/// Part of the way from how a joint stands to other angles.
JointAngles towards(const LimitedJoint& joint, const glm::quat& turn, const JointAngles& other,
                    float part) noexcept {
    const JointAngles now = angles_of(joint, turn);
    return within(joint, {between(now.up, other.up, part), between(now.left, other.left, part),
                          between(now.twist, other.twist, part)});
}

/// Some pose within the limits, into `trial`; `part` of the way from the best one so far.
void sample(const Problem& problem, std::uint64_t& state, float part) noexcept {
    LimitedRoom& room = problem.room.limited;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const LimitedJoint& joint = room.limits[i];
        JointAngles angles = drawn_angles(joint, state);
        if (part < 1.0f) angles = towards(joint, room.best.turns[i], angles, part);
        room.trial.turns[i] = turn_of(joint, angles);
    }
    extend(problem, room.trial);
}

}  // namespace

bool LimitedSearch::stalls() const noexcept {
    return slow_ >= slow_iterations;
}

bool LimitedSearch::exhausted() const noexcept {
    return polishes_ && stalls();
}

bool LimitedSearch::takes(float error, float nearest, bool arrived) const noexcept {
    return error < nearest && (tries_ == 0 || arrived || error < home_);
}

void LimitedSearch::draw_start(Problem& problem) noexcept {
    LimitedRoom& room = problem.room.limited;
    if (tries_ == 0) home_ = error_of(problem, room.best) - clearly * problem.room.reach;
    ++tries_;
    ++problem.restarts;
    std::uint64_t state = static_cast<std::uint64_t>(tries_) * 7919u;
    const float part = tries_ <= near_tries ? 0.25f * static_cast<float>(tries_) : 1.0f;
    float best = 0.0f;
    for (int i = 0; i < drawn; ++i) {
        sample(problem, state, part);
        const float error = error_of(problem, room.trial);
        if (i > 0 && error >= best) continue;
        best = error;
        std::swap(room.trial, room.spare);
    }
    std::swap(room.trial, room.spare);
}

template <class Watch>
void LimitedSearch::start_from_trial(Problem& problem, Phase phase, Watch watch) noexcept {
    take_trial(problem, phase, watch);
    damping_ = first_damping;
    slow_ = 0;
    reaches_ = true;
    last_ = error_of(problem, problem.room.limited.pose);
}

template <class Watch>
void LimitedSearch::iterate(Problem& problem, Watch watch) noexcept {
    LimitedRoom& room = problem.room.limited;
    const bool ends = problem.iteration + last_iterations > problem.options.max_iterations;
    if (!polishes_ && stalled() && (ends || (stalls() && tries_ >= problem.options.restarts))) {
        polishes_ = true;
        room.trial = room.best;
        start_from_trial(problem, Phase::Keep, watch);
    } else if (!polishes_ && stalls()) {
        draw_start(problem);
        start_from_trial(problem, Phase::Prepare, watch);
    }
    const float start = last_;
    float error = start;
    if (reaches_) {
        limited_reaching(problem, watch);
        const float reached = error_of(problem, room.trial);
        reaches_ = reached < 0.5f * start;
        if (reached < start) {
            std::swap(room.pose, room.trial);
            last_ = reached;
        } else {
            report_moves(problem, room.trial, room.pose, Phase::Keep, watch);
        }
        return;
    }
    if (descend(problem, damping_, error, watch)) ++problem.least_squares_steps;
    // Far away from a target that cannot be reached, only so much is left as may still be gained.
    const float left = std::min(last_, 0.1f * problem.room.reach);
    slow_ = last_ - error < (polishes_ ? crawling : slow) * left ? slow_ + 1 : 0;
    last_ = error;
}

template void LimitedSearch::iterate(Problem&, Unwatched) noexcept;
template void LimitedSearch::iterate(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
