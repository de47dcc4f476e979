// Cures a foot that slides, floats or sinks: solves its leg in closed form so that the foot stands, and
// blends into the clip's motion before and after. Faults of one foot that follow each other closely are cured
// together. If the leg is too short, the hips are lowered, and the other foot stays in place.
//
// Also cures a leg that snaps straight. Near full length, the smallest move of the foot can turn the knee by
// any angle. Soft IK (A. Nicholas, "Soft IK", 2009) avoids that: over the last part, the distance from hip to
// foot approaches the leg's full length exponentially. Every leg solved here is soft from the first frame in
// which it is that long to the last: a leg that is soft in one frame and straight in the next would snap.
#include "humanoid/lint/lint.hpp"

#include <algorithm>
#include <cmath>

#include "humanoid/lint/feet.hpp"
#include "humanoid/lint/tracks.hpp"
#include "math/checks.hpp"
#include "tendril/elementary.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

constexpr double stands = 0.02, swings = 0.08;  // metres above the floor
constexpr double max_drop = 0.1;                // in leg lengths: maximum lowering of the hips

/// The corrections, from the first frame that changes to the last.
struct Plan {
    std::size_t first = 0;            ///< frame
    std::vector<glm::dvec3> moves{};  ///< the foot's, metres
    std::vector<double> drops{};      ///< the hips', metres
};

/// The foot's correction for each frame of the finding.
std::vector<glm::dvec3> moves_of(const Foot& foot, const Finding& finding, const FeetMotion& motion,
                                 double rate) {
    std::vector<glm::dvec3> moves;
    glm::dvec3 slid(0.0), low(0.0), high(0.0);
    for (std::size_t i = finding.first; i <= finding.last; ++i) {
        if (finding.fault != Fault::Skating) {
            moves.push_back({0.0, *motion.floor - foot.height[i], 0.0});
            continue;
        }
        if (i > finding.first) slid = plus(slid, smallest_move(foot, i, times(motion.treadmill, 1.0 / rate)));
        for (int axis = 0; axis < 3; axis += 2) {
            low[axis] = std::min(low[axis], slid[axis]);
            high[axis] = std::max(high[axis], slid[axis]);
        }
        moves.push_back({-slid.x, 0.0, -slid.z});
    }
    // Put a sliding foot in the middle of its path, which keeps the correction small.
    for (glm::dvec3& move : moves) move = plus(move, times(plus(low, high), 0.5));
    return moves;
}

/// A leg of the clip, and the direction in which its knee bends.
class CuredLeg {
  public:
    /// `nearer`: metres that soft IK brings the foot nearer at the leg's full length.
    CuredLeg(const Check& check, Limb limb, double nearer)
        : limb_(std::move(limb)), soft_(2.718281828459045 * nearer) {
        std::vector<rig::Transform> pose(check.skeleton.size());
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < check.report.frames; ++i) {
            sample(check.clip, check.skeleton, check.time_of(i), pose);
            const detail::LimbPlacement at = placed(pose);
            lengths_.push_back(length(minus(at.end.position, at.upper.position)));
            full_ = at.upper_length() + at.lower_length();
            sum = plus(sum, rotated(conjugate(at.upper.rotation()), knee(at)));
        }
        forward_ = direction_of(sum, 1e-9).value_or(glm::dvec3(0.0, 0.0, 1.0));
    }

    const Limb& limb() const noexcept { return limb_; }
    detail::LimbPlacement placed(std::vector<rig::Transform>& pose) const {
        return detail::place(limb_, Placement{}, pose);
    }
    /// True if the clip stretches the leg so far that soft IK shortens it.
    bool is_soft(std::size_t frame) const { return lengths_[frame] > soft_start(); }
    /// The distance from hip to foot after soft IK, metres.
    double softened(double far) const {
        if (!(far > soft_start() && soft_start() > 0.0)) return far;
        return soft_start() + soft_ * (1.0 - math::decay((far - soft_start()) / soft_));
    }

    /// Brings the leg's end to a position, or as near as `longest` allows; the end keeps its rotation. The
    /// knee keeps its side, but the further it must bend, the more it takes the side to which it bends in the
    /// whole clip, because a straight leg has none.
    void reach_for(const glm::dvec3& to, double longest, std::vector<rig::Transform>& pose) const {
        detail::LimbPlacement at = placed(pose);
        const glm::dvec3 offset = minus(to, at.upper.position);
        const double far = length(offset), near = std::min(far, longest);
        if (!(far > 0.0)) return;
        const double bent = bend(near) - bend(length(minus(at.end.position, at.upper.position)));
        const detail::Pole pole{rotated(at.upper.rotation(), forward_), std::max(bent, 0.0), false};
        const glm::dvec3 end = plus(at.upper.position, times(offset, near / far));
        detail::apply(detail::bend_to(at, end, pole, 1.0), {1.0, 0.0, 0.0, 0.0}, limb_, at, pose);
    }

  private:
    double soft_start() const noexcept { return full_ - soft_; }
    /// Approximate distance of the knee from the line, for a leg of length `far`; in leg lengths.
    double bend(double far) const {
        return full_ > 0.0 ? 0.5 * std::sqrt(std::max(1.0 - far * far / (full_ * full_), 0.0)) : 0.0;
    }
    static glm::dvec3 knee(const detail::LimbPlacement& at) {
        const auto line = direction_of(minus(at.end.position, at.upper.position), 1e-9);
        const glm::dvec3 offset = minus(at.lower.position, at.upper.position);
        return line ? across(offset, *line) : offset;
    }

    Limb limb_;
    double soft_;                  ///< metres of the leg's length that are softened
    std::vector<double> lengths_;  ///< in the clip, by frame
    double full_ = 0.0;
    glm::dvec3 forward_{0.0, 0.0, 1.0};  ///< in the thigh's own space
};

