#include "humanoid/body_solve.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "humanoid/input.hpp"
#include "humanoid/joint_turn.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

namespace {

/// Of feet that stay, against targets of weight 1.
constexpr double stay_weight = 3e1;
/// Radians that joints turn back towards the clip's pose in all, for a metre that a target is away when a
/// solve begins: a pose that could be nearer to the clip's comes nearer while its targets move, and not at
/// once.
constexpr double back_per_metre = 3.0;
/// Metres that a joint moves in a solve, at most, for a metre that a target has moved since the last one; and
/// what of it is left for the next one, which may have to catch up.
constexpr double joints_per_target = 12.0, pace_kept = 0.5;
/// What is left in the next solve of the way that a contact moved a limb without a target.
constexpr double comes_back = 0.7;
constexpr double max_pace = 3.0;  ///< metres
/// Metres. How far a step of least squares holds good is about what is left of the way times this.
constexpr double lever = 0.5;
constexpr double largest_turn = 0.5;  ///< radians that a joint turns in a step

/// A bone's rotation as its target wants it, as far as its weight goes.
glm::dquat wanted_rotation(const Link& link, const BodyTarget& target) noexcept {
    const glm::dquat whole = math::compose(rig::normalised(*target.rotation), conjugate(link.rest));
    return rig::blend(link.rotation, whole, target.weight);
}

}  // namespace

BodySolve::BodySolve(Body::Work& work, std::span<const BodyTarget> targets,
                     const BodyOptions& options) noexcept
    : work_(work),
      targets_(targets),
      options_(options),
      touches_(options.self_collision && !work.pairs.empty()) {}

std::optional<BodyReport> BodySolve::run(std::span<rig::Transform> pose, BodyState& state) noexcept {
    start(pose, state);
    BodyReport result;
    result.settled = false;
    double cost = measure(), caution = 0.25, part_back = 0.5;
    const double moved = goals_moved(state);
    double budget = back_per_metre * moved;
    for (std::size_t k = 0; k < count_; ++k) goals_[k].stuck = state.left[goals_[k].effector];
    const double pace = std::min(std::max(joints_per_target * moved, pace_kept * state.pace), max_pace);
    while (result.iterations < options_.max_iterations) {
        ++result.iterations;
        const double damping = std::max(caution * lever * std::sqrt(2.0 * cost), 1e-8);
        find_step(damping, part_back * std::min(1.0, 1e-3 / damping), budget);
        const double size = step_size();
        if (size < options_.tolerance) {
            result.settled = true;
            break;
        }
        keep();
        std::array<double, effector_count> residuals{};
        for (std::size_t k = 0; k < count_; ++k) residuals[k] = length(goals_[k].left);
        const double part = std::min(1.0, largest_turn / size), before = farthest();
        apply(part);
        const double next = measure();
        if (const double now = farthest(); now > pace) {
            slow_down(part * std::max(pace - before, 0.0) / (now - before), pace);
            break;
        }
        if (next <=
            cost + back_ * back_ * back_ * back_) {  // turns back along a curve lead off it by their squares
            result.settled = next > 1e-6 && std::abs(cost - next) < 1e-5 * cost;
            cost = next;
            budget = std::max(budget - part * back_, 0.0);
            caution = std::max(caution * 0.5, 0.01);
            part_back = std::min(part_back * 2.0, 0.5);
            for (std::size_t k = 0; k < count_; ++k) {
                Goal& goal = goals_[k];
                const double now = length(goal.left), was = residuals[k];
                goal.stuck = times(goal.left, was > now ? now / was : 1.0);
            }
            if (result.settled) break;
        } else {
            put_back();
            cost = measure();
            caution = std::min(caution * 8.0, 1e6);
            part_back *= 0.5;
        }
    }
    const double depth = deepest();
    std::array<glm::dquat, bone_count> turns;
    for (std::size_t i = 0; i < work_.links.size(); ++i)
        turns[i] = rig::normalised(math::compose(work_.links[i].turn, conjugate(work_.links[i].own)));
    turn_ends();
    if (!give(pose)) return std::nullopt;
    report(pose, result);
    state.pace = pace;
    state.left.fill(glm::dvec3(0.0));
    state.weights.fill(0.0);
    state.clip = clip_;
    state.deepest = depth;
    for (std::size_t k = 0; k < count_; ++k) {
        state.left[goals_[k].effector] = goals_[k].left;
        if (goals_[k].target) state.weights[goals_[k].effector] = goals_[k].weight;
    }
    state.turns.resize(work_.links.size());
    std::copy_n(turns.begin(), work_.links.size(), state.turns.begin());
    state.shift = shift_;
    return result;
}

