// Faults in following the target: jumps, repeated frames, misses, lag and jitter.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "ik/incident/thresholds.hpp"
#include "ik/math.hpp"
#include "tendril/ik/incident.hpp"

namespace tendril::ik {

// A step is a jump only if the next one is short again or leads back, so each is judged a frame later.
bool IncidentFinder::detect_jump(Steps& steps, glm::vec3 was, glm::vec3 is, IncidentKind kind,
                                 const char* cause) {
    const float min_step = std::max(jump_share * reach_, rounding_steps * options_.resolution);
    const auto far = [&](float length, float reference) {
        return length > min_step && length > jump_factor * reference;
    };
    const bool root = steps.kind == IncidentKind::Misplaced;
    const float step = math::distance(was, is), back = root ? step : math::distance(steps.from, is);
    if (steps.cause != nullptr && far(steps.latest, std::max(std::min(step, back), steps.before))) {
        note({.kind = steps.kind,
              .frame = frames_ - 1,
              .last_frame = frames_ - 1,
              .joint = root ? 0 : no_joint,
              .amount = static_cast<double>(steps.latest),
              .cause = steps.cause});
        root_jumped_ = root_jumped_ || root;  // until the tip meets its target again
    }
    const float before = steps.latest;
    steps = {step, before, was, kind, cause};
    return far(step, before);
}

bool IncidentFinder::find_jumps(const ReachPose& pose) {
    const auto from_root = [](const std::optional<glm::vec3>& point, const ReachPose& of) {
        return *point - of.root();
    };
    const glm::vec3 was = from_root(latest_.target, latest_), is = from_root(pose.target, pose);
    if (!pose.pole || !latest_.pole) {
        pole_steps_ = {};
    } else {
        const glm::vec3 pole_was = from_root(latest_.pole, latest_), pole_is = from_root(pose.pole, pose);
        const auto bend = [&](const ReachPose& of, glm::vec3 line) {
            glm::vec3 sum(0.0f);
            for (std::size_t i = 1; i < end_; ++i) sum += math::cross(line, of.joints[i] - of.root());
            return sum;
        };
        const auto turns = [&](glm::vec3 a, glm::vec3 b) {
            return in_degrees(angle_between(a, b)) > options_.flip_degrees;
        };
        const char* cause = nullptr;
        if (turns(math::cross(was, pole_was), math::cross(is, pole_is)) &&
            math::distance(*pose.pole, *latest_.pole) > math::distance(pose.root(), latest_.root()))
            cause = turns(bend(latest_, was), bend(pose, is))
                        ? "the pole target changes sides from one frame to the next, and the bend of the "
                          "chain with it"
                        : "the pole target changes sides from one frame to the next";
        detect_jump(pole_steps_, pole_was, pole_is, IncidentKind::PoleJump, cause);
    }
    const bool root =
        math::distance(pose.root(), latest_.root()) > math::distance(*pose.target, *latest_.target);
    return detect_jump(
        steps_, was, is, root ? IncidentKind::Misplaced : IncidentKind::TargetJump,
        root ? "the root's position changes abruptly between two frames, and the target's does not"
             : "the target's position changes abruptly between two frames");
}

// Compares the middle one of five frames, or the middle two of six, with the path of the others.
void IncidentFinder::find_misplaced(const ReachPose& pose, bool aimed) {
    samples_.push_back({pose.root(), pose.joints[end_], aimed ? pose.target : std::nullopt});
    if (samples_.size() > max_lag + 1) samples_.erase(samples_.begin());
    const std::size_t n = samples_.size();
    if (n < 5 || frames_ < disturbed_ + 5) return;
    const auto at = [&](std::size_t ago) -> const MotionSample& { return samples_[n - 1 - ago]; };
    const bool all_aimed = std::ranges::all_of(std::span(samples_).last(std::min<std::size_t>(n, 6)),
                                               [](const MotionSample& m) { return m.target.has_value(); });
    const float rounding = rounding_steps * options_.resolution;
    const auto deviation = [](glm::vec3 before, glm::vec3 p, glm::vec3 after) {
        return math::length(p - 0.5f * (before + after));
    };
    const float target_offset = all_aimed ? deviation(*at(3).target, *at(2).target, *at(1).target) : 0.0f;
    ChainIncident found{
        .kind = IncidentKind::Misplaced, .frame = frames_ - 2, .last_frame = frames_ - 2, .joint = end_};
    for (const auto point : {&MotionSample::tip, &MotionSample::root}) {
        const auto p = [&](std::size_t ago) { return at(ago).*point; };
        const float offset = deviation(p(3), p(2), p(1));
        const float steps = std::max(
            {math::distance(p(4), p(3)), math::distance(p(1), p(0)), 0.5f * math::distance(p(3), p(1))});
        if (!(offset > std::max(spike_share * reach_, rounding) &&
              offset > spike_step_ratio * std::max(steps, target_offset)))
            continue;
        found.amount = static_cast<double>(offset);
        found.cause = point == &MotionSample::root ? "the root is displaced for one frame"
                      : 2.0f * deviation(at(3).root, at(2).root, at(1).root) > offset
                          ? "the whole chain is displaced for one frame"
                          : "the tip is displaced for one frame";
        return note(found);
    }
    if (n < 6) return;
    // Second differences, which two frames in swapped order make large.
    const auto bent = [&](bool swapped, auto point) {
        const std::array<std::size_t, 6> order{5, 4, swapped ? 2u : 3u, swapped ? 3u : 2u, 1, 0};
        float sum = 0.0f;
        for (std::size_t i = 1; i < 5; ++i)
            sum += deviation(point(at(order[i - 1])), point(at(order[i])), point(at(order[i + 1])));
        return sum;
    };
    const auto tip = [](const MotionSample& m) { return m.tip; };
    const auto target = [](const MotionSample& m) { return *m.target; };
    const float distance = math::distance(at(5).tip, at(0).tip);
    if (!(distance > 5.0f * std::max(moving_share * reach_, rounding)) ||
        bent(false, tip) < std::max(swap_bend_ratio * bent(true, tip), swap_distance_ratio * distance) ||
        (all_aimed && bent(false, target) >= bent(true, target)))
        return;
    found.frame = frames_ - 3;
    found.amount = static_cast<double>(math::distance(at(3).tip, at(2).tip));
    found.cause = "two frames in swapped order";
    note(found);
}

// Finds frames equal to the previous one. Confirms them once tip and target move on as before.
void IncidentFinder::find_repeated(const ReachPose& pose) {
    if (recent_.size() < 2) return;
    const ReachPose &before = recent_.back(), &earlier = recent_[recent_.size() - 2];
    if (pose.joints == before.joints) {
        if (repeat_.frames == 0 && before.joints == earlier.joints) return;  // unmoved since the first frame
        if (repeat_.frames++ > 0) return;
        repeat_.step = before.joints[end_] - earlier.joints[end_];
        repeat_.earlier_step = 0.0f;
        if (recent_.size() > 2)
            repeat_.earlier_step =
                math::distance(earlier.joints[end_], recent_[recent_.size() - 3].joints[end_]);
        repeat_.moved = both_moved(earlier, before);
        repeat_.target = *before.target;
        return;
    }
    if (repeat_.frames > 0)
        add_repeat({{.kind = IncidentKind::Repeated,
                     .frame = frames_ - repeat_.frames,
                     .last_frame = frames_ - 1,
                     .amount = static_cast<double>(repeat_.frames),
                     .cause = "all joints repeat the frame before, in the middle of a motion"},
                    repeat_.moved && both_moved(before, pose) && resumes(pose),
                    repeat_.target == *latest_.target});
    repeat_ = {};
}

void IncidentFinder::add_repeat(const Repeat& hold) {
    if (cadence_.size() > 1) {
        const std::uint64_t spacing = cadence_[1].incident.frame - cadence_[0].incident.frame,
                            apart = hold.incident.frame - cadence_.back().incident.frame;
        if (apart + 1 < spacing || apart > spacing + 1 || cadence_.size() == max_incidents) close_cadence();
    }
    cadence_.push_back(hold);
}

// Reports repeats one by one if they are too few for a cadence; the last may start the next cadence.
void IncidentFinder::close_cadence() {
    const std::size_t count = cadence_.size();
    const auto faults = std::ranges::count(cadence_, true, &Repeat::fault),
               rests = std::ranges::count(cadence_, true, &Repeat::rested);
    const auto is_majority = [&](std::ptrdiff_t some) { return 2 * static_cast<std::size_t>(some) > count; };
    if (count < min_cadence || (!is_majority(rests) && !is_majority(faults))) {
        const Repeat latest = count > 0 ? cadence_.back() : Repeat{};
        for (std::size_t i = 0; i + 1 < count; ++i)
            if (cadence_[i].fault) note(cadence_[i].incident);
        cadence_.assign(count > 0 ? 1 : 0, latest);
        return;
    }
    ChainIncident all = cadence_.front().incident;
    const ChainIncident latest = cadence_.back().incident;
    double held = 0.0;
    for (const Repeat& each : cadence_) held += each.incident.amount;
    const double span = static_cast<double>(latest.frame - all.frame),
                 new_frames = span - (held - latest.amount);
    const auto steps = static_cast<double>(count - 1);
    cadence_.clear();
    if (is_majority(rests)) return;
    all.last_frame = latest.last_frame;
    all.amount = held;
    all.hertz = static_cast<double>(options_.fps) * new_frames / span;
    all.cause =
        new_frames != steps   ? "the chain is updated at another rate than the log"
        : span == 2.0 * steps ? "every second frame is new: the chain is updated at half the log's rate"
        : span == 3.0 * steps ? "every third frame is new: the chain is updated at a third of the log's rate"
                              : "the chain is updated at a lower rate than the log";
    note(all);
}

bool IncidentFinder::both_moved(const ReachPose& a, const ReachPose& b) const noexcept {
    const float moving = std::max(moving_share * reach_, rounding_steps * options_.resolution);
    return math::distance(a.joints[end_], b.joints[end_]) > moving &&
           math::distance(*a.target, *b.target) > moving;
}

// One repeated frame is a fault. Several may be a rest, before which the chain slows down or after which it
// moves in another direction or at another speed; but not if its target moved on.
bool IncidentFinder::resumes(const ReachPose& pose) const {
    const ReachPose& before = recent_.back();
    if (repeat_.frames == 1 || math::distance(repeat_.target, *latest_.target) > moving_share * reach_)
        return true;
    const glm::vec3 step = pose.joints[end_] - before.joints[end_];
    const float was = math::length(repeat_.step), is = math::length(step);
    const float longest = max_resumed_step * static_cast<float>(repeat_.frames + 1) * was;
    return was > min_resumed_step * repeat_.earlier_step && is > min_resumed_step * was && is < longest &&
           math::dot(repeat_.step, step) > min_resumed_cosine * was * is;
}

void IncidentFinder::find_missed(const ReachPose& pose) {
    const float distance = math::distance(*pose.target, pose.root());
    const float inner = inner_reach();
    const float allowed = std::max(missed_share * reach_, rounding_steps * options_.resolution);
    const glm::vec3 tip = pose.joints[end_] - pose.root();
    // Late targets: relative to the root of that frame, or in space with the root of this one.
    std::array<float, max_lag + 1> errors;
    errors.fill(std::numeric_limits<float>::infinity());
    for (std::size_t lag = 0; lag < samples_.size(); ++lag) {
        const MotionSample& then = samples_[samples_.size() - 1 - lag];
        if (!then.target) continue;
        errors[lag] = std::min(math::distance(tip, *then.target - then.root),
                               math::distance(tip, within_reach(*then.target - pose.root())));
    }
    if (errors[0] <= allowed) root_jumped_ = false;
    find_late(errors, allowed);
    const float error = std::ranges::min(errors);
    // A bone of another length also moves the tip, and has been reported already.
    const bool whole_bones = std::ranges::none_of(length_, &Episode::open);
    const bool reachable = distance < reach_ - allowed && distance > inner + allowed && whole_bones;
    const bool approaching = missed_frames_ > 0 && error < approach_ratio * missed_before_;
    if (!reachable || error <= allowed || approaching) {
        update_episode(missed_, false, {});
        missed_frames_ = reachable && error > allowed ? 1 : 0;
    } else {
        ++missed_frames_;
    }
    missed_before_ = error;
    const bool whole = missed_frames_ == frames_ + 1;  // from the first frame on
    if (missed_frames_ < min_missed_frames && !whole) return;
    if (root_jumped_) return;  // already reported
    ChainIncident now{.kind = IncidentKind::Missed,
                      .frame = frames_ + 1 - missed_frames_,
                      .last_frame = frames_,
                      .joint = end_,
                      .amount = static_cast<double>(error),
                      .cause = "the target is within reach: look for a limit, or too few iterations"};
    for (const Episode& each : limit_)
        if (each.open) now.cause = "a joint is at its limit";
    update_episode(missed_, true, now);
}

// The tip is late for a while: it misses its target and meets an earlier one.
void IncidentFinder::find_late(const std::array<float, max_lag + 1>& errors, float allowed) {
    const auto best = [&] { return std::ranges::min_element(late_.squares) - late_.squares.begin(); };
    if (late_.frames > 0 && !(errors[static_cast<std::size_t>(best())] <= allowed)) close_late();
    for (std::size_t lag = 1; lag <= max_lag; ++lag)
        prompt_[lag] += errors[0] <= 0.5f * allowed && errors[lag] > 1.5f * allowed;
    if (errors[0] <= allowed || (late_.frames == 0 && std::ranges::min(errors) > 0.5f * allowed)) return;
    if (late_.frames++ == 0) late_.first = frames_;
    late_.last = frames_;
    for (std::size_t lag = 0; lag <= max_lag; ++lag)
        late_.squares[lag] += static_cast<double>(errors[lag] * errors[lag]);
}

void IncidentFinder::close_late() {
    const auto least = std::ranges::min_element(late_.squares);
    if (late_.frames >= min_lag_frames && *least <= late_ratio * late_.squares[0]) {
        if (lates_.size() < max_incidents)
            lates_.push_back(
                lag_of(static_cast<std::size_t>(least - late_.squares.begin()), late_.first, late_.last));
        else
            ++dropped_;
    }
    late_ = {};
}

ChainIncident IncidentFinder::lag_of(std::size_t lag, std::uint64_t first, std::uint64_t last) const {
    return {.kind = IncidentKind::Lag,
            .frame = first,
            .last_frame = last,
            .joint = end_,
            .amount = static_cast<double>(lag),
            .cause = lag == 1 ? "the tip is where the target was one frame before: the order of updates"
                              : "the tip is where the target was some frames before: smoothing, or a queue"};
}

// Adds a frame to the paths of tip and target. A target out of reach becomes the nearest point in reach.
void IncidentFinder::follow(const ReachPose& pose) {
    const glm::vec3 target = *pose.target - pose.root();
    const float moving = std::max(moving_share * reach_, options_.resolution);
    const auto moved = [&](glm::vec3 a, glm::vec3 b) { return math::distance(a, b) > moving; };
    if (!first_move_ && !targets_.empty() && moved(target, targets_.back())) first_move_ = frames_;
    // If only the tip jumped, start the paths again.
    const glm::vec3 tip_now = pose.joints[end_] - pose.root();
    if (!followers_.empty()) {
        float longest = math::distance(target, targets_.back());
        for (std::size_t i = 1; i < targets_.size(); ++i)
            longest = std::max(longest, math::distance(targets_[i - 1], targets_[i]));
        if (math::distance(tip_now, followers_.back()) > spike_step_ratio * longest + spike_share * reach_) {
            targets_.clear();
            followers_.clear();
            for (Following& path : paths_) path.close();
        }
    }
    targets_.push_back(target);
    followers_.push_back(tip_now);
    if (targets_.size() > max_lag + spans.back() + 1) {
        targets_.erase(targets_.begin());
        followers_.erase(followers_.begin());
    }
    const auto aim = [&](std::size_t ago) {
        return glm::dvec3(within_reach(targets_[targets_.size() - 1 - ago]));
    };
    if (targets_.size() <= max_lag ||
        std::adjacent_find(targets_.end() - (max_lag + 1), targets_.end(), moved) == targets_.end())
        return;
    const glm::dvec3 tip(followers_.back());
    if (paths_[0].frames == 0) origin_ = tip;
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const std::size_t span = spans[i];
        if (targets_.size() <= max_lag + span) continue;
        const glm::dvec3 from = span == 0 ? origin_ : glm::dvec3(followers_[followers_.size() - 1 - span]);
        Following& path = paths_[i];
        const glm::dvec3 way = tip - from;
        ++path.frames;
        path.count += 1.0;
        path.sum += way;
        path.square += math::dot(way, way);
        for (std::size_t lag = 0; lag <= max_lag; ++lag) {
            const glm::dvec3 step = aim(lag) - (span == 0 ? origin_ : aim(lag + span));
            path.lags[lag].sum += step;
            path.lags[lag].square += math::dot(step, step);
            path.lags[lag].product += math::dot(way, step);
        }
    }
}

