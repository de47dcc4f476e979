// How well the tip follows the target: jumps, repeated frames, misses, lag and jitter.
#include <algorithm>
#include <array>
#include <cmath>

#include "ik/incident/thresholds.hpp"
#include "ik/math.hpp"
#include "tendril/ik/incident.hpp"

namespace tendril::ik {

// A step is only a jump if the next one is short again, so it is judged with that one.
bool IncidentFinder::find_jump(const ReachPose& pose) {
    if (recent_.empty()) {
        steps_ = 0;
        return false;
    }
    const ReachPose& before = recent_.back();
    const float step = math::distance(*before.target - before.root(), *pose.target - pose.root());
    const float long_step = std::max(jump_share * reach_, rounding_steps * options_.resolution);
    if (steps_ > 0 && step_ > long_step && step_ > jump_factor * std::max(step, step_before_))
        note({.kind = IncidentKind::TargetJump,
              .frame = frames_ - 1,
              .last_frame = frames_ - 1,
              .amount = static_cast<double>(step_),
              .cause = "the target is somewhere else from one frame to the next"});
    step_before_ = steps_ > 0 ? step_ : 0.0f;
    step_ = step;
    ++steps_;
    return step > long_step && step > jump_factor * step_before_;
}

// The frame before this one, if it equals the one before it while chain and target move on either side.
void IncidentFinder::find_repeated(const ReachPose& pose) {
    if (recent_.size() < 3) return;
    const ReachPose &first = recent_[recent_.size() - 3], &second = recent_[recent_.size() - 2],
                    &repeated = recent_.back();
    if (repeated.joints != second.joints) return;
    const float moving = std::max(moving_share * reach_, rounding_steps * options_.resolution);
    const auto moved = [&](const ReachPose& a, const ReachPose& b) {
        return math::distance(a.joints.back(), b.joints.back()) > moving &&
               math::distance(*a.target, *b.target) > moving;
    };
    if (moved(first, second) && moved(repeated, pose))
        note({.kind = IncidentKind::Repeated,
              .frame = frames_ - 1,
              .last_frame = frames_ - 1,
              .amount = 1.0,
              .cause = "all joints are where they were a frame before, in the middle of a motion"});
}

void IncidentFinder::find_missed(const ReachPose& pose) {
    const float distance = math::distance(*pose.target, pose.root());
    const float longest = lengths_.empty() ? 0.0f : *std::ranges::max_element(lengths_);
    const float inner = std::max(0.0f, 2.0f * longest - reach_);
    const float allowed = std::max(missed_share * reach_, rounding_steps * options_.resolution);
    const glm::vec3 tip = pose.joints.back() - pose.root();
    float error = math::distance(tip, *pose.target - pose.root());
    for (const glm::vec3 target : targets_) error = std::min(error, math::distance(tip, target));
    // A bone of another length moves the tip as well; that is reported.
    const bool whole_bones = std::ranges::none_of(length_, &Episode::open);
    const bool reachable = distance < reach_ - allowed && distance > inner + allowed && whole_bones;
    const bool under_way = missed_frames_ > 0 && error < approach * missed_before_;
    if (!reachable || error <= allowed || under_way) {
        last(missed_, false, {});
        missed_frames_ = reachable && error > allowed ? 1 : 0;
    } else {
        ++missed_frames_;
    }
    missed_before_ = error;
    const bool whole = missed_frames_ == frames_ + 1;  // from the first frame on
    if (missed_frames_ < missed_run && !whole) return;
    ChainIncident now{.kind = IncidentKind::Missed,
                      .frame = frames_ + 1 - missed_frames_,
                      .last_frame = frames_,
                      .joint = pose.joints.size() - 1,
                      .amount = static_cast<double>(error),
                      .cause = "the target is within reach: look for a limit, or too few iterations"};
    for (const Episode& each : limit_)
        if (each.open) now.cause = "a joint is at its limit";
    last(missed_, true, now);
}

void IncidentFinder::follow(const ReachPose& pose) {
    const glm::vec3 target = *pose.target - pose.root(), tip = pose.joints.back() - pose.root();
    const bool full = targets_.size() == max_lag;
    const bool within =
        std::ranges::all_of(targets_, [&](glm::vec3 each) { return math::length(each) < reach_; });
    const float moving = std::max(moving_share * reach_, options_.resolution);
    const bool moves = !targets_.empty() && math::distance(target, targets_.back()) > moving;
    if (moves && !first_move_) first_move_ = frames_;
    if (full && within && math::length(target) < reach_ && moves) {
        for (std::size_t lag = 0; lag <= max_lag; ++lag) {
            const glm::vec3 off = tip - (lag == 0 ? target : targets_[max_lag - lag]);
            squares_[lag] += static_cast<double>(math::dot(off, off));
        }
        ++followed_;
    }
    targets_.push_back(target);
    if (targets_.size() > max_lag) targets_.erase(targets_.begin());
}

void IncidentFinder::find_jitter(const ReachPose& pose) {
    const bool still =
        targets_.size() >= 2 && math::distance(targets_[targets_.size() - 2], targets_.back()) <=
                                    std::max(0.1f * jitter_share * reach_, 2.0f * options_.resolution);
    if (!still) {
        judge_jitter();
        tips_.clear();
        still_since_ = frames_ + 1;
        jitter_judged_ = false;
        return;
    }
    if (jitter_judged_) return;
    tips_.push_back(pose.joints.back() - pose.root());
    if (tips_.size() == fast_jitter || tips_.size() == still_window) judge_jitter();
}

// A swing to and fro about the mean, along the axis where it is widest, that does not die away.
void IncidentFinder::judge_jitter() {
    if (jitter_judged_ || tips_.size() < 6) return;
    const std::size_t skipped = std::min<std::size_t>(4, tips_.size() / 4);  // the tip may still arrive
    glm::dvec3 mean(0.0);
    const auto count = static_cast<double>(tips_.size() - skipped);
    for (std::size_t i = skipped; i < tips_.size(); ++i) mean += glm::dvec3(tips_[i]) / count;
    glm::dvec3 variance(0.0);
    for (std::size_t i = skipped; i < tips_.size(); ++i) {
        const glm::dvec3 off = glm::dvec3(tips_[i]) - mean;
        variance += off * off;
    }
    const int axis = variance.x >= variance.y && variance.x >= variance.z ? 0
                     : variance.y >= variance.z                           ? 1
                                                                          : 2;
    double low = 0.0, high = 0.0, early = 0.0, late = 0.0;
    std::size_t crossings = 0;
    double before = 0.0;
    for (std::size_t i = skipped; i < tips_.size(); ++i) {
        const double off = glm::dvec3(tips_[i])[axis] - mean[axis];
        low = std::min(low, off);
        high = std::max(high, off);
        double& half = 2 * (i - skipped) < tips_.size() - skipped ? early : late;
        half = std::max(half, std::abs(off));
        if (i > skipped && off * before < 0.0) ++crossings;
        if (off != 0.0) before = off;
    }
    const double amplitude = 0.5 * (high - low);
    const double least = std::max(static_cast<double>(jitter_share * reach_),
                                  static_cast<double>(rounding_steps * options_.resolution));
    if (crossings < jitter_crossings || amplitude < least || late < 0.5 * early) return;
    jitter_judged_ = true;
    note({.kind = IncidentKind::Jitter,
          .frame = still_since_,
          .last_frame = frames_,
          .joint = recent_.empty() ? no_joint : recent_.back().joints.size() - 1,
          .amount = amplitude,
          .hertz = 0.5 * static_cast<double>(crossings) * static_cast<double>(options_.fps) / (count - 1.0),
          .cause = "the target is still, and the tip is not"});
}

void IncidentFinder::finish_following() {
    last(missed_, false, {});
    judge_jitter();
    if (followed_ < lag_frames) return;
    const auto best = static_cast<std::size_t>(std::ranges::min_element(squares_) - squares_.begin());
    const double rms = std::sqrt(squares_[0] / static_cast<double>(followed_));
    const double least =
        static_cast<double>(std::max(lag_share * reach_, rounding_steps * options_.resolution));
    if (best == 0 || rms < least || squares_[best] > lag_better * squares_[0]) return;
    note({.kind = IncidentKind::Lag,
          .frame = first_move_.value_or(0),
          .last_frame = frames_ > 0 ? frames_ - 1 : 0,
          .joint = lengths_.size(),
          .amount = static_cast<double>(best),
          .cause = best == 1 ? "the tip is where the target was one frame before: the order of updates"
                             : "the tip is where the target was some frames before: smoothing, or a queue"});
}

}  // namespace tendril::ik