/// Puts what was found into the pose; false, and nothing is changed, where that is no pose: of lengths near
/// the largest or smallest double, no number remains.
bool BodySolve::give(std::span<rig::Transform> pose) noexcept {
    std::array<rig::Transform, bone_count> before;
    for (std::size_t i = 0; i < work_.links.size(); ++i) before[i] = pose[work_.links[i].node];
    work_.give(pose, shift_);
    bool is_sound = is_within(shift_);
    for (std::size_t k = 0; k < count_; ++k) is_sound = is_sound && is_within(goals_[k].left);
    for (const Link& link : work_.links) is_sound = is_sound && is_sane(pose[link.node]);
    if (!is_sound)
        for (std::size_t i = 0; i < work_.links.size(); ++i) pose[work_.links[i].node] = before[i];
    return is_sound;
}

/// Takes the step back, and what of it the pace allows.
void BodySolve::slow_down(double part, double pace) noexcept {
    for (int i = 0; i < 4; ++i, part *= 0.5) {
        put_back();
        apply(part);
        measure();
        if (farthest() <= 1.1 * pace) return;
    }
    put_back();
    measure();
}

double BodySolve::goals_moved(const BodyState& state) const noexcept {
    double most = std::max(deepest() - state.deepest, options_.settle), far = 0.0, change = 0.0;
    std::array<double, effector_count> weights{};
    for (std::size_t k = 0; k < count_; ++k) {
        const Goal& goal = goals_[k];
        most = std::max(most, length(minus(goal.left, state.left[goal.effector])));
        far = std::max(far, length(goal.left));
        if (goal.target) weights[goal.effector] = goal.weight;
    }
    for (std::size_t e = 0; e < effector_count; ++e) {
        const double before = state.weights[e], now = weights[e];
        if (before > 0.0) change = std::max(change, std::abs(now - before) / std::max(now, before));
    }
    most = std::max(most, change * far);  // of targets that disagree, others come nearer now
    if (state.turns.empty()) return most;
    for (std::size_t e = 0; e < effector_count; ++e)
        most = std::max(most, length(minus(clip_[e], state.clip[e])));
    return most;
}

double BodySolve::farthest() const noexcept {
    double most = 0.0;
    for (std::size_t i = 0; i < work_.links.size(); ++i)
        most = std::max(most, length(minus(work_.links[i].position, work_.first[i])));
    for (std::size_t i = 0; i < work_.tips.size(); ++i)
        most =
            std::max(most, length(minus(work_.place_of(work_.tips[i]), work_.first[work_.links.size() + i])));
    return most;
}

void BodySolve::set_goals() noexcept {
    const auto add = [&](Effector effector, const glm::dvec3& position, double weight,
                         const BodyTarget* target) {
        const auto index = static_cast<std::size_t>(effector);
        const BodyLimb* limb = nullptr;
        for (const BodyLimb& each : work_.limbs)
            if (each.end == work_.ends[index]) limb = &each;
        goals_[count_++] = {index, position, weight, target, limb};
    };
    unsigned seen = 0;
    for (const BodyTarget& target : targets_) {
        if (!(target.weight > 0.0)) continue;
        add(target.effector, target.position, target.weight, &target);
        seen |= 1u << static_cast<unsigned>(target.effector);
    }
    for (const Effector foot : {Effector::LeftFoot, Effector::RightFoot}) {
        if (!options_.feet_stay || (seen >> static_cast<unsigned>(foot) & 1u)) continue;
        const Link& link = end_of(static_cast<std::size_t>(foot));
        add(foot, work_.placements[link.node].position, stay_weight, nullptr);
    }
}

void BodySolve::start(std::span<const rig::Transform> pose, const BodyState& state) noexcept {
    work_.take(pose);
    for (std::size_t e = 0; e < effector_count; ++e) clip_[e] = work_.placements[end_of(e).node].position;
    set_goals();
    for (Link& link : work_.links) {
        link.turn = link.own;
        link.limit = link.given;
        widen(link);
    }
    shift_ = glm::dvec3(0.0);
    measure();
    for (BodyLimb& limb : work_.limbs) limb.start = limb.beyond(limb.bend);
    if (!state.turns.empty()) shift_ = state.shift;
    unsigned wanted = 0;
    for (std::size_t k = 0; k < count_; ++k) wanted |= 1u << goals_[k].effector;
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        Link& link = work_.links[i];
        // A limb that nothing asks for keeps the clip's pose; one that a contact may have moved comes back to
        // it, and the trunk does as far as targets move.
        if (state.turns.empty()) continue;
        const glm::dquat last = math::compose(state.turns[i], link.own);
        if ((link.effectors & wanted) != 0)
            link.turn = last;
        else if (touches_)
            link.turn = rig::blend(link.own, last, comes_back);
        else if (std::popcount(link.effectors) > 1)
            link.turn = last;
        clamp_turn(link);
    }
    for (std::size_t k = 0; k < count_; ++k) {
        if (goals_[k].effector != static_cast<std::size_t>(Effector::Hips) || !goals_[k].target->rotation)
            continue;
        hips_given_ = true;
        work_.links.front().turn = wanted_rotation(work_.links.front(), *goals_[k].target);
    }
    work_.place_links(shift_);
    for (std::size_t i = 0; i < work_.links.size(); ++i) work_.first[i] = work_.links[i].position;
    for (std::size_t i = 0; i < work_.tips.size(); ++i)
        work_.first[work_.links.size() + i] = work_.place_of(work_.tips[i]);
}