glm::vec3 IncidentFinder::within_reach(glm::vec3 target) const noexcept {
    const float away = math::length(target);
    return away > 0.0f ? target * (std::clamp(away, inner_reach(), reach_) / away) : target;
}

float IncidentFinder::inner_reach() const noexcept {
    return std::max(0.0f, 2.0f * std::ranges::max(std::span(lengths_).first(end_)) - reach_);
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
    tips_.push_back(pose.joints[end_] - pose.root());
    if (tips_.size() == fast_jitter_frames || tips_.size() == still_window) judge_jitter();
}

// Jitter: an undamped oscillation about the mean, along the axis of largest variance.
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
    const double min_amplitude = std::max(static_cast<double>(jitter_share * reach_),
                                          static_cast<double>(rounding_steps * options_.resolution));
    if (crossings < min_jitter_crossings || amplitude < min_amplitude || late < 0.5 * early) return;
    jitter_judged_ = true;
    note({.kind = IncidentKind::Jitter,
          .frame = still_since_,
          .last_frame = frames_,
          .joint = end_,
          .amount = amplitude,
          .hertz = 0.5 * static_cast<double>(crossings) * static_cast<double>(options_.fps) / (count - 1.0),
          .cause = "the target is still, but the tip moves"});
}

void IncidentFinder::Following::close() noexcept {
    const std::array<double, max_lag + 1> squares = left();
    *this = {.before = squares, .frames = frames};
}