class CuredLegs {
  public:
    CuredLegs(const Check& check, Limb of_foot, std::optional<Limb> other, double nearer)
        : check_(check),
          foot_(check, std::move(of_foot), nearer),
          hips_(static_cast<std::size_t>(check.map[Bone::Hips].node)),
          pose_(check.skeleton.size()) {
        if (other) other_.emplace(check, std::move(*other), nearer);
    }
    const CuredLeg& foot() const noexcept { return foot_; }

    /// Distance by which the hips must be lowered for the foot to reach its corrected position, metres.
    double shortfall(std::size_t frame, const glm::dvec3& move) {
        sample(check_.clip, check_.skeleton, check_.time_of(frame), pose_);
        const detail::LimbPlacement at = foot_.placed(pose_);
        const glm::dvec3 leg = minus(plus(at.end.position, move), at.upper.position);
        const double longest = foot_.softened(length(leg)), level2 = leg.x * leg.x + leg.z * leg.z;
        if (dot(leg, leg) <= longest * longest || level2 >= longest * longest) return 0.0;
        return std::min(-leg.y - std::sqrt(longest * longest - level2), max_drop * longest);
    }
    /// The clip's pose of that frame, with the foot moved and the hips lowered.
    const std::vector<rig::Transform>& posed(std::size_t frame, const glm::dvec3& move, double drop) {
        sample(check_.clip, check_.skeleton, check_.time_of(frame), pose_);
        const Goal foot = goal(foot_, move);
        const std::optional<Goal> other =
            other_ && drop > 0.0 ? std::optional(goal(*other_, glm::dvec3(0.0))) : std::nullopt;
        if (drop > 0.0) {
            Placement above;
            for (std::size_t i = 0; foot_.limb().node(i) != hips_; ++i)
                above = above * placement(pose_[foot_.limb().node(i)]);
            glm::dvec3& place = pose_[hips_].translation;
            place = plus(place, detail::to_local(above, {0.0, -drop, 0.0}));
        }
        foot_.reach_for(foot.at, foot.longest, pose_);
        if (other) other_->reach_for(other->at, other->longest, pose_);
        return pose_;
    }

    /// The nodes whose rotations change.
    std::vector<std::size_t> turned(bool is_lowered) const {
        std::vector<std::size_t> nodes;
        const auto add = [&](const Limb& limb) {
            for (const std::size_t place : {limb.upper, limb.lower, limb.end})
                nodes.push_back(limb.node(place));
        };
        add(foot_.limb());
        if (other_ && is_lowered) add(other_->limb());
        return nodes;
    }
    std::size_t hips() const { return hips_; }

  private:
    struct Goal {
        glm::dvec3 at;
        double longest;  ///< length of the leg, metres: by soft IK, from the hip's position in the clip
    };
    Goal goal(const CuredLeg& leg, const glm::dvec3& move) {
        const detail::LimbPlacement at = leg.placed(pose_);
        const glm::dvec3 to = plus(at.end.position, move);
        return {to, leg.softened(length(minus(to, at.upper.position)))};
    }

    const Check& check_;
    CuredLeg foot_;
    std::optional<CuredLeg> other_;
    std::size_t hips_;
    std::vector<rig::Transform> pose_;
};

