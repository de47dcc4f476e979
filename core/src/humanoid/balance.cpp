#include "tendril/humanoid/balance.hpp"

#include <algorithm>

#include "humanoid/anatomy.hpp"
#include "humanoid/balance.hpp"
#include "humanoid/input.hpp"
#include "humanoid/limb.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;

// De Leva's table 4, males: share of the body's mass, and centre, in segment lengths from the upper end.
// Heights of the trunk's three parts and the head: fractions of the line from mid hips to neck.

struct LimbMass {
    Bone bone, end;
    double share, part;
};
constexpr LimbMass limb_masses[]{{Bone::LeftUpperArm, Bone::LeftLowerArm, 0.0271, 0.5772},
                                 {Bone::RightUpperArm, Bone::RightLowerArm, 0.0271, 0.5772},
                                 {Bone::LeftLowerArm, Bone::LeftHand, 0.0162, 0.4574},
                                 {Bone::RightLowerArm, Bone::RightHand, 0.0162, 0.4574},
                                 {Bone::LeftUpperLeg, Bone::LeftLowerLeg, 0.1416, 0.4095},
                                 {Bone::RightUpperLeg, Bone::RightLowerLeg, 0.1416, 0.4095},
                                 {Bone::LeftLowerLeg, Bone::LeftFoot, 0.0433, 0.4395},
                                 {Bone::RightLowerLeg, Bone::RightFoot, 0.0433, 0.4395}};
struct TrunkMass {
    double share, height;
};
constexpr TrunkMass trunk_masses[]{{0.1117, 0.094}, {0.1633, 0.438}, {0.1596, 0.797}};
constexpr double head_share = 0.0694, head_height = 1.2;
constexpr double hand_share = 0.0061, hand_part = 0.25;    // lower arm lengths, beyond the wrist
constexpr double foot_share = 0.0137, foot_part = 0.4415;  // from the heel to the tip of the toes

// Fractions of the leg's length.
constexpr double tip_part = 0.07, ball_width = 0.11, end_width = 0.08;
constexpr double stands_below = 0.02, lifted_above = 0.08;

class MassFinder {
  public:
    MassFinder(const Skeleton& skeleton, const BoneMap& map, const Soles& soles)
        : map_(map), soles_(soles), at_(skeleton.size()) {
        place(skeleton, rest_pose(skeleton), at_);
    }

    Masses find() {
        for (const LimbMass& each : limb_masses)
            add(each.bone, mix(position(each.bone), position(each.end), each.part), each.share);
        trunk();
        hand(Bone::LeftLowerArm, Bone::LeftHand);
        hand(Bone::RightLowerArm, Bone::RightHand);
        const std::array<SolePoints, 2> soles = sole_points(soles_, at_);
        for (std::size_t side = 0; side < 2; ++side) {
            const glm::dvec3 way = minus(soles[side].toe, soles[side].heel);
            const double size = length(way), tip = size > 0.0 ? 1.0 + tip_part * soles_.leg / size : 1.0;
            const Bone foot = side == 0 ? Bone::LeftFoot : Bone::RightFoot;
            glm::dvec3 centre = plus(soles[side].heel, times(way, foot_part * tip));
            centre.y = 0.5 * (centre.y + position(foot).y);
            add(foot, centre, foot_share);
        }
        return std::move(masses_);
    }

  private:
    const glm::dvec3& position(Bone bone) const {
        return at_[static_cast<std::size_t>(map_[bone].node)].position;
    }
    void add(Bone bone, const glm::dvec3& centre, double share) {
        const auto node = static_cast<std::size_t>(map_[bone].node);
        masses_.points.push_back(
            {node, detail::to_local(at_[node], minus(centre, at_[node].position)), share});
    }
    void hand(Bone lower, Bone end) {
        const glm::dvec3& wrist = position(end);
        add(end, plus(wrist, times(minus(wrist, position(lower)), hand_part)), hand_share);
    }
    /// Each part is moved by the highest trunk bone below its centre.
    void trunk() {
        const glm::dvec3 low = mix(position(Bone::LeftUpperLeg), position(Bone::RightUpperLeg), 0.5);
        const Bone top = map_[Bone::Neck].node >= 0 ? Bone::Neck : Bone::Head;
        const glm::dvec3 line = minus(position(top), low);
        for (const TrunkMass& each : trunk_masses) {
            Bone mover = Bone::Hips;
            for (const Bone bone : {Bone::Spine, Bone::Chest, Bone::UpperChest}) {
                if (map_[bone].node < 0) continue;
                if (dot(minus(position(bone), low), line) <= each.height * dot(line, line)) mover = bone;
            }
            add(mover, plus(low, times(line, each.height)), each.share);
        }
        add(Bone::Head, plus(low, times(line, head_height)), head_share);
    }

