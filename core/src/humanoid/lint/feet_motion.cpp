#include <algorithm>
#include <limits>

#include "humanoid/facing.hpp"
#include "humanoid/lint/feet.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

constexpr double still_speed = 0.2;       // m/s: a slower foot is still
constexpr double sliding_speed = 0.6;     // the same if feet slide all the time
constexpr double max_ground_tilt = 15.0;  // degrees, the same if the rest pose stands on the ground
constexpr double max_rest_tilt = 8.0;     // degrees that a standing foot may tilt from its rest
constexpr glm::dvec3 up{0.0, 1.0, 0.0};

struct Side {
    Bone foot, toes;
};
constexpr Side sides[]{{Bone::LeftFoot, Bone::LeftToes}, {Bone::RightFoot, Bone::RightToes}};

double angle_between(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return arctangent(length(cross(a, b)), dot(a, b)) * degrees;
}

Foot foot_of(const Check& check, const Side& side, const std::vector<Placement>& rest) {
    Foot foot;
    foot.node = check.map[side.foot].node;
    const auto ankle = static_cast<std::size_t>(foot.node);
    foot.points.push_back({ankle, 0.0});
    const std::int32_t toes = check.map[side.toes].node;
    if (toes >= 0) foot.points.push_back({static_cast<std::size_t>(toes), 0.0});
    const std::size_t tip =
        detail::farthest_below(check.skeleton, rest, toes >= 0 ? static_cast<std::size_t>(toes) : ankle);
    if (tip != foot.points.back().node) foot.points.push_back({tip, 0.0});
    foot.flat = rotated(conjugate(rest[ankle].rotation()), up);
    for (SolePoint& point : foot.points) point.above = rest[point.node].position.y;
    return foot;
}

/// Properties of the rest pose: both feet are level; both are on the ground.
struct Rest {
    bool is_level = true, is_ground = false;
};
Rest measure_rest(std::vector<Foot>& feet, double hips) {
    double ground = std::numeric_limits<double>::max();
    for (const Foot& foot : feet)
        for (const SolePoint& point : foot.points) ground = std::min(ground, point.above);
    const double leg = hips - ground;
    Rest rest;
    if (feet.size() == 2)
        for (std::size_t k = 0; k < std::min(feet[0].points.size(), feet[1].points.size()); ++k)
            rest.is_level &= std::abs(feet[0].points[k].above - feet[1].points[k].above) < 0.01 * leg;
    rest.is_ground = rest.is_level && ground > -0.02 * leg && ground < 0.12 * leg;
    if (!rest.is_ground)
        for (Foot& foot : feet)
            for (SolePoint& point : foot.points) point.above -= ground;
    // The toe tip flexes and dips a little as a foot rolls off: treat it as 15 mm higher.
    for (Foot& foot : feet)
        if (foot.points.size() == 3) foot.points.back().above -= 0.015;
    return rest;
}

/// A point's position, and the up direction there, as if the ground were a level floor at height 0.
struct OnGround {
    glm::dvec3 position, up;
};
OnGround on_ground(const Ground* ground, const glm::dvec3& position) {
    constexpr double from = 0.5;  // metres above the point
    const auto hit = ground == nullptr || ground->kind() == GroundKind::None
                         ? std::nullopt
                         : ground->below({position.x, position.y + from, position.z});
    if (!hit) return {position, up};
    return {{position.x, position.y - hit->height, position.z}, hit->normal};
}

/// True if the hips are above a foot, and the head above the hips, relative to their distances at rest.
bool is_upright(const Check& check, std::int32_t foot, const std::vector<Placement>& rest,
                const std::vector<Placement>& now) {
    constexpr double risen = 0.6;  // fraction of those; on a chair hips are at 0.5, a lying head at 0.1
    const auto rises = [&](std::int32_t from, std::int32_t to) {
        if (from < 0 || to < 0) return true;
        const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
        return now[b].position.y - now[a].position.y >
               risen * length(minus(rest[b].position, rest[a].position));
    };
    const std::int32_t hips = check.map[Bone::Hips].node;
    return rises(foot, hips) && rises(hips, check.map[Bone::Head].node);
}

void sample_feet(const Check& check, const std::vector<Placement>& rest, FeetMotion& motion) {
    const Skeleton& skeleton = check.skeleton;
    const auto hips = static_cast<std::size_t>(check.map[Bone::Hips].node);
    std::vector<rig::Transform> pose(skeleton.size());
    std::vector<Placement> placed(skeleton.size());
    for (std::size_t i = 0; i < check.report.frames; ++i) {
        sample(check.clip, skeleton, check.time_of(i), pose);
        place(skeleton, pose, placed);
        motion.hips.push_back(placed[hips].position);
        for (Foot& foot : motion.feet) {
            const Placement& ankle = placed[static_cast<std::size_t>(foot.node)];
            const auto on = [&](const glm::dvec3& at) { return on_ground(check.settings.ground, at); };
            for (const SolePoint& point : foot.points)
                foot.positions.push_back(on(placed[point.node].position).position);
            foot.ups.push_back(rotated(conjugate(ankle.rotation()), on(ankle.position).up));
            foot.upright.push_back(is_upright(check, foot.node, rest, placed));
        }
    }
}

