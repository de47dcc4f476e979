// The legs' part of a step: lowering the hips, the speed limits, and the pose.
#include <algorithm>
#include <cmath>

#include "humanoid/feet_step.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

namespace {

/// A foot's goal that moves faster than this fraction of max_speed is treated as a jump of the ground.
constexpr double max_step_part = 0.6;
/// Fraction of max_speed at which a foot catches up with a goal that itself rises along a slope.
constexpr double catch_up_part = 0.3;
/// Fraction of max_speed at which the hips are lowered for a foot that comes down.
constexpr double landing = 0.15;
/// Maximum speed, relative to the clip, of a foot that moves up and sideways at once; in max_speed.
constexpr double diagonal = 1.25;
/// A foot shifted away from an edge stands once at most this much of the shift remains, metres.
constexpr double shift_tolerance = 0.001;
/// A leg in the air straightens in a step by at most this part of what is left: the bend of a nearly straight
/// knee changes fast.
constexpr double straighten_part = 0.6;

/// Knees bend forwards.
Pole pole_of(const glm::dvec3& forward) noexcept {
    return {.direction = forward, .part = 0.1, .always = true};
}

/// The largest fraction, 0 to 1, that `allowed` accepts, by bisection.
template <class Allowed>
double max_part(const Allowed& allowed) noexcept {
    if (allowed(1.0)) return 1.0;
    double part = 0.0;
    for (double step = 0.5; step > 0.01; step *= 0.5)
        if (allowed(part + step)) part += step;
    return part;
}

}  // namespace

/// Distance by which the hips must be lowered for the leg to reach; negative if the leg has length to spare.
double FeetStep::shortfall(std::size_t i, double lift) const noexcept {
    return shortfall(i, lift, reach_of(legs_[i], options_.straightest).longest);
}
double FeetStep::shortfall(std::size_t i, double lift, double longest) const noexcept {
    const LimbPlacement& leg = legs_[i];
    const glm::dvec3 way = minus(plus(leg.end.position, goals_[i].slip), leg.upper.position);
    const double level = way.x * way.x + way.z * way.z;
    return state_.base - lift - way.y - std::sqrt(std::max(0.0, longest * longest - level));
}

/// Maximum change of the lift in this step; smaller for a foot whose offset moves fast.
double FeetStep::lift_limit(std::size_t i) const noexcept {
    const double most = options_.max_speed * dt_, together = diagonal * most, level = goals_[i].shifted;
    return std::min(most, std::sqrt(std::max(0.0, together * together - level * level)));
}

/// The lift follows its goal; a jump of the goal eases in. Rising along a slope is not a jump, however steep.
void FeetStep::ease_lift(std::size_t i, double goal, double rise) const noexcept {
    FootState& foot = state_.feet[i];
    const double most = options_.max_speed * dt_, change = goal - foot.goal, before = foot.lift;
    foot.goal = goal;
    if (first_step_) {
        foot.lift = goal;
        foot.ease = {.started = true};
        return;
    }
    if (!(dt_ > 0.0)) {
        foot.goal = goal - change;
        return;
    }
    if (std::abs(change - rise) > max_step_part * most) foot.ease.value -= change - rise;
    // Ease faster upwards: the edge to clear may be near.
    const double half_life = options_.lift_half_life * (foot.ease.value < 0.0 ? 0.85 : 1.0);
    const double sprung = step_spring(foot.ease, half_life, 0.0, dt_);
    const double limit = std::max(lift_limit(i), std::abs(rise) + catch_up_part * most);
    foot.lift = move_toward(before, goal + sprung, limit);
    if (foot.lift != goal + sprung) set(foot.ease, sprung, foot.lift - goal, 0.0);
    if (std::abs(foot.ease.value) < 1e-9) {
        foot.ease.value = 0.0;
        foot.lift = goal;
    }
}

void FeetStep::lower_pelvis() noexcept {
    const double most = options_.max_speed * dt_;
    double needed = 0.0, at_once = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const FootState& foot = state_.feet[i];
        if (foot.alone != FootAlone::No) continue;
        const double by = std::min(shortfall(i, foot.lift), options_.pelvis_drop);
        needed = std::max(needed, by);
        if (foot.locked)
            at_once = std::max(at_once, is_standing(i) ? by : std::min(by, state_.drop + landing * most));
    }
    const double before = state_.drop;
    if (first_step_) {
        state_.drop = needed;
        state_.pelvis = {.value = needed, .previous_target = needed, .started = true};
    } else if (dt_ > 0.0) {
        const double sprung = step_spring(state_.pelvis, options_.pelvis_half_life, needed, dt_);
        state_.drop = move_toward(before, std::max(sprung, at_once), most);
        state_.drop = std::min(state_.drop, options_.pelvis_drop);
        if (state_.drop != sprung) set(state_.pelvis, before, state_.drop, dt_);
        if (needed == 0.0 && state_.drop < 1e-9) state_.drop = 0.0;
    }
}

glm::dvec3 FeetStep::target(std::size_t i, double lift) const noexcept {
    const glm::dvec3& slip = goals_[i].slip;
    return plus(clips_[i].ankle, {slip.x, lift, slip.z});
}

