// The cure of a foot that slides, floats or sinks: its leg is solved in closed form so that it stands, and
// blends into the clip's motion before and after. If the leg is too short, the hips are lowered, and the
// other foot stays where it is.
//
// And of a leg that snaps straight. Near its full length a knee turns by any angle for the smallest way of
// the foot. Soft IK (A. Nicholas, "Soft IK", 2009) keeps it from there: over the last part of the leg's
// length, the way of the foot that it follows decays exponentially.
#include "humanoid/lint/cure_foot.hpp"

#include <algorithm>
#include <cmath>

#include "humanoid/lint/feet.hpp"
#include "humanoid/lint/tracks.hpp"
#include "math/checks.hpp"
#include "math/elementary.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

constexpr double ease = 0.15;          // seconds of blending into the clip before and after
constexpr double straightest = 0.995;  // of a leg's full length, unless it is straighter in the clip
constexpr double deepest = 0.1;        // of a leg's length: the hips are lowered by at most this
constexpr double nearer = 0.005;       // metres that soft IK brings a foot nearer at a leg's full length
constexpr double soft = 2.718281828459045 * nearer;  // metres of the leg's length that it softens

/// 1 at 0, 0 from 1 on.
double fading(double u) noexcept {
    return u >= 1.0 ? 0.0 : (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u);
}

/// The correction of each frame.
struct Plan {
    std::size_t first = 0;            ///< frame
    std::vector<glm::dvec3> moves{};  ///< of the foot, metres
    std::vector<double> drops{};      ///< of the hips, metres
};

/// The foot's correction for each frame of the finding.
std::vector<glm::dvec3> moves_of(const Foot& foot, const Finding& finding, const FeetMotion& motion,
                                 double floor, double rate) {
    std::vector<glm::dvec3> moves;
    glm::dvec3 slid(0.0), low(0.0), high(0.0);
    for (std::size_t i = finding.first; i <= finding.last; ++i) {
        if (finding.fault != Fault::Skating) {
            moves.push_back({0.0, floor - foot.height[i], 0.0});
            continue;
        }
        if (i > finding.first) slid = plus(slid, smallest_move(foot, i, times(motion.treadmill, 1.0 / rate)));
        for (int axis = 0; axis < 3; axis += 2) {
            low[axis] = std::min(low[axis], slid[axis]);
            high[axis] = std::max(high[axis], slid[axis]);
        }
        moves.push_back({-slid.x, 0.0, -slid.z});
    }
    // A foot that slid stands in the middle of its way, which keeps the correction small.
    for (glm::dvec3& move : moves) move = plus(move, times(plus(low, high), 0.5));
    return moves;
}

class Legs {
  public:
    Legs(const Check& check, Limb of_foot, std::optional<Limb> other)
        : check_(check),
          foot_(std::move(of_foot)),
          other_(std::move(other)),
          hips_(static_cast<std::size_t>(check.map[Bone::Hips].node)),
          pose_(check.skeleton.size()) {}

    /// How far the hips must be lowered for the foot to reach its corrected position, metres.
    double missing(std::size_t frame, const glm::dvec3& move) {
        sample(check_.clip, check_.skeleton, check_.time_of(frame), pose_);
        const detail::LimbPlacement at = detail::place(foot_, Placement{}, pose_);
        const glm::dvec3 way = minus(plus(at.end.position, move), at.upper.position);
        const double longest = longest_of(at), level2 = way.x * way.x + way.z * way.z;
        if (dot(way, way) <= longest * longest || level2 >= longest * longest) return 0.0;
        return std::min(-way.y - std::sqrt(longest * longest - level2), deepest * longest);
    }
    /// What brings the foot as near to the hip as soft IK has it, metres.
    glm::dvec3 soft_move(std::size_t frame) {
        sample(check_.clip, check_.skeleton, check_.time_of(frame), pose_);
        const detail::LimbPlacement at = detail::place(foot_, Placement{}, pose_);
        const glm::dvec3 way = minus(at.end.position, at.upper.position);
        const double far = length(way), hard = at.upper_length() + at.lower_length() - soft;
        if (!(far > hard && hard > 0.0)) return glm::dvec3(0.0);
        return times(way, (hard + soft * (1.0 - math::decay((far - hard) / soft))) / far - 1.0);
    }
    /// The clip's pose of that frame, with the foot moved and the hips lowered.
    const std::vector<rig::Transform>& posed(std::size_t frame, const glm::dvec3& move, double drop) {
        sample(check_.clip, check_.skeleton, check_.time_of(frame), pose_);
        const glm::dvec3 foot = plus(ankle(foot_), move);
        const glm::dvec3 other = other_ ? ankle(*other_) : glm::dvec3(0.0);
        if (drop > 0.0) {
            Placement above;
            for (std::size_t i = 0; foot_.node(i) != hips_; ++i)
                above = above * placement(pose_[foot_.node(i)]);
            glm::dvec3& place = pose_[hips_].translation;
            place = plus(place, detail::seen_from(above, {0.0, -drop, 0.0}));
        }
        bring(foot_, foot);
        if (other_ && drop > 0.0) bring(*other_, other);
        return pose_;
    }

