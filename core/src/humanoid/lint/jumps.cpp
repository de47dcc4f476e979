// Joints that depart for a few frames or jump for good, and knees that snap.
#include <algorithm>

#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

double apart(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return length(minus(a, b));
}
glm::dvec3 middle(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return times(plus(a, b), 0.5);
}

/// A list of moves, with the first and the last one repeated beyond the ends.
class Moves {
  public:
    explicit Moves(const std::vector<glm::dvec3>& moves) : moves_(moves) {}
    const glm::dvec3& operator[](std::ptrdiff_t i) const noexcept {
        return moves_[static_cast<std::size_t>(inside(i))];
    }
    std::ptrdiff_t inside(std::ptrdiff_t i) const noexcept {
        return std::clamp(i, std::ptrdiff_t{1}, static_cast<std::ptrdiff_t>(moves_.size()) - 1);
    }

  private:
    const std::vector<glm::dvec3>& moves_;
};

/// Size of the departure of frames i to i + held - 1 from the frames around them; 0 if they do not depart.
/// They depart if shifting them back leaves a smooth motion: a cubic through the two frames before and the
/// two after meets each frame. So a fast motion, which turns by tens of degrees a frame and changes as fast,
/// is not a departure and hides none.
double spike(const Moves& moves, std::ptrdiff_t i, std::ptrdiff_t held, double minimum) {
    constexpr double min_ratio = 8.0;
    const auto frames = static_cast<double>(held);
    const glm::dvec3 trend = times(minus(moves[i - 1], moves[i + held + 1]), frames / (frames + 2.0));
    const glm::dvec3 departure = times(minus(minus(moves[i], moves[i + held]), trend), 0.5);
    const double size = length(departure);
    if (size <= minimum) return 0.0;
    const auto shifted = [&](std::ptrdiff_t k) {
        k = moves.inside(k);
        return k == i ? minus(moves[k], departure) : k == i + held ? plus(moves[k], departure) : moves[k];
    };
    for (std::ptrdiff_t k = i - 2; k <= i + held + 1; ++k) {
        const glm::dvec3 inner = minus(shifted(k + 1), shifted(k)),
                         outer = minus(shifted(k + 2), shifted(k - 1));
        if (size <= min_ratio / 6.0 * length(minus(outer, times(inner, 3.0)))) return 0.0;
    }
    return size;
}

/// Size of the motion's jump at frame i if it does not come back; otherwise 0.
double step(const Moves& moves, std::ptrdiff_t i, double minimum) {
    constexpr double min_ratio = 3.0;
    const glm::dvec3 &before = moves[i - 1], &after = moves[i + 1];
    const double size = apart(moves[i], middle(before, after));
    if (size <= minimum) return 0.0;
    const double change =
        std::max({apart(before, after), apart(before, moves[i - 2]), apart(after, moves[i + 2])});
    return size > min_ratio * change ? size : 0.0;
}

/// True if a track is to be judged. Steps are intended throughout a Step track, or (skip_steps) where two
/// keys are at one time, as in files whose curves are held and interpolated in turn.
template <class T>
bool is_checked(const Track<T>& track) {
    return track.times.size() > 2 && track.interpolation != Interpolation::Step;
}

/// Removes the steps from a track's moves: the motion continues there as in the frame before.
template <class T>
void skip_steps(const Check& check, const Track<T>& track, std::vector<glm::dvec3>& moves) {
    const double rate = check.report.rate, tolerance = 1e-3 / rate;
    for (std::size_t k = 1; k < track.times.size(); ++k) {
        if (track.times[k] - track.times[k - 1] > tolerance) continue;
        // The first frame at or after the second key; files round times.
        const double frame = std::ceil(track.times[k] * rate - 2e-3) - static_cast<double>(check.begin);
        for (const double each : {frame, frame + 1.0}) {
            if (!(each > 0.0 && each < static_cast<double>(moves.size()))) continue;
            const auto i = static_cast<std::size_t>(each);
            if (check.time_of(i) > track.times[k - 1] && check.time_of(i - 1) < track.times[k])
                moves[i] = i > 1 ? moves[i - 1] : glm::dvec3(0.0);
        }
    }
}

