// Finds incidents frame by frame: values that are not finite, wrong lengths, exceeded limits, flips.
#include "tendril/ik/incident.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ik/incident/thresholds.hpp"
#include "ik/math.hpp"
#include "tendril/elementary.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::ik {
namespace {

bool finite(glm::vec3 p) noexcept {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// `v` turned by the smallest rotation that takes direction `from` to direction `to`, both of length 1.
glm::vec3 transported(glm::vec3 v, glm::vec3 from, glm::vec3 to) noexcept {
    const glm::vec3 axis = math::cross(from, to);
    const float cosine = math::dot(from, to);
    if (cosine <= -0.9999f) return v;
    return v + math::cross(axis, v) + math::cross(axis, math::cross(axis, v)) / (1.0f + cosine);
}

/// Merges bones that change by one factor over the same frames into one incident. `found`: sorted by frame.
void merge_scaled(std::vector<ChainIncident>& found, const std::vector<float>& lengths) {
    constexpr double equal = 0.02;  // relative to the factor
    for (std::size_t i = 0; i < found.size(); ++i) {
        const ChainIncident first = found[i];
        const auto share = [&](const ChainIncident& each) {
            return 1.0 + each.amount / static_cast<double>(lengths[each.joint - 1]);
        };
        const auto matches = [&](const ChainIncident& each) {
            return each.kind == IncidentKind::Length && each.joint != no_joint && each.frame == first.frame &&
                   each.last_frame == first.last_frame &&
                   std::abs(share(each) - share(first)) <= equal * std::max(share(first), equal);
        };
        if (first.kind != IncidentKind::Length || lengths.size() < 2) continue;
        std::size_t bones = 0;
        double amount = 0.0;
        for (std::size_t j = i; j < found.size() && found[j].frame == first.frame; ++j)
            if (matches(found[j])) ++bones, amount += found[j].amount;
        if (bones != lengths.size()) continue;
        const bool point = share(first) < equal * equal;
        std::erase_if(found, [&](const ChainIncident& each) { return &each > &found[i] && matches(each); });
        found[i].joint = no_joint;
        found[i].amount = amount;
        found[i].cause = point ? "all joints are at one point: a frame that was never written"
                               : "all bones by one factor: a scale or a unit changed";
    }
}

}  // namespace

const char* name(IncidentKind kind) noexcept {
    static constexpr std::array names{"flip",   "nan",      "length",      "limit",     "missed",   "lag",
                                      "jitter", "repeated", "target_jump", "pole_jump", "misplaced"};
    return names[static_cast<std::size_t>(kind)];
}

const char* unit(IncidentKind kind) noexcept {
    switch (kind) {
        case IncidentKind::Flip:
        case IncidentKind::Limit:
            return "degrees";
        case IncidentKind::Lag:
        case IncidentKind::Repeated:
            return "frames";
        case IncidentKind::Nan:
            return "";
        default:
            return "metres";
    }
}

IncidentFinder::IncidentFinder(IncidentOptions options) : options_(std::move(options)) {}

void IncidentFinder::note(const ChainIncident& incident) {
    if (found_.size() < max_incidents)
        found_.push_back(incident);
    else
        ++dropped_;
}

void IncidentFinder::update_episode(Episode& episode, bool active, const ChainIncident& now) {
    if (!active) {
        if (episode.open) note(episode.worst);
        episode.open = false;
        return;
    }
    if (!episode.open) {
        episode = {true, now};
        episode.worst.frame = now.frame;
    }
    const std::uint64_t first = episode.worst.frame;
    if (std::abs(now.amount) > std::abs(episode.worst.amount)) episode.worst = now;
    episode.worst.frame = first;
    episode.worst.last_frame = frames_;
}

void IncidentFinder::add(const TraceFrame& frame) {
    if (find_nan(frame)) {
        forget_motion();
        ++frames_;
        return;
    }
    options_.resolution = std::max(options_.resolution, frame.resolution);
    const std::size_t tip = frame.joints.size() - 1;
    end_ = std::clamp<std::size_t>(options_.end_effector.value_or(tip), 1, tip);
    ReachPose pose{.joints = {frame.joints.begin(), frame.joints.end()},
                   .target = frame.target.value_or(frame.joints[end_]),
                   .pole = frame.pole};
    if (lengths_.empty()) {
        for (std::size_t i = 1; i < pose.joints.size(); ++i)
            lengths_.push_back(math::distance(pose.joints[i - 1], pose.joints[i]));
        for (std::size_t i = 0; i < end_; ++i) reach_ += lengths_[i];
        length_.resize(lengths_.size());
        limit_.resize(options_.limits.size());
    }
    const bool aimed = frame.target.has_value();
    if (!aimed || recent_.empty()) steps_ = pole_steps_ = {};
    find_lengths(pose, aimed);
    find_limits(pose);
    const bool jumped = aimed && !recent_.empty() && find_jumps(pose);
    const bool held = !recent_.empty() && pose.joints == recent_.back().joints;
    if (!held) find_flips(pose, jumped, aimed);
    find_rolls(pose, frame.rotations);
    find_repeated(pose);
    find_misplaced(pose, aimed);
    if (aimed) {
        find_missed(pose);
        follow(pose);
        find_jitter(pose);
    }
    latest_ = pose;
    if (held) {
        pose.target = recent_.back().target;
        pose.pole = recent_.back().pole;
    }
    recent_.push_back(std::move(pose));
    if (recent_.size() > swing_frames + 1) recent_.erase(recent_.begin());
    ++frames_;
}

void IncidentFinder::forget_motion() noexcept {
    recent_.clear();
    rotations_.clear();
    targets_.clear();
    followers_.clear();
    tips_.clear();
    side_.reset();
    steps_ = pole_steps_ = {};
    samples_.clear();
    repeat_ = {};
    missed_frames_ = 0;
}

ReachPose IncidentFinder::reaching(const ReachPose& pose) const {
    ReachPose part = pose;
    part.joints.resize(end_ + 1);
    return part;
}

const char* IncidentFinder::nan_cause(const TraceFrame& frame) const noexcept {
    if (frame.target && !finite(*frame.target)) return "the target is not finite";
    if (frame.pole && !finite(*frame.pole)) return "the pole target is not finite";
    if (frame.dt && !(*frame.dt > 0.0f)) return "dt is not positive: look for a division by it";
    if (recent_.empty()) return text(FlipCause::Unexplained);
    const ReachPose& was = recent_.back();
    for (std::size_t i = 1; i < was.joints.size(); ++i)
        if (was.joints[i] == was.joints[i - 1]) return "a bone has no length, and so no direction";
    if (!frame.target) return text(FlipCause::Unexplained);
    const glm::vec3 line = *frame.target - (finite(frame.joints.front()) ? frame.joints.front() : was.root());
    const float distance = math::length(line);
    if (distance <= 1e-4f * reach_) return "the target is on the root, where it has no direction";
    if (frame.pole) {
        const float angle = angle_between(line, *frame.pole - (*frame.target - line));
        if (in_degrees(std::min(angle, static_cast<float>(math::pi) - angle)) < 0.5f)
            return "the pole target is on the target's line, where the bend has no direction";
    }
    if (distance >= (1.0f - 1e-4f) * reach_)
        return "the target is out of reach: look for an acos or sqrt out of its range";
    return text(FlipCause::Unexplained);
}

bool IncidentFinder::find_nan(const TraceFrame& frame) {
    const auto bad = std::ranges::find_if_not(frame.joints, finite);
    const bool joint = bad != frame.joints.end();
    const bool active =
        joint || (frame.target && !finite(*frame.target)) || (frame.pole && !finite(*frame.pole));
    ChainIncident now{.kind = IncidentKind::Nan, .frame = frames_, .last_frame = frames_};
    if (joint) now.joint = static_cast<std::size_t>(bad - frame.joints.begin());
    if (active && !nan_.open) now.cause = nan_cause(frame);
    update_episode(nan_, active, now);
    return active;
}

void IncidentFinder::find_lengths(const ReachPose& pose, bool aimed) {
    bool opened = false;  // the previous bone began to differ in this frame
    for (std::size_t i = 0; i < lengths_.size(); ++i) {
        const float length = math::distance(pose.joints[i], pose.joints[i + 1]), off = length - lengths_[i];
        const float allowed = std::max(length_share * lengths_[i], rounded_lengths * options_.resolution);
        const bool beyond = aimed && off > 0.0f && math::distance(*pose.target, pose.root()) > reach_;
        const bool active = std::abs(off) > allowed;
        // Both bones at a joint change at once. If their outer ends keep their distance, only the joint
        // moved.
        const bool opens = active && !length_[i].open;
        if (opens && opened && !recent_.empty() && found_.size() < max_incidents) {
            const std::vector<glm::vec3>& was = recent_.back().joints;
            const auto changed = [&](std::size_t from, std::size_t to) {
                return std::abs(math::distance(pose.joints[from], pose.joints[to]) -
                                math::distance(was[from], was[to]));
            };
            if (changed(i - 1, i + 1) < unmoved_share * std::max(changed(i - 1, i), changed(i, i + 1)))
                displaced_.insert({frames_, i});
        }
        opened = opens;
        if (active) disturbed_ = frames_ + 1;
        update_episode(length_[i], active,
                       {.kind = IncidentKind::Length,
                        .frame = frames_,
                        .last_frame = frames_,
                        .joint = i + 1,
                        .amount = static_cast<double>(off),
                        .cause = beyond ? "the target is out of reach, and the bone stretches"
                                        : "nothing in the input explains it: lengths are not restored"});
    }
}

void IncidentFinder::find_limits(const ReachPose& pose) {
    for (std::size_t i = 0; i < limit_.size(); ++i) {
        const BendLimit& limit = options_.limits[i];
        if (limit.joint == 0 || limit.joint + 1 >= pose.joints.size()) continue;
        const glm::vec3 at = pose.joints[limit.joint];
        const float bend =
            in_degrees(angle_between(at - pose.joints[limit.joint - 1], pose.joints[limit.joint + 1] - at));
        const float beyond = std::max(bend - limit.max, limit.min - bend);
        update_episode(
            limit_[i], beyond > limit_degrees,
            {.kind = IncidentKind::Limit,
             .frame = frames_,
             .last_frame = frames_,
             .joint = limit.joint,
             .amount = static_cast<double>(beyond),
             .cause = bend > limit.max ? "it bends further than its limit" : "it bends less than its limit"});
    }
}

void IncidentFinder::find_flips(const ReachPose& pose, bool jumped, bool aimed) {
    const auto flip = [&](const BoneTurn& turn, FlipCause cause) {
        note({.kind = IncidentKind::Flip,
              .frame = frames_,
              .last_frame = frames_,
              .joint = turn.joint,
              .amount = static_cast<double>(in_degrees(turn.radians)),
              .cause = text(cause),
              .flip = cause});
        flipped_ = true;
        flipped_at_ = frames_;
        disturbed_ = frames_ + 1;
    };
    const bool straight_since = side_ && side_->straight_since;
    const bool other_side = changed_side(pose, jumped);
    if (recent_.empty()) return;
    const ReachPose& before = recent_.back();
    const auto cause = [&](const ReachPose& was) {
        return jumped ? FlipCause::TargetJump : cause_of_flip(was, pose, aimed);
    };
    // A bone flips if it turns far and moves much further than its target. The target's angle is ignored,
    // since it is arbitrary close to the root. A damped solver takes several frames to flip.
    const auto find_swing = [&](const ReachPose& was, float degrees) -> std::optional<BoneTurn> {
        const BoneTurn turn = furthest_turn(was, pose);
        const bool far = in_degrees(turn.radians) > degrees;
        return far && outpaces_input(was, pose, turn.joint, swing_lead) ? std::optional(turn) : std::nullopt;
    };
    if (const auto turn = find_swing(before, options_.flip_degrees)) return flip(*turn, cause(before));
    if (other_side) {
        const FlipCause why = cause(before);
        return flip(furthest_turn(before, pose),
                    straight_since && why == FlipCause::Unexplained ? FlipCause::Straight : why);
    }
    if (recent_.size() <= swing_frames || (flipped_ && frames_ - flipped_at_ <= swing_frames)) return;
    const ReachPose& first = recent_.front();
    if (const auto turn = find_swing(first, std::max(options_.flip_degrees, swing_degrees)))
        flip(*turn, cause(first));
}

FlipCause IncidentFinder::cause_of_flip(const ReachPose& before, const ReachPose& after, bool aimed) const {
    ReachPose from = reaching(before);
    if (!aimed) from.target.reset();
    const FlipCause cause = flip_cause(from, reaching(after));
    const bool axis =
        aimed && cause == FlipCause::Unexplained &&
        std::ranges::any_of(recent_, [&](const ReachPose& was) { return passed_axis(was, after); });
    return axis ? FlipCause::PassedAxis : cause;
}

/// Finds rolls: the part of a bone's rotation about itself, beyond the swing to its new direction.
void IncidentFinder::find_rolls(const ReachPose& pose, std::span<const glm::quat> rotations) {
    const std::vector<glm::quat> before = std::exchange(rotations_, {rotations.begin(), rotations.end()});
    const bool flips = flipped_ && flipped_at_ == frames_;
    if (recent_.empty() || flips || before.size() != rotations.size()) return;
    const std::vector<glm::vec3>& was = recent_.back().joints;
    BoneTurn furthest;
    for (std::size_t i = 0; i < std::min(rotations.size(), was.size() - 1); ++i) {
        const glm::vec3 from = was[i + 1] - was[i], to = pose.joints[i + 1] - pose.joints[i];
        const auto pointed = math::direction_of(from, 0.0f), bone = math::direction_of(to, 0.0f);
        if (!pointed || !bone) continue;
        // Swing-twist decomposition: the swing to the new direction first, then the roll about the bone.
        const glm::quat turn = math::compose(rotations[i], math::conjugate(before[i]));
        const glm::quat swing = math::minimal_rotation(*pointed, *bone);
        const glm::quat roll = math::compose(turn, math::conjugate(swing));
        const float radians =
            2.0f *
            math::arctangent(std::abs(math::dot(glm::vec3(roll.x, roll.y, roll.z), *bone)), std::abs(roll.w));
        if (radians > furthest.radians) furthest = {i, radians};  // false for NaN
    }
    const float degrees = in_degrees(furthest.radians);
    if (!(degrees > std::max(options_.flip_degrees, roll_degrees)) ||
        in_degrees(furthest_turn(recent_.back(), pose).radians) > options_.flip_degrees)
        return;
    note({.kind = IncidentKind::Flip,
          .frame = frames_,
          .last_frame = frames_,
          .joint = furthest.joint,
          .amount = static_cast<double>(degrees),
          .cause = text(FlipCause::Rolled),
          .flip = FlipCause::Rolled});
}

bool IncidentFinder::outpaces_input(const ReachPose& before, const ReachPose& after, std::size_t joint,
                                    float times) noexcept {
    const auto moved = [&](glm::vec3 from, glm::vec3 to) {
        return math::distance(from - before.root(), to - after.root());
    };
    const float driven = std::max(moved(*before.target, *after.target),
                                  before.pole && after.pole ? moved(*before.pole, *after.pole) : 0.0f);
    return moved(before.joints[joint], after.joints[joint]) > times * driven;
}

bool IncidentFinder::changed_side(const ReachPose& pose, bool jumped) {
    if (end_ != 2) return false;
    const glm::vec3 line = pose.joints[end_] - pose.root(), elbow = pose.joints[1] - pose.root();
    const float length = math::length(line);
    if (bend_of(std::span(pose.joints).first(end_ + 1)) < side_bend * reach_ ||
        !(length > side_bend * reach_)) {
        if (side_) side_->straight_since = true;
        return false;
    }
    Side now{.line = line / length,
             .normal = math::direction_of(math::cross(line, elbow), 0.0f).value_or(line)};
    if (pose.pole) now.pole = *pose.pole - pose.root();
    bool changed = false;
    if (side_) {
        const float turned = angle_between(side_->line, now.line);
        const glm::vec3 was = transported(side_->normal, side_->line, now.line);
        // Moving the pole target around the chain requests the other side.
        const bool asked = side_->pole.has_value() != now.pole.has_value() ||
                           (now.pole && angle_between(math::cross(now.line, *side_->pole),
                                                      math::cross(now.line, *now.pole)) > side_turn);
        changed = !asked && turned < (jumped ? 2.0f : 1.0f) * side_turn && math::dot(was, now.normal) < -0.5f;
        if (side_->straight_since && now.pole) changed = false;
    }
    side_ = now;
    return changed;
}

void IncidentFinder::finish() {
    update_episode(nan_, false, {});
    for (Episode& each : length_) update_episode(each, false, {});
    for (Episode& each : limit_) update_episode(each, false, {});
    finish_following();
    close_cadence();
    if (!cadence_.empty() && cadence_.back().fault) note(cadence_.back().incident);
    std::ranges::stable_sort(found_, {}, &ChainIncident::frame);
    merge_scaled(found_, lengths_);
    // A joint out of place changes both its bones over the same frames: one incident, the larger.
    std::size_t count = 0;
    bool merged = true;  // the last one was merged
    for (const ChainIncident& each : found_) {
        ChainIncident* const before = count > 0 ? &found_[count - 1] : nullptr;
        merged = !merged && before->kind == IncidentKind::Length && each.kind == IncidentKind::Length &&
                 before->frame == each.frame && before->last_frame == each.last_frame &&
                 before->joint + 1 == each.joint && displaced_.contains({each.frame, before->joint});
        if (!merged)
            found_[count++] = each;
        else if (std::abs(each.amount) > std::abs(before->amount))
            *before = each;
    }
    found_.resize(count);
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::BendLimit>() noexcept {
    using ik::BendLimit;
    static constexpr Field rows[] = {field<&BendLimit::joint>("joint", {1.0, 1e6}),
                                     field<&BendLimit::min>("min", {0.0, 180.0}, "deg"),
                                     field<&BendLimit::max>("max", {0.0, 180.0}, "deg")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::IncidentOptions>() noexcept {
    using ik::IncidentOptions;
    static constexpr Field rows[] = {
        field<&IncidentOptions::flip_degrees>("flip_degrees", {1.0, 180.0}, "deg"),
        field<&IncidentOptions::resolution>("resolution", {0.0, max_magnitude}, "m"),
        field<&IncidentOptions::fps>("fps", {0.0, 1e6}, "1/s").over(),
        list<&IncidentOptions::limits>("limits"),
        field<&IncidentOptions::end_effector>("end_effector", {1.0, 1e6})};
    return rows;
}