std::array<double, IncidentFinder::max_lag + 1> IncidentFinder::Following::left() const noexcept {
    std::array<double, max_lag + 1> squares = before;
    if (count == 0.0) return squares;
    const double tips = square - math::dot(sum, sum) / count;
    for (std::size_t lag = 0; lag <= max_lag; ++lag) {
        const Lagged& with = lags[lag];
        const double targets = with.square - math::dot(with.sum, with.sum) / count,
                     both = with.product - math::dot(with.sum, sum) / count;
        const double scale = targets > 0.0 ? std::clamp(both / targets, lag_scale, 1.0 / lag_scale) : 1.0;
        squares[lag] += std::max(0.0, tips - 2.0 * scale * both + scale * scale * targets);
    }
    return squares;
}

// The lag, in frames, at which the target's path best fits the tip's, up to an offset and a scale: a tip that
// misses its target may still lag. A changing miss spoils the fit of positions more than of steps; noise
// spoils the fit of short steps.
std::size_t IncidentFinder::find_lag() const {
    const double least_rms = std::max(lag_share * static_cast<double>(reach_),
                                      static_cast<double>(rounding_steps * options_.resolution));
    std::size_t best = 0;
    double best_ratio = max_lag_ratio;
    std::array<std::array<double, max_lag + 1>, spans.size()> left{};
    std::ranges::transform(paths_, left.begin(), &Following::left);
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const auto frames = static_cast<double>(paths_[i].frames);
        const double least = std::ranges::min(left[i]), same = frames * 0.01 * least_rms * least_rms;
        // The first of equal fits, because a circling target comes back later.
        const auto lag = static_cast<std::size_t>(
            std::ranges::find_if(left[i], [&](double each) { return each <= least + same; }) -
            left[i].begin());
        const double gained = std::sqrt((left[i][0] - left[i][lag]) / frames);
        const bool fits = frames >= min_lag_frames && lag > 0 && left[i][lag] < best_ratio * left[i][0] &&
                          gained > least_rms;
        if (!fits || std::ranges::any_of(
                         left, [&](const auto& other) { return other[lag] > max_other_ratio * other[0]; }))
            continue;
        best = lag;
        best_ratio = left[i][lag] / left[i][0];
    }
    return best;
}