    /// The nodes whose rotations change.
    std::vector<std::size_t> turned(bool is_lowered) const {
        std::vector<std::size_t> nodes;
        const auto add = [&](const Limb& limb) {
            for (const std::size_t place : {limb.upper, limb.lower, limb.end})
                nodes.push_back(limb.node(place));
        };
        add(foot_);
        if (other_ && is_lowered) add(*other_);
        return nodes;
    }
    std::size_t hips() const { return hips_; }

  private:
    glm::dvec3 ankle(const Limb& limb) { return detail::place(limb, Placement{}, pose_).end.position; }
    static double longest_of(const detail::LimbPlacement& at) {
        return std::max(straightest * (at.upper_length() + at.lower_length()),
                        length(minus(at.end.position, at.upper.position)));
    }
    /// Moves the leg's end to a position; it keeps its rotation, and the knee its side.
    void bring(const Limb& limb, const glm::dvec3& to) {
        detail::LimbPlacement at = detail::place(limb, Placement{}, pose_);
        const glm::dvec3 knee =
            minus(at.lower.position, times(plus(at.upper.position, at.end.position), 0.5));
        const detail::Pole pole{direction_of(knee, 1e-9).value_or(glm::dvec3(0.0, 0.0, 1.0)), 0.0, false};
        const double full = at.upper_length() + at.lower_length();
        const double part = full > 0.0 ? std::min(longest_of(at) / full, 1.0) : 1.0;
        detail::apply(detail::bend_to(at, to, pole, part), {1.0, 0.0, 0.0, 0.0}, limb, at, pose_);
    }

    const Check& check_;
    Limb foot_;
    std::optional<Limb> other_;
    std::size_t hips_;
    std::vector<rig::Transform> pose_;
};

/// The finding with the frames around it, in which the leg straightens or bends as well.
Finding widened(const Finding& finding, const Check& check) {
    const auto around = static_cast<std::size_t>(std::ceil(ease * check.report.rate));
    Finding wide = finding;
    wide.first -= std::min(finding.first, around);
    wide.last = std::min(finding.last + around, check.report.frames - 1);
    return wide;
}

Plan plan_of(Legs& legs, const std::vector<glm::dvec3>& moves, const Finding& finding, const Check& check) {
    const std::size_t frames = check.report.frames;
    const auto around = static_cast<std::size_t>(std::ceil(ease * check.report.rate));
    Plan plan{.first = finding.first - std::min(finding.first, around)};
    const std::size_t until = std::min(finding.last + around, frames - 1);
    std::vector<double> needed;
    for (std::size_t i = plan.first; i <= until; ++i) {
        const std::size_t off = i < finding.first  ? finding.first - i
                                : i > finding.last ? i - finding.last
                                                   : 0;
        const double part = fading(static_cast<double>(off) / static_cast<double>(around));
        plan.moves.push_back(times(moves[std::clamp(i, finding.first, finding.last) - finding.first], part));
        needed.push_back(legs.missing(i, plan.moves.back()));
    }
    plan.drops.assign(needed.size(), 0.0);
    for (std::size_t i = 0; i < needed.size(); ++i) {
        if (!(needed[i] > 0.0)) continue;
        for (std::size_t k = i - std::min(i, around); k < std::min(i + around, needed.size()); ++k) {
            const double off = static_cast<double>(k > i ? k - i : i - k) / static_cast<double>(around);
            plan.drops[k] = std::max(plan.drops[k], needed[i] * fading(off));
        }
    }
    return plan;
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

Expected<Clip> cure_foot(const Check& check, const Finding& found) {
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
    Legs legs(check, std::move(*leg),
              leg_of(check.skeleton, check.map, check.map[left ? Bone::RightFoot : Bone::LeftFoot].node));
    const Finding finding = found.snaps ? widened(found, check) : found;
    std::vector<glm::dvec3> away;
    if (found.snaps) {
        for (std::size_t i = finding.first; i <= finding.last; ++i) away.push_back(legs.soft_move(i));
    } else {
        const FeetMotion motion = feet_motion(check);
        const auto its = std::ranges::find(motion.feet, foot, &Foot::node);
        const auto floor = floor_of(motion, rate);
        if (!floor || its == motion.feet.end() || foot != found.node) return other_clip();
        away = moves_of(*its, finding, motion, *floor, rate);
    }
    const Plan plan = plan_of(legs, away, finding, check);

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
