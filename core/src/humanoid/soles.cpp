#include "tendril/humanoid/soles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "humanoid/facing.hpp"
#include "humanoid/input.hpp"
#include "humanoid/limb.hpp"
#include "humanoid/lint/feet.hpp"
#include "math/checks.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;
using tendril::detail::refused;

constexpr Bone legs[2][4]{{Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot, Bone::LeftToes},
                          {Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot, Bone::RightToes}};

// In leg lengths, from the project's own figure, whose leg is 0.85 m. heel_part is a fraction of the distance
// from ankle to toe.
constexpr double ball_part = 0.15 / 0.85, heel_part = 1.0 / 3.0, sole_part = 0.02 / 0.85,
                 ankle_part = 0.09 / 0.85;

glm::dvec3 level(const glm::dvec3& v) noexcept {
    return {v.x, 0.0, v.z};
}

glm::dvec3 in_space_of(const Placement& at, const glm::dvec3& point) noexcept {
    return detail::to_local(at, minus(point, at.position));
}

class Finder {
  public:
    Finder(const Skeleton& skeleton, const BoneMap& map)
        : skeleton_(skeleton), map_(map), at_(skeleton.size()) {
        place(skeleton, rest_pose(skeleton), at_);
    }

    Expected<Soles> find() const {
        Soles soles;
        for (const auto& leg : legs) {
            const double size = distance(leg[0], leg[1]) + distance(leg[1], leg[2]);
            if (!(distance(leg[0], leg[1]) > 1e-6 && distance(leg[1], leg[2]) > 1e-6 && size <= 1e6))
                return refused("find_soles", name(leg[0]), "the start of a leg whose bones have a length",
                               size);
            soles.leg += 0.5 * size;
        }
        const auto facing = detail::find_facing(skeleton_, map_, at_);
        if (!facing) return refused("find_soles", "the legs", "side by side", "both in one place");
        soles.forward = facing->forward;
        soles.floor = find_floor(soles.leg);
        for (std::size_t i = 0; i < 2; ++i) soles.feet[i] = find_sole(legs[i], soles);
        return soles;
    }

  private:
    std::size_t node(Bone bone) const { return static_cast<std::size_t>(map_[bone].node); }
    const glm::dvec3& position(Bone bone) const { return at_[node(bone)].position; }
    double distance(Bone a, Bone b) const { return length(minus(position(a), position(b))); }

    std::size_t end_of_foot(Bone foot) const { return detail::farthest_below(skeleton_, at_, node(foot)); }
    bool has(Bone bone) const { return map_[bone].node >= 0; }

    double find_floor(double leg) const {
        double lowest = std::numeric_limits<double>::max(), lowest_ankle = lowest;
        for (const auto& bones : legs) {
            lowest_ankle = std::min(lowest_ankle, position(bones[2]).y);
            for (std::size_t i = 0; i < skeleton_.size(); ++i)
                if (skeleton_.is_below(i, node(bones[2]))) lowest = std::min(lowest, at_[i].position.y);
        }
        if (lowest >= 0.0 && lowest <= 0.2 * leg) return 0.0;
        if (lowest < 0.0 && lowest >= -0.03 * leg) return lowest;
        return lowest - leg * (lowest < lowest_ankle - 0.02 * leg ? sole_part : ankle_part);
    }

    Sole find_sole(const Bone (&leg)[4], const Soles& soles) const {
        Sole sole{node(leg[2]), node(has(leg[3]) ? leg[3] : leg[2]), {}, {}};
        const glm::dvec3 ankle = position(leg[2]);
        glm::dvec3 toe = at_[sole.toes].position;
        if (sole.toes == sole.foot) toe = at_[end_of_foot(leg[2])].position;
        // The toe tip is further away than the ball, over which a foot rolls, and in some skeletons the toe
        // joint is next to the ankle.
        const glm::dvec3 way = level(minus(toe, ankle));
        const double size = length(way), ball = ball_part * soles.leg;
        const double part = sole.toes == sole.foot ? std::min(size, ball) : std::max(size, 0.6 * ball);
        toe = plus(ankle, size > 0.3 * ball ? times(way, part / size) : times(soles.forward, ball));
        const glm::dvec3 heel = minus(ankle, times(level(minus(toe, ankle)), heel_part));
        sole.heel = in_space_of(at_[sole.foot], {heel.x, soles.floor, heel.z});
        sole.toe = in_space_of(at_[sole.toes], {toe.x, soles.floor, toe.z});
        return sole;
    }

    const Skeleton& skeleton_;
    const BoneMap& map_;
    std::vector<Placement> at_;
};