void measure_heights(Foot& foot) {
    const std::size_t frames = foot.ups.size();
    foot.height.assign(frames, std::numeric_limits<double>::max());
    foot.tilt.resize(frames);
    for (std::size_t i = 0; i < frames; ++i) {
        for (std::size_t k = 0; k < foot.points.size(); ++k)
            foot.height[i] = std::min(foot.height[i], foot.at(k, i).y - foot.points[k].above);
        foot.tilt[i] = angle_between(foot.flat, foot.ups[i]);
    }
}

/// The median velocity of the lowest point of both feet, over the frames in which it is near the ground. 0
/// for a figure that travels, and for less than half a step.
glm::dvec3 treadmill_of(const FeetMotion& motion, double rate) {
    const std::size_t frames = motion.hips.size();
    constexpr double half_step = 0.3;  // seconds
    if (frames < 4 || static_cast<double>(frames) < half_step * rate) return glm::dvec3(0.0);
    std::vector<double> lowest(frames, std::numeric_limits<double>::max());
    std::vector<glm::dvec3> moves(frames, glm::dvec3(0.0));
    for (std::size_t i = 1; i < frames; ++i)
        for (const Foot& foot : motion.feet)
            for (std::size_t k = 0; k < foot.points.size(); ++k) {
                const double height = foot.at(k, i).y - foot.points[k].above;
                if (height < lowest[i])
                    lowest[i] = height, moves[i] = minus(foot.at(k, i), foot.at(k, i - 1));
            }
    std::vector<double> sorted(lowest.begin() + 1, lowest.end()), x, z;
    const double usual = median(sorted);
    for (std::size_t i = 1; i < frames; ++i)
        if (lowest[i] < usual + 0.02) x.push_back(moves[i].x * rate), z.push_back(moves[i].z * rate);
    const glm::dvec3 velocity{median(x), 0.0, median(z)};
    const double seconds = static_cast<double>(frames - 1) / rate;
    const double advance = level(minus(motion.hips.back(), motion.hips.front()));
    if (level(velocity) < 0.25 || advance > 0.35 * level(velocity) * seconds) return glm::dvec3(0.0);
    return velocity;
}

void measure_speed(Foot& foot, const glm::dvec3& treadmill, double rate) {
    const std::size_t frames = foot.ups.size();
    foot.speed.assign(frames, std::numeric_limits<double>::max());  // unknown for a single frame
    foot.min_speed.assign(frames, 0.0);
    foot.still.assign(frames, false);
    if (frames < 2) return;
    const auto slowest_between = [&](std::size_t from, std::size_t to) {
        const double by_second = rate / static_cast<double>(to - from);
        double slowest = std::numeric_limits<double>::max();
        for (std::size_t k = 0; k < foot.points.size(); ++k)
            slowest = std::min(
                slowest, length(minus(times(minus(foot.at(k, to), foot.at(k, from)), by_second), treadmill)));
        return slowest;
    };
    for (std::size_t i = 0; i < frames; ++i) {
        const std::size_t from = i > 0 ? i - 1 : 0, to = i + 1 < frames ? i + 1 : i;
        foot.speed[i] = slowest_between(from, to);
        if (from + 2 == to) foot.min_speed[i] = std::min(slowest_between(from, i), slowest_between(i, to));
    }
}

/// Marks the still frames; true if there are enough of them.
bool find_still(std::vector<Foot>& feet, double below) {
    bool any = false;
    for (Foot& foot : feet) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < foot.speed.size(); ++i) {
            foot.still[i] = foot.speed[i] < below && foot.min_speed[i] < 3.0 * below;
            count += foot.still[i];
        }
        any |= count > 2 && 20 * count > foot.speed.size();
    }
    return any;
}

/// True if standing feet are tilted as at rest: a fifth of them if the rest pose stands on the ground,
/// otherwise most.
bool stands_as_it_rests(const std::vector<Foot>& feet, bool rests_on_ground, double rate) {
    std::vector<double> tilts;
    for (const Foot& foot : feet)
        for (std::size_t i = 0; i < foot.still.size(); ++i)
            if (foot.is_loaded(i)) tilts.push_back(foot.tilt[i]);
    if (!rests_on_ground) return tilts.empty() || median(tilts) < max_rest_tilt;
    const auto matching = static_cast<std::size_t>(
        std::count_if(tilts.begin(), tilts.end(), [](double each) { return each < max_ground_tilt; }));
    return static_cast<double>(tilts.size()) < min_stance * rate || 5 * matching >= tilts.size();
}