/// The knee's speed relative to the clip, as a fraction of max_speed, if the hips are raised by `raise` and
/// the ankle by `lift`.
double FeetStep::knee_speed(std::size_t i, double raise, double lift) const noexcept {
    const glm::dvec3 on_hips = target(i, lift - raise);
    const glm::dvec3 knee = detail::bend_to(legs_[i], on_hips, pole_of(poles_[i]), options_.straightest).mid;
    const glm::dvec3 correction = plus(minus(knee, knees_[i]), {0.0, raise, 0.0});
    return length(minus(correction, state_.feet[i].knee)) / (options_.max_speed * dt_);
}

/// The knee of a nearly straight leg moves several times as far as the leg's ends. While the foot stands, the
/// hips move only as far as the knee's speed allows, but at least as far as the leg needs.
void FeetStep::limit_standing_knees() noexcept {
    if (first_step_ || !(dt_ > 0.0)) return;
    const double from = last_raise_, way = state_.base - state_.drop - from;
    const double part = max_part([&](double some) {
        for (std::size_t i = 0; i < 2; ++i)
            if (is_standing(i) && knee_speed(i, from + way * some, state_.feet[i].lift) > 1.0) return false;
        return true;
    });
    if (part == 1.0) return;
    double raise = from + way * part;
    for (std::size_t i = 0; i < 2; ++i)
        if (is_standing(i))
            raise = std::min(raise,
                             state_.base - std::min(shortfall(i, state_.feet[i].lift), options_.pelvis_drop));
    const double drop = std::clamp(state_.base - raise, 0.0, options_.pelvis_drop);
    set(state_.pelvis, state_.drop, drop, 0.0);
    state_.drop = drop;
}

/// A foot whose leg cannot reach down, or not yet, stays above its place instead of moving beside it.
void FeetStep::stay_above(std::size_t i) noexcept {
    FootState& foot = state_.feet[i];
    if (first_step_ || is_standing(i) || !(dt_ > 0.0)) return;
    const double raise = state_.base - state_.drop,
                 longest = reach_of(legs_[i], options_.straightest).longest,
                 before = length(minus(target(i, lifts_[i] - raise), legs_[i].upper.position));
    const double short_by =
        shortfall(i, foot.lift, before + straighten_part * std::max(0.0, longest - before)) - state_.drop;
    if (!(short_by > 0.0)) return;
    foot.lift = move_toward(lifts_[i], foot.lift + short_by, lift_limit(i));
    foot.ease.value = foot.lift - foot.goal;
}

/// A foot in the air moves only as far as the knee's speed allows.
void FeetStep::limit_knee(std::size_t i, double raise) noexcept {
    FootState& foot = state_.feet[i];
    if (first_step_ || is_standing(i) || !(dt_ > 0.0)) return;
    const double from = lifts_[i], way = foot.lift - from;
    // The knee of a foot that rises along a slope rises with it.
    const double fastest = 1.0 + std::max(0.0, goals_[i].rise) / (options_.max_speed * dt_);
    const double part =
        max_part([&](double some) { return knee_speed(i, raise, from + way * some) <= fastest; });
    if (part == 1.0) return;
    foot.lift = from + way * part;
    if (part == 0.0) {
        // The clip itself moves the leg too fast: use the lift with the slowest knee.
        const double most = lift_limit(i);
        double least = knee_speed(i, raise, from);
        for (const double by : {0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1.0, -1.0}) {
            if (least <= fastest) break;
            const double speed = knee_speed(i, raise, from + most * by);
            if (speed >= least) continue;
            least = speed;
            foot.lift = from + most * by;
        }
    }
    foot.ease.value = foot.lift - foot.goal;
}

void FeetStep::move() noexcept {
    const double raise = state_.base - state_.drop;
    for (std::size_t i = 0; i < 2; ++i) {
        if (state_.feet[i].alone != FootAlone::No)
            ease_lift(i, raise, 0.0);
        else
            stay_above(i);
        limit_knee(i, raise);
    }
    if (raise != 0.0) {
        const glm::dvec3 by = to_local(above_hips_, {0.0, raise, 0.0});
        pose_[plan_.hips].translation = plus(pose_[plan_.hips].translation, by);
        for (LimbPlacement& leg : legs_) leg.move({0.0, raise, 0.0});
    }
    for (std::size_t i = 0; i < 2; ++i) {
        FootState& foot = state_.feet[i];
        if (!(foot.lift == raise && goals_[i].slip == glm::dvec3(0.0) &&
              foot.turn == glm::dquat{1.0, 0.0, 0.0, 0.0})) {
            const glm::dvec3 ankle = target(i, foot.lift);
            const Bend bend = detail::bend_to(legs_[i], ankle, pole_of(poles_[i]), options_.straightest);
            apply(bend, foot.turn, plan_.legs[i], legs_[i], pose_);
            shortfalls_[i] = length(minus(legs_[i].end.position, ankle));
        }
        foot.standing = foot.locked && std::abs(foot.lift - goals_[i].contact) + shortfalls_[i] <= max_gap &&
                        std::abs(foot.shift_x) + std::abs(foot.shift_z) <= shift_tolerance;
        foot.knee = minus(legs_[i].lower.position, knees_[i]);
        foot.heel = clips_[i].heel;
        foot.toe = clips_[i].toe;
    }
    state_.hips = hips_.position;
    state_.started = true;
}

}  // namespace tendril::humanoid::detail