double BodySolve::measure() noexcept {
    work_.place_links(shift_);
    for (BodyLimb& limb : work_.limbs) {
        const Link& upper = work_.links[static_cast<std::size_t>(limb.upper)];
        const Link& lower = work_.links[static_cast<std::size_t>(limb.lower)];
        const Link& end = work_.links[static_cast<std::size_t>(limb.end)];
        const glm::dvec3 first = minus(lower.position, upper.position),
                         second = minus(end.position, lower.position);
        limb.along = direction_of(minus(end.position, upper.position), 1e-9).value_or(glm::dvec3(0.0));
        limb.about = rotated(upper.rotation, limb.axis);
        limb.bend = arctangent(dot(limb.about, cross(first, second)), dot(first, second));
    }
    double cost = 0.0;
    for (std::size_t k = 0; k < count_; ++k) {
        Goal& goal = goals_[k];
        goal.left = minus(goal.position, end_of(goal.effector).position);
        if (goal.limb) {
            const double off = goal.limb->beyond(goal.limb->bend) - goal.limb->start;
            goal.left = plus(goal.left, times(goal.limb->along, off));
        }
        cost += 0.5 * goal.weight * dot(goal.left, goal.left);
    }
    find_contacts();
    return cost + contact_cost();
}

/// Hands, feet and head take their targets' rotations; feet without one keep the clip's.
void BodySolve::turn_ends() noexcept {
    work_.place_links(shift_);
    for (std::size_t k = 0; k < count_; ++k) {
        const bool foot = goals_[k].effector == static_cast<std::size_t>(Effector::LeftFoot) ||
                          goals_[k].effector == static_cast<std::size_t>(Effector::RightFoot);
        if (foot || goals_[k].target->rotation) turn_end(goals_[k]);
    }
    work_.place_links(shift_);
}

void BodySolve::turn_end(const Goal& goal) noexcept {
    Link& link = end_of(goal.effector);
    if (link.parent < 0) return;
    Link& before = work_.links[static_cast<std::size_t>(link.parent)];
    glm::dquat wanted = link.start;
    if (goal.target && goal.target->rotation) wanted = wanted_rotation(link, *goal.target);
    link.turn = math::compose(conjugate(before.rotation), wanted);
    if (goal.effector == static_cast<std::size_t>(Effector::LeftHand) ||
        goal.effector == static_cast<std::size_t>(Effector::RightHand)) {
        // Part of the twist about the forearm goes to the forearm, which moves no joint.
        if (const auto along = direction_of(link.offset, 1e-9)) {
            const double twist =
                options_.twist_share * (hinge_angle(*along, link.turn) - hinge_angle(*along, link.own));
            before.turn = math::compose(before.turn, rotation_about(*along, twist));
            link.turn = math::compose(rotation_about(*along, -twist), link.turn);
        }
    }
    if (clamp_turn(link)) steps_[static_cast<std::size_t>(work_.ends[goal.effector])].blocked = 1;
}

void BodySolve::report(std::span<const rig::Transform> pose, BodyReport& report) noexcept {
    work_.place_needed(pose);
    for (std::size_t k = 0; k < count_; ++k) {
        const Goal& goal = goals_[k];
        if (!goal.target) continue;
        const Link& link = end_of(goal.effector);
        const double left = length(minus(goal.position, work_.placements[link.node].position));
        report.residuals[goal.effector] = left;
        report.residual = std::max(report.residual, left);
    }
    report.penetration = deepest();
    for (std::size_t i = 0; i < work_.links.size(); ++i)
        if (steps_[i].blocked > 0) report.at_limit[static_cast<std::size_t>(work_.links[i].bone)] = true;
}

}  // namespace tendril::humanoid::detail