/// Corrections of several ranges of frames, blended into each other and into the clip.
class Blend {
  public:
    Blend(std::size_t frames, std::size_t around) : moves_(frames), around_(around) {}

    std::size_t frames() const noexcept { return moves_.size(); }
    void add(std::size_t first, const std::vector<glm::dvec3>& moves) {
        for (std::size_t i = 0; i < moves.size(); ++i) moves_[first + i] = moves[i];
    }
    /// The first and the last frame that change.
    std::pair<std::size_t, std::size_t> range() const {
        std::size_t first = 0, last = moves_.size() - 1;
        while (first < last && !moves_[first]) ++first;
        while (last > first && !moves_[last]) --last;
        return {first - std::min(first, around_), std::min(last + around_, moves_.size() - 1)};
    }
    glm::dvec3 at(std::size_t frame) const {
        if (moves_[frame]) return *moves_[frame];
        const std::size_t far = 2 * around_;
        std::size_t back = 1, on = 1;
        while (back < far && back <= frame && !moves_[frame - back]) ++back;
        while (on < far && frame + on < moves_.size() && !moves_[frame + on]) ++on;
        const bool follows = back <= frame && moves_[frame - back],
                   leads = frame + on < moves_.size() && moves_[frame + on];
        const auto part = [](std::size_t off, std::size_t of) {
            return falloff(static_cast<double>(off) / static_cast<double>(of));
        };
        if (follows && leads && back + on < far)
            return plus(times(*moves_[frame - back], part(back, back + on)),
                        times(*moves_[frame + on], part(on, back + on)));
        glm::dvec3 sum(0.0);
        if (follows) sum = plus(sum, times(*moves_[frame - back], part(back, around_)));
        if (leads) sum = plus(sum, times(*moves_[frame + on], part(on, around_)));
        return sum;
    }

  private:
    std::vector<std::optional<glm::dvec3>> moves_;
    std::size_t around_;
};

/// `height`: the foot's height above the floor in a frame of the clip.
template <class Height>
Plan plan_of(CuredLegs& legs, const Blend& blend, std::size_t around, Height height) {
    auto [first, last] = blend.range();
    while (first > 0 && legs.foot().is_soft(first)) --first;
    while (last + 1 < blend.frames() && legs.foot().is_soft(last)) ++last;
    Plan plan{.first = first};
    std::vector<double> needed;
    for (std::size_t i = first; i <= last; ++i) {
        plan.moves.push_back(blend.at(i));
        // Only a standing foot must reach its position; a swinging one moves nearer to the hip instead.
        const double above = (height(i) + plan.moves.back().y - stands) / (swings - stands);
        needed.push_back(falloff(std::max(above, 0.0)) * legs.shortfall(i, plan.moves.back()));
    }
    plan.drops.assign(needed.size(), 0.0);
    for (std::size_t i = 0; i < needed.size(); ++i) {
        if (!(needed[i] > 0.0)) continue;
        for (std::size_t k = i - std::min(i, around); k < std::min(i + around, needed.size()); ++k) {
            const double off = static_cast<double>(k > i ? k - i : i - k) / static_cast<double>(around);
            plan.drops[k] = std::max(plan.drops[k], needed[i] * falloff(off));
        }
    }
    return plan;
}

/// The finding and the same faults of this foot before and after it, each within `near` frames of the next;
/// counted from the first frame judged.
std::vector<Finding> adjacent_findings(const Check& check, const Finding& found, std::size_t near) {
    LintReport report = check.report;
    Check feet{check.skeleton, check.map, check.clip, check.settings, check.height, report};
    check_feet(feet);
    std::vector<Finding> all{found};
    for (bool grows = true; grows;) {
        grows = false;
        for (const Finding& each : report.findings) {
            if (each.fault != found.fault || each.node != found.node) continue;
            if (std::ranges::find(all, each.first, &Finding::first) != all.end()) continue;
            const bool is_near = std::ranges::any_of(all, [&](const Finding& one) {
                return each.first < one.last + near && one.first < each.last + near;
            });
            if (is_near) all.push_back(each), grows = true;
        }
    }
    for (Finding& each : all) each.first -= check.begin, each.last -= check.begin;
    return all;
}

Channel& channel_of(Clip& clip, std::size_t node) {
    const auto found = std::find_if(clip.channels.begin(), clip.channels.end(),
                                    [&](const Channel& each) { return each.node == node; });
    return found != clip.channels.end() ? *found : clip.channels.emplace_back(Channel{.node = node});
}

}  // namespace

