// Feet that slide while they stand, or stand above or below the floor.
#include "humanoid/lint/feet.hpp"

#include <algorithm>

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

// A stance begins below the speed `enter_speed`, ends above `leave_speed`, and stays lower than `low`. A
// standing foot that slips briefly without being lifted has not taken a step.
constexpr double enter_speed = 0.6, leave_speed = 1.2, low = 0.03;  // m/s, m
constexpr double max_lift = 0.025, min_step_time = 0.1;             // m, s
constexpr double landing_time = 0.05;                               // s

/// A stance without its landing and lift-off: from the first to the last still frame. A foot that is never
/// still slides throughout; then a fixed time is cut from both ends.
FrameRange without_ends(const FrameRange& stance, const Foot& foot, double rate) {
    FrameRange core = stance;
    while (core.first < core.last && !foot.still[core.first]) ++core.first;
    while (core.last > core.first && !foot.still[core.last]) --core.last;
    if (core.last > core.first) return core;
    const auto ends = static_cast<std::size_t>(std::ceil(landing_time * rate));
    if (stance.last - stance.first <= 2 * ends) return {stance.first, stance.first};
    return {stance.first + ends, stance.last - ends};
}

void check_skating(Check& check, const Foot& foot, const glm::dvec3& treadmill, double limit) {
    const double rate = check.report.rate;
    for (const FrameRange& stance : stances_of(foot, check.report.floor, rate)) {
        const auto [first, last] = without_ends(stance, foot, rate);
        if (static_cast<double>(last - first) < 0.08 * rate) continue;
        glm::dvec3 slid(0.0);
        double farthest = 0.0, fastest = 0.0;
        std::size_t worst = first;
        for (std::size_t i = first + 1; i <= last; ++i) {
            const glm::dvec3 move = smallest_move(foot, i, times(treadmill, 1.0 / rate));
            slid = plus(slid, move);
            if (foot.min_speed[i] > leave_speed) continue;  // a departure of one frame is a jump, not a slide
            farthest = std::max(farthest, level(slid));
            if (level(move) > fastest) fastest = level(move), worst = i;
        }
        check.report.skating = std::max(check.report.skating, farthest);
        if (farthest <= limit) continue;
        check.add(Fault::Skating, foot.node, worst, first, last, 1000.0 * farthest, "mm",
                  "slides " + shown(1000.0 * farthest) + " mm over the ground while planted");
    }
}

/// Runs of frames for which `is_wrong` is true, of at least `shortest` seconds.
template <class IsWrong>
std::vector<FrameRange> ranges(std::size_t frames, double rate, double shortest, IsWrong is_wrong) {
    std::vector<FrameRange> found;
    for (std::size_t i = 0; i < frames; ++i) {
        if (!is_wrong(i)) continue;
        if (!found.empty() && found.back().last + 1 == i)
            found.back().last = i;
        else
            found.push_back({i, i});
    }
    std::erase_if(found, [&](const FrameRange& each) {
        return static_cast<double>(each.last - each.first + 1) < shortest * rate;
    });
    return found;
}

void check_floating(Check& check, const Foot& foot, double limit) {
    const double floor = check.report.floor, most = 0.08;
    // Without toes, a foot on tiptoe seems to float.
    const double tilt = foot.points.size() > 1 ? 20.0 : 8.0;
    for (const FrameRange& each :
         ranges(foot.height.size(), check.report.rate, min_stance, [&](std::size_t i) {
             const double above = foot.height[i] - floor;
             return foot.still[i] && foot.tilt[i] < tilt && above > limit && above < most;
         })) {
        std::size_t worst = each.first;
        for (std::size_t i = each.first; i <= each.last; ++i)
            if (foot.height[i] > foot.height[worst]) worst = i;
        const double amount = 1000.0 * (foot.height[worst] - floor);
        check.add(Fault::Floating, foot.node, worst, each.first, each.last, amount, "mm",
                  "stands still " + shown(amount) + " mm above the floor");
    }
}