    const BoneMap& map_;
    const Soles& soles_;
    std::vector<Placement> at_;
    Masses masses_;
};

double corner_turn(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) noexcept {
    return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
}

/// The hull of `points`, seen from above, by monotone chains (A. Andrew, 1979).
void find_hull(std::span<glm::dvec3> points, Support& support) noexcept {
    std::sort(points.begin(), points.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
        return a.x < b.x || (!(b.x < a.x) && a.z < b.z);
    });
    std::array<glm::dvec3, 2 * Support::max_corners + 2> chain;
    std::size_t count = 0;
    const auto add = [&](const glm::dvec3& point, std::size_t first) {
        while (count >= first + 2 && corner_turn(chain[count - 2], chain[count - 1], point) <= 0.0) --count;
        chain[count++] = point;
    };
    for (const glm::dvec3& each : points) add(each, 0);
    const std::size_t lower = count - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
    support.count = std::clamp<std::size_t>(count - 1, 1, Support::max_corners);
    std::copy_n(chain.begin(), support.count, support.corners.begin());
}

/// 1 near the ground, 0 well above it.
double standing_at(double height, double leg) noexcept {
    const double part = (lifted_above - height / leg) / (lifted_above - stands_below);
    const double inside = part > 0.0 ? std::min(part, 1.0) : 0.0;
    return inside * inside * (3.0 - 2.0 * inside);
}

/// The sole's horizontal direction. Its length is 1 up to 60 degrees of pitch and shrinks to 0 for a vertical
/// sole, where the direction reverses.
glm::dvec3 seen_from_above(const glm::dvec3& sole) noexcept {
    const glm::dvec3 level{sole.x, 0.0, sole.z};
    const double size = std::max(length(level), 0.5 * length(sole));
    return size > 0.0 ? times(level, 1.0 / size) : glm::dvec3(0.0);
}

glm::dvec3 nearest_on(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& point) noexcept {
    const double x = b.x - a.x, z = b.z - a.z, square = x * x + z * z;
    const double part = square > 0.0 ? ((point.x - a.x) * x + (point.z - a.z) * z) / square : 0.0;
    const double inside = std::clamp(part, 0.0, 1.0);
    return {a.x + inside * x, point.y, a.z + inside * z};
}

}  // namespace

glm::dvec3 Masses::centre(std::span<const Placement> placements) const noexcept {
    glm::dvec3 sum{0.0};
    for (const MassPoint& each : points)
        sum = plus(sum, times(placements[each.node].apply(each.at), each.share));
    return sum;
}

Expected<Masses> find_masses(const Skeleton& skeleton, const BoneMap& map) {
    if (const Result bad = detail::check_map("find_masses", map, skeleton); !bad) return bad;
    if (const Result bad = detail::check_usable("find_masses", map); !bad) return bad;
    const Expected<Soles> soles = find_soles(skeleton, map);
    if (!soles) return soles.error();
    return MassFinder(skeleton, map, *soles).find();
}

glm::dvec3 Support::nearest(const glm::dvec3& point) const noexcept {
    if (count == 0) return point;
    bool inside = count > 2;
    glm::dvec3 best = nearest_on(corners[count - 1], corners[0], point);
    const auto square = [&](const glm::dvec3& at) {
        return (at.x - point.x) * (at.x - point.x) + (at.z - point.z) * (at.z - point.z);
    };
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 &a = corners[i], &b = corners[i + 1 < count ? i + 1 : 0];
        inside = inside && corner_turn(a, b, point) >= 0.0;
        const glm::dvec3 at = nearest_on(a, b, point);
        if (square(at) < square(best)) best = at;
    }
    return inside ? point : best;
}