std::optional<Limb> leg_of(const Skeleton& skeleton, const BoneMap& map, std::int32_t foot) {
    const bool left = foot == map[Bone::LeftFoot].node;
    const std::int32_t upper = map[left ? Bone::LeftUpperLeg : Bone::RightUpperLeg].node,
                       lower = map[left ? Bone::LeftLowerLeg : Bone::RightLowerLeg].node,
                       hips = map[Bone::Hips].node;
    if (foot < 0 || upper < 0 || lower < 0 || hips < 0) return std::nullopt;
    if (!skeleton.is_below(static_cast<std::size_t>(upper), static_cast<std::size_t>(hips)))
        return std::nullopt;
    return Limb::make(skeleton, upper, lower, foot, foot);
}

Expected<Clip> cure_foot(const Check& check, const Finding& found, const FootCure& options) {
    using tendril::detail::refused;
    const auto other_clip = [&] {
        return refused("cure", "finding", "one of this clip", std::string_view(found.text));
    };
    if (check.report.frames < 2) return other_clip();
    const double rate = check.report.rate;
    const bool left = found.node == check.map[found.snaps ? Bone::LeftLowerLeg : Bone::LeftFoot].node;
    const std::int32_t foot = check.map[left ? Bone::LeftFoot : Bone::RightFoot].node;
    std::optional<Limb> leg = leg_of(check.skeleton, check.map, foot);
    if (!leg ||
        (found.snaps && found.node != check.map[left ? Bone::LeftLowerLeg : Bone::RightLowerLeg].node))
        return other_clip();
    CuredLegs legs(check, std::move(*leg),
                   leg_of(check.skeleton, check.map, check.map[left ? Bone::RightFoot : Bone::LeftFoot].node),
                   options.nearer);
    const auto around = static_cast<std::size_t>(std::ceil(options.ease * rate));
    const FeetMotion motion = feet_motion(check);
    const auto record = std::ranges::find(motion.feet, foot, &Foot::node);
    const bool is_known = motion.floor && record != motion.feet.end();
    // A leg that is only softened needs no blending.
    Blend blend(check.report.frames, found.snaps ? 1 : around);
    if (found.snaps) {
        blend.add(found.first - check.begin,
                  std::vector<glm::dvec3>(found.last - found.first + 1, glm::dvec3(0.0)));
    } else {
        if (!is_known || foot != found.node) return other_clip();
        for (const Finding& each : adjacent_findings(check, found, 2 * around))
            blend.add(each.first, moves_of(*record, each, motion, rate));
    }
    const Plan plan = plan_of(legs, blend, around, [&](std::size_t frame) {
        return is_known ? record->height[frame] - *motion.floor : swings;
    });

    const std::size_t end = check.report.frames, until = plan.first + plan.moves.size();
    if ((plan.first == 0 && check.begin > 0) || (until == end && check.time_of(end) > check.time_of(end - 1)))
        return Result(ErrorCode::OutOfRange, "cure: the correction reaches beyond the frames around it");

    const bool is_lowered = *std::max_element(plan.drops.begin(), plan.drops.end()) > 0.0;
    const std::vector<std::size_t> nodes = legs.turned(is_lowered);
    std::vector<double> times;
    std::vector<std::vector<glm::dquat>> turns(nodes.size());
    std::vector<std::vector<glm::dvec3>> moves(nodes.size());
    std::vector<glm::dvec3> hips;
    for (std::size_t i = 0; i < plan.moves.size(); ++i) {
        const double time = check.time_of(plan.first + i);
        if (!times.empty() && !(time > times.back()))
            break;  // the last frame, where the clip ends a little early
        const std::vector<rig::Transform>& pose = legs.posed(plan.first + i, plan.moves[i], plan.drops[i]);
        times.push_back(time);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const rig::Transform key = key_of(check.skeleton, pose, nodes[k]);
            turns[k].push_back(key.rotation);
            moves[k].push_back(key.translation);
        }
        hips.push_back(pose[legs.hips()].translation);
    }
    Clip cured = check.clip;
    const auto replace = [&](std::size_t node, auto track, const auto& values) {
        Channel& channel = channel_of(cured, node);
        const Channel was = channel;
        replace_keys(was, channel.*track, times, values);
    };
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        replace(nodes[k], &Channel::rotation, turns[k]);
        if (check.skeleton[nodes[k]].keys) replace(nodes[k], &Channel::translation, moves[k]);
    }
    if (is_lowered) replace(legs.hips(), &Channel::translation, hips);
    if (const Result bad = humanoid::check(cured, check.skeleton); !bad) return bad;
    return cured;
}

}  // namespace tendril::humanoid::lint_detail