/// `unit`: size of the track's unit, in metres or degrees.
template <class T, class Member>
void check_track(Check& check, const Channel& channel, const Track<T>& track, Member member, double unit,
                 double minimum, bool turns) {
    if (!is_checked(track)) return;
    rig::Transform last, next;
    std::vector<glm::dvec3> moves(check.report.frames, glm::dvec3(0.0));
    for (std::size_t i = 0; i < moves.size(); ++i) {
        sample(channel, check.time_of(i), next);
        if (i > 0) moves[i] = times(step_between(last.*member, next.*member), unit);
        last = next;
    }
    skip_steps(check, track, moves);
    const auto node = static_cast<std::int32_t>(channel.node);
    const bool is_knee =
        turns && (node == check.map[Bone::LeftLowerLeg].node || node == check.map[Bone::RightLowerLeg].node);
    if (is_knee) return;  // check_knees() judges them
    for (const Outlier& each : outliers(moves, minimum)) {
        const double amount = turns ? each.amount : 1000.0 * each.amount;
        const bool returns = each.until < check.report.frames;
        std::string text = returns ? "jumps out and back by " : "jumps by ";
        text += shown(amount) + (turns ? " degrees" : " mm");
        Finding& finding =
            check.add(Fault::Jump, node, each.frame, each.frame, returns ? each.until - 1 : each.frame,
                      amount, turns ? "deg" : "mm", text);
        finding.has_cure = true;
        finding.goes_on = !returns;
    }
}

struct Leg {
    Bone upper, lower, foot;
};
constexpr Leg legs[]{{Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot},
                     {Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot}};

/// Null if the clip does not turn the node.
const Track<glm::dquat>* rotation_of(const Clip& clip, std::int32_t node) noexcept {
    for (const Channel& channel : clip.channels)
        if (static_cast<std::int32_t>(channel.node) == node && !channel.rotation.times.empty())
            return &channel.rotation;
    return nullptr;
}

/// The knee's bend in degrees; 0: straight.
double bend_of(const Check& check, const Leg& leg, const std::vector<Placement>& placed) {
    const auto at = [&](Bone bone) {
        return placed[static_cast<std::size_t>(check.map[bone].node)].position;
    };
    const glm::dvec3 thigh = minus(at(leg.lower), at(leg.upper)), shin = minus(at(leg.foot), at(leg.lower));
    return arctangent(length(cross(thigh, shin)), dot(thigh, shin)) * degrees;
}

/// Finds legs that snap straight within a frame and stay straight, or the reverse: the knee accelerates
/// towards straight and stops at once.
void check_snaps(Check& check, std::int32_t node, const std::vector<double>& bends) {
    const double minimum = check.settings.knee * fps_scale(check.report.rate);
    const auto snap = [&](double from, double before, double straight, double after) {
        const double last = from - before, now = before - straight, next = std::abs(straight - after);
        return straight < 4.0 && now > minimum && now > 1.5 * std::abs(last) && last > -0.25 * now &&
               next < 0.25 * now;
    };
    for (std::size_t i = 2; i + 2 < bends.size(); ++i) {
        const bool in = snap(bends[i - 2], bends[i - 1], bends[i], bends[i + 1]);
        const bool out = snap(bends[i + 2], bends[i + 1], bends[i], bends[i - 1]);
        if (!in && !out) continue;
        const double amount = std::abs(bends[in ? i - 1 : i + 1] - bends[i]);
        Finding& finding = check.add(Fault::KneePop, node, i, i, i, amount, "deg",
                                     "snaps " + std::string(in ? "straight" : "out of straight") + " by " +
                                         shown(amount) + " degrees: the leg is too short for the foot there");
        finding.has_cure = finding.snaps = true;
    }
}

}  // namespace