void IncidentFinder::finish_following() {
    update_episode(missed_, false, {});
    judge_jitter();
    // Frames repeated to the end while the target moves on within reach.
    const bool limited = std::ranges::any_of(limit_, &Episode::open);
    const double usual = cadence_.size() >= min_cadence ? cadence_.back().incident.amount + 1.0 : 1.0;
    if (static_cast<double>(repeat_.frames) > usual && repeat_.moved && !limited && !recent_.empty()) {
        const glm::vec3 target = *latest_.target;
        const std::uint64_t first = frames_ - repeat_.frames;
        if (math::distance(repeat_.target, target) > moving_share * reach_ &&
            math::distance(target, recent_.back().root()) < reach_) {
            std::erase_if(found_, [&](const ChainIncident& each) {
                return each.kind == IncidentKind::Missed && each.frame >= first;
            });
            note({.kind = IncidentKind::Repeated,
                  .frame = first,
                  .last_frame = frames_ - 1,
                  .amount = static_cast<double>(repeat_.frames),
                  .cause = "all joints stop until the end, while the target moves on"});
        }
    }
    const std::size_t best = find_lag();
    close_late();
    // A tip that never meets its target is off, not late.
    std::erase_if(lates_, [&](const ChainIncident& each) {
        return prompt_[static_cast<std::size_t>(each.amount)] < min_lag_frames;
    });
    if (!lates_.empty() && (best == 0 || 8 * prompt_[best] > paths_[0].frames)) {
        for (const ChainIncident& each : lates_) note(each);
        return;
    }
    // A lower update rate explains a lag shorter than its period.
    const bool explained =
        cadence_.size() >= min_cadence && cadence_[0].incident.frame + best < cadence_[1].incident.frame;
    if (best == 0 || explained) return;
    // The target's position before the first frame is unknown.
    std::erase_if(found_, [&](const ChainIncident& each) {
        return each.kind == IncidentKind::Missed && each.frame == 0 &&
               each.last_frame <= first_move_.value_or(0) + best;
    });
    note(lag_of(best, first_move_.value_or(0), frames_ > 0 ? frames_ - 1 : 0));
}

}  // namespace tendril::ik