/// Learns the points' heights above the ground, and the feet's up directions, from the frames in which feet
/// carry the figure.
void learn_soles(std::vector<Foot>& feet) {
    double ground = std::numeric_limits<double>::max();
    std::vector<double> heights;
    std::vector<double*> learned;
    for (Foot& foot : feet) {
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < foot.still.size(); ++i)
            if (foot.is_loaded(i)) sum = plus(sum, foot.ups[i]);
        if (const auto mean = direction_of(sum, 1e-9)) foot.flat = *mean;
        for (std::size_t k = 0; k < foot.points.size(); ++k) {
            heights.clear();
            for (const Foot& each : feet)
                for (std::size_t i = 0; i < each.still.size() && k < each.points.size(); ++i)
                    if (each.is_loaded(i)) heights.push_back(each.at(k, i).y);
            if (heights.empty())
                continue;  // no foot with such a point is ever still: it keeps its rest height
            std::sort(heights.begin(), heights.end());
            foot.points[k].above = densest(heights, 0.03);
            learned.push_back(&foot.points[k].above);
            ground = std::min(ground, foot.points[k].above);
        }
    }
    for (double* const above : learned) *above -= ground;
}

std::optional<double> floor_of(const FeetMotion& motion, double rate) {
    constexpr double width = 0.03;
    std::vector<double> heights, at_rest;
    for (const Foot& foot : motion.feet) {
        for (std::size_t i = 0; i < foot.height.size(); ++i) {
            const bool is_at_rest = std::abs(foot.height[i]) < 0.5 * width;
            if (!foot.still[i] || (motion.rests_on_ground && !is_at_rest && !foot.is_loaded(i))) continue;
            heights.push_back(foot.height[i]);
            if (is_at_rest) at_rest.push_back(foot.height[i]);
        }
    }
    if (motion.hips.size() < 4 || static_cast<double>(heights.size()) < min_stance * rate)
        return std::nullopt;
    const bool use_rest = motion.rests_on_ground && 5 * at_rest.size() >= heights.size();
    std::vector<double>& used = use_rest ? at_rest : heights;
    std::sort(used.begin(), used.end());
    return use_rest ? used[used.size() / 2] : densest(used, width);
}

}  // namespace

double densest(const std::vector<double>& sorted, double width) {
    std::size_t best_first = 0, best_count = 0, last = 0;
    for (std::size_t first = 0; first < sorted.size(); ++first) {
        while (last < sorted.size() && sorted[last] - sorted[first] <= width) ++last;
        if (last - first > best_count) best_count = last - first, best_first = first;
    }
    return sorted[best_first + best_count / 2];
}

FeetMotion feet_motion(const Check& check) {
    FeetMotion motion;
    const std::int32_t hips = check.map[Bone::Hips].node;
    if (hips < 0 || !check.map.upright) return motion;
    std::vector<Placement> placed(check.skeleton.size());
    place(check.skeleton, rest_pose(check.skeleton), placed);
    if (const KnownFeet& whole = check.report.feet; whole.are_known) {
        motion = {.treadmill = whole.treadmill,
                  .always_slides = whole.always_slides,
                  .rests_on_ground = whole.rests_on_ground,
                  .has_soles = whole.has_soles,
                  .floor = whole.floor};
        for (const KnownFeet::Foot& foot : whole.feet)
            motion.feet.push_back({.node = foot.node, .points = foot.points, .flat = foot.flat});
        sample_feet(check, placed, motion);
        for (Foot& foot : motion.feet) {
            measure_speed(foot, motion.treadmill, check.report.rate);
            measure_heights(foot);
        }
        find_still(motion.feet, motion.always_slides ? sliding_speed : still_speed);
        return motion;
    }
    for (const Side& side : sides)
        if (check.map[side.foot].node >= 0) motion.feet.push_back(foot_of(check, side, placed));
    if (motion.feet.empty()) return motion;
    const Rest rest = measure_rest(motion.feet, placed[static_cast<std::size_t>(hips)].position.y);
    sample_feet(check, placed, motion);
    motion.treadmill = treadmill_of(motion, check.report.rate);
    for (Foot& foot : motion.feet) {
        measure_speed(foot, motion.treadmill, check.report.rate);
        measure_heights(foot);
    }
    motion.always_slides = !find_still(motion.feet, still_speed);
    if (motion.always_slides) find_still(motion.feet, sliding_speed);
    motion.has_soles = rest.is_level && stands_as_it_rests(motion.feet, rest.is_ground, check.report.rate);
    motion.rests_on_ground = rest.is_ground && motion.has_soles;
    if (!motion.has_soles) {
        learn_soles(motion.feet);
        for (Foot& foot : motion.feet) measure_heights(foot);
    }
    motion.floor = floor_of(motion, check.report.rate);
    return motion;
}

}  // namespace tendril::humanoid::lint_detail