glm::dvec3 step_between(const glm::dvec3& from, const glm::dvec3& to) noexcept {
    return minus(to, from);
}

glm::dvec3 step_between(const glm::dquat& from, const glm::dquat& to) noexcept {
    glm::dquat turn = math::compose(to, conjugate(from));
    if (turn.w < 0.0) turn = -turn;
    const glm::dvec3 axis{turn.x, turn.y, turn.z};
    const double size = length(axis);
    if (!(size > 1e-12)) return glm::dvec3(0.0);
    return times(axis, 2.0 * arctangent(size, turn.w) * degrees / size);
}

std::vector<Outlier> outliers(const std::vector<glm::dvec3>& list, double minimum) {
    std::vector<Outlier> found;
    const auto count = static_cast<std::ptrdiff_t>(list.size());
    if (count < 6) return found;
    const Moves moves(list);
    for (std::ptrdiff_t i = 1; i < count; ++i) {
        // Check departures of one to three frames first: they would also look like two jumps.
        double amount = 0.0;
        std::ptrdiff_t until = count;
        for (std::ptrdiff_t held = 1; held <= 3 && amount == 0.0 && i + held < count; ++held) {
            amount = spike(moves, i, held, minimum);
            if (amount > 0.0) until = i + held;
        }
        if (amount == 0.0) amount = step(moves, i, minimum);
        if (amount == 0.0) continue;
        found.push_back({static_cast<std::size_t>(i), static_cast<std::size_t>(until), amount});
        if (until < count) i = until;
    }
    return found;
}

void check_jumps(Check& check) {
    const double turn = check.settings.turn * fps_scale(check.report.rate);
    const double shift = std::max(check.settings.shift * check.height, 1e-6);
    std::vector<Placement> rest(check.skeleton.size());
    place(check.skeleton, rest_pose(check.skeleton), rest);
    for (const Channel& channel : check.clip.channels) {
        const std::int32_t above = check.skeleton[channel.node].key_parent();
        const double metres = above < 0 ? 1.0 : length(rest[static_cast<std::size_t>(above)].axes[0]);
        check_track(check, channel, channel.rotation, &rig::Transform::rotation, 1.0, turn, true);
        check_track(check, channel, channel.translation, &rig::Transform::translation, metres, shift, false);
    }
}

void check_knees(Check& check) {
    std::vector<rig::Transform> pose(check.skeleton.size());
    std::vector<Placement> placed(check.skeleton.size());
    const auto has = [&](Bone bone) { return check.map[bone].node >= 0; };
    for (const Leg& leg : legs) {
        if (!has(leg.upper) || !has(leg.lower) || !has(leg.foot)) continue;
        const Track<glm::dquat>* const keys = rotation_of(check.clip, check.map[leg.lower].node);
        if (keys && keys->interpolation == Interpolation::Step) continue;
        std::vector<double> bends;
        for (std::size_t i = 0; i < check.report.frames; ++i) {
            sample(check.clip, check.skeleton, check.time_of(i), pose);
            place(check.skeleton, pose, placed);
            bends.push_back(bend_of(check, leg, placed));
        }
        std::vector<glm::dvec3> moves(bends.size(), glm::dvec3(0.0));
        for (std::size_t i = 1; i < moves.size(); ++i) moves[i].x = bends[i] - bends[i - 1];
        if (keys) skip_steps(check, *keys, moves);
        const std::int32_t node = check.map[leg.lower].node;
        const std::vector<Outlier> pops = outliers(moves, check.settings.knee * fps_scale(check.report.rate));
        for (const Outlier& each : pops) {
            const bool returns = each.until < check.report.frames;
            Finding& finding =
                check.add(Fault::KneePop, node, each.frame, each.frame, returns ? each.until - 1 : each.frame,
                          each.amount, "deg", "pops by " + shown(each.amount) + " degrees");
            finding.has_cure = true;
            finding.goes_on = !returns;
        }
        if (pops.empty()) check_snaps(check, node, bends);
    }
}

}  // namespace tendril::humanoid::lint_detail