/// Heel and toe of a standing foot, from the heights of its points above the ground.
Sole stood_sole(const Sole& sole, const lint_detail::Foot& foot, std::span<const Placement> rest) {
    const auto above = [&](std::size_t node) {
        const auto point = std::ranges::find(foot.points, node, &lint_detail::SolePoint::node);
        return point != foot.points.end() ? point->above : 0.0;
    };
    const Placement &ankle = rest[sole.foot], &toes = rest[sole.toes];
    const glm::dvec3 up = rotated(ankle.rotation(), foot.flat);
    const auto along_ground = [&](const glm::dvec3& v) { return minus(v, times(up, dot(up, v))); };
    const glm::dvec3 toe = sole.toes == sole.foot ? along_ground(minus(ankle.apply(sole.toe), ankle.position))
                                                  : along_ground(minus(toes.position, ankle.position));
    const glm::dvec3 below_ankle = times(up, -above(sole.foot));
    Sole stood = sole;
    stood.heel = in_space_of(ankle, plus(ankle.position, plus(below_ankle, times(toe, -heel_part))));
    stood.toe = sole.toes == sole.foot ? in_space_of(ankle, plus(ankle.position, plus(below_ankle, toe)))
                                       : in_space_of(toes, plus(toes.position, times(up, -above(sole.toes))));
    return stood;
}

double lowest_of(const SolePoints& foot) noexcept {
    return std::min(foot.heel.y, foot.toe.y);
}

}  // namespace

Expected<Soles> find_soles(const Skeleton& skeleton, const BoneMap& map) {
    if (const Result bad = detail::check_map("find_soles", map, skeleton); !bad) return bad;
    if (!map.upright) return refused("find_soles", "map", "for an upright figure", "one that is not upright");
    for (const Bone bone :
         {Bone::Hips, legs[0][0], legs[0][1], legs[0][2], legs[1][0], legs[1][1], legs[1][2]}) {
        if (map[bone].node >= 0) continue;
        std::string what = "one without ";
        what += name(bone);
        return refused("find_soles", "map", "one with hips and two legs", std::string_view(what));
    }
    return Finder(skeleton, map).find();
}

std::array<SolePoints, 2> sole_points(const Soles& soles, std::span<const Placement> placements) noexcept {
    std::array<SolePoints, 2> points;
    for (std::size_t i = 0; i < 2; ++i) {
        const Sole& sole = soles.feet[i];
        points[i] = {placements[sole.foot].apply(sole.heel), placements[sole.toes].apply(sole.toe)};
    }
    return points;
}

Soles clip_soles(const Skeleton& skeleton, const BoneMap& map, const Soles& soles, const Clip& clip) {
    const LintSettings settings;
    LintReport report = lint_detail::blank_report(clip, settings);
    if (report.frames < 3) return soles;
    report.frames = std::min<std::size_t>(report.frames, 10'000);
    const lint_detail::FeetMotion motion =
        lint_detail::feet_motion({skeleton, map, clip, settings, 0.0, report});
    if (motion.has_soles || motion.feet.size() != 2) return soles;
    std::vector<Placement> rest(skeleton.size());
    place(skeleton, rest_pose(skeleton), rest);
    Soles learned = soles;
    for (std::size_t i = 0; i < 2; ++i) {
        const lint_detail::Foot& foot = motion.feet[i];
        if (std::ranges::find(foot.still, true) == foot.still.end()) return soles;
        learned.feet[i] = stood_sole(soles.feet[i], foot, rest);
    }
    return learned;
}

double clip_floor(const Skeleton& skeleton, const Soles& soles, const Clip& clip) {
    constexpr double slow = 0.3, rate = 60.0;
    const double steps = std::clamp(std::ceil(clip.duration * rate), 1.0, 10'000.0);
    const double dt = clip.duration / steps;
    std::vector<rig::Transform> pose(skeleton.size());
    std::vector<Placement> placements(skeleton.size());
    std::vector<double> standing;
    double lowest = std::numeric_limits<double>::max();
    std::array<SolePoints, 2> before{};
    for (int i = 0; i <= static_cast<int>(steps); ++i) {
        sample(clip, skeleton, i * dt, pose);
        place(skeleton, pose, placements);
        const std::array<SolePoints, 2> now = sole_points(soles, placements);
        for (std::size_t foot = 0; foot < 2; ++foot) {
            lowest = std::min(lowest, lowest_of(now[foot]));
            if (i > 0 && length(minus(now[foot].toe, before[foot].toe)) < slow * dt)
                standing.push_back(lowest_of(now[foot]));
        }
        before = now;
    }
    // A foot held still in the air is not on the floor.
    std::erase_if(standing, [&](double height) { return height > lowest + 0.1; });
    if (standing.empty()) return lowest;
    const auto middle = standing.begin() + static_cast<std::ptrdiff_t>(standing.size() / 2);
    std::nth_element(standing.begin(), middle, standing.end());
    return *middle;
}

}  // namespace tendril::humanoid