void check_sinking(Check& check, const Foot& foot, double limit) {
    const double floor = check.report.floor, most = 0.12;
    for (const FrameRange& each : ranges(foot.height.size(), check.report.rate, 0.03, [&](std::size_t i) {
             // The height of a sole below its bones is known only for a level foot.
             const double below = floor - foot.height[i];
             return below > limit + (foot.tilt[i] > 30.0 ? 0.04 : 0.0);
         })) {
        std::size_t worst = each.first;
        for (std::size_t i = each.first; i <= each.last; ++i)
            if (foot.height[i] < foot.height[worst]) worst = i;
        const double amount = 1000.0 * (floor - foot.height[worst]);
        if (amount > 1000.0 * most) continue;  // on another floor: stairs, a pit
        check.add(Fault::Sinking, foot.node, worst, each.first, each.last, amount, "mm",
                  "is " + shown(amount) + " mm below the floor");
    }
}

}  // namespace

std::vector<FrameRange> stances_of(const Foot& foot, double floor, double rate) {
    std::vector<FrameRange> found;
    bool stands = false, stepped = false;
    double stood_at = floor;  // height when last still
    for (std::size_t i = 0; i < foot.height.size(); ++i) {
        const double height = foot.height[i];
        if (foot.still[i]) stood_at = height;
        // A moving foot that is lifted, even by 8 mm, takes a step.
        const bool steps = foot.speed[i] > 0.4 && height > stood_at + 0.008;
        stepped |= steps;
        stands = height - floor < low && !steps && foot.speed[i] < (stands ? leave_speed : enter_speed);
        if (!stands) continue;
        if (!found.empty()) {
            const std::size_t since = found.back().last;
            bool stayed_low = true;
            for (std::size_t k = since; k <= i; ++k) stayed_low &= foot.height[k] - floor < max_lift;
            if (i == since + 1 ||
                (!stepped && stayed_low && static_cast<double>(i - since) < min_step_time * rate)) {
                found.back().last = i;
                continue;
            }
        }
        stepped = false;
        found.push_back({i, i});
    }
    return found;
}

/// Covers the points in between too: the motion of a rigid foot is linear in the point.
glm::dvec3 smallest_move(const Foot& foot, std::size_t frame, const glm::dvec3& ground) {
    glm::dvec3 best(1e9);
    const auto consider = [&](const glm::dvec3& a, const glm::dvec3& b) {
        const glm::dvec3 line = minus(b, a);
        const double along = line.x * line.x + line.z * line.z;
        const double part = along > 0.0 ? std::clamp(-(a.x * line.x + a.z * line.z) / along, 0.0, 1.0) : 0.0;
        const glm::dvec3 move = plus(a, times(line, part));
        if (level(move) < level(best)) best = move;
    };
    for (std::size_t k = 0; k < foot.points.size(); ++k) {
        const auto move = [&](std::size_t point) {
            return minus(minus(foot.at(point, frame), foot.at(point, frame - 1)), ground);
        };
        consider(move(k), move(k + 1 < foot.points.size() ? k + 1 : k));
    }
    return best;
}

void check_feet(Check& check) {
    if (check.report.frames < 4) return;
    const FeetMotion motion = feet_motion(check);
    if (KnownFeet& known = check.report.feet; !known.are_known) {
        known = {.treadmill = motion.treadmill,
                 .are_known = true,
                 .always_slides = motion.always_slides,
                 .rests_on_ground = motion.rests_on_ground,
                 .has_soles = motion.has_soles,
                 .floor = motion.floor};
        for (const Foot& foot : motion.feet) known.feet.push_back({foot.node, foot.points, foot.flat});
    }
    check.report.treadmill = motion.treadmill;
    if (!motion.floor) return;
    check.report.has_floor = true;
    check.report.floor = *motion.floor;
    const double unknown = motion.has_soles ? 0.0 : 0.015;
    // For an in-place clip the ground's speed is an estimate, and real hips vary in speed within a step. If
    // no foot is ever still, the moment of landing is unknown.
    const double slide = std::max(check.settings.skating + unknown + (motion.always_slides ? 0.02 : 0.0),
                                  0.15 * level(motion.treadmill));
    for (const Foot& foot : motion.feet) {
        check_skating(check, foot, motion.treadmill, slide);
        check_floating(check, foot, check.settings.floating + unknown);
        check_sinking(check, foot, check.settings.sinking + unknown);
        if (!leg_of(check.skeleton, check.map, foot.node)) continue;
        for (Finding& each : check.report.findings)
            each.has_cure |=
                each.node == foot.node && (each.fault == Fault::Skating || each.fault == Fault::Floating ||
                                           each.fault == Fault::Sinking);
    }
}

}  // namespace tendril::humanoid::lint_detail