double Support::margin(const glm::dvec3& point) const noexcept {
    if (count == 0) return -static_cast<double>(max_magnitude);
    bool inside = count > 2;
    double least = static_cast<double>(max_magnitude);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 &a = corners[i], &b = corners[i + 1 < count ? i + 1 : 0];
        inside = inside && corner_turn(a, b, point) >= 0.0;
        least = std::min(least, length(minus(nearest_on(a, b, point), point)));
    }
    return inside ? least : -least;
}

Support Support::shrunk(double part) const noexcept {
    Support smaller = *this;
    for (std::size_t i = 0; i < count; ++i) smaller.corners[i] = mix(corners[i], middle, part);
    return smaller;
}

namespace detail {

std::array<SoleHeights, 2> sole_heights(const std::array<SolePoints, 2>& at, const Ground* ground) noexcept {
    const double lowest = std::min({at[0].heel.y, at[0].toe.y, at[1].heel.y, at[1].toe.y});
    const auto over = [&](const glm::dvec3& point) {
        if (ground == nullptr) return point.y - lowest;
        const auto hit = ground->highest(point.x, point.z);
        return hit ? point.y - hit->height : static_cast<double>(max_magnitude);
    };
    return {SoleHeights{over(at[0].heel), over(at[0].toe)}, SoleHeights{over(at[1].heel), over(at[1].toe)}};
}

Support find_support(const Soles& soles, const std::array<SolePoints, 2>& at,
                     const std::array<SoleHeights, 2>& over) noexcept {
    Support support;
    std::array<SolePoints, 2> on = at;
    for (std::size_t side = 0; side < 2; ++side) {
        const double heel = standing_at(over[side].heel, soles.leg),
                     toe = standing_at(over[side].toe, soles.leg), most = std::max(heel, toe);
        support.standing[side] = most;
        if (!(most > 0.0)) continue;
        on[side] = {mix(at[side].toe, at[side].heel, heel / most),
                    mix(at[side].heel, at[side].toe, toe / most)};
    }
    const double most = std::max(support.standing[0], support.standing[1]);
    if (!(most > 0.0)) return support;
    std::array<glm::dvec3, Support::max_corners> points;
    std::size_t count = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        const SolePoints& own = on[side];
        const SolePoints& other = on[1 - side];
        const glm::dvec3 centre = mix(other.heel, other.toe, 0.5);
        const glm::dvec3 ahead = seen_from_above(minus(at[side].toe, at[side].heel));
        const glm::dvec3 aside{ahead.z, 0.0, -ahead.x};
        // The tip retracts as the toes lift, and as the foot tilts, which shortens `ahead`.
        const double part = support.standing[side] / most;
        const double toes = standing_at(over[side].toe, soles.leg) / std::max(support.standing[side], 1e-300);
        const glm::dvec3 tip = plus(own.toe, times(ahead, tip_part * soles.leg * std::min(toes, 1.0)));
        const std::pair<glm::dvec3, double> pairs[]{
            {own.heel, end_width}, {own.toe, ball_width}, {tip, end_width}};
        for (const auto& [middle, width] : pairs)
            for (const double half : {0.5, -0.5})
                points[count++] = mix(centre, plus(middle, times(aside, half * width * soles.leg)), part);
    }
    for (const glm::dvec3& each : points)
        support.middle = plus(support.middle, times(each, 1.0 / Support::max_corners));
    find_hull(points, support);
    return support;
}

}  // namespace detail

Support find_support(const Soles& soles, const std::array<SolePoints, 2>& at, const Ground* ground) noexcept {
    return detail::find_support(soles, at, detail::sole_heights(at, ground));
}

Support find_support(const Soles& soles, std::span<const Placement> placements,
                     const Ground* ground) noexcept {
    return find_support(soles, sole_points(soles, placements), ground);
}

}  // namespace tendril::humanoid
