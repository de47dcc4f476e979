#include "humanoid/body_solve.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "humanoid/body_tuning.hpp"
#include "humanoid/input.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

namespace {

/// The bone's rotation for a target, blended by the target's weight with the rotation without it.
glm::dquat target_rotation(const Link& link, const BodyTarget& target, const glm::dquat& without) noexcept {
    const glm::dquat whole = math::compose(rig::normalised(*target.rotation), conjugate(link.rest));
    return rig::blend(without, whole, target.weight);
}

}  // namespace

BodySolve::BodySolve(Body::Work& work, std::span<const BodyTarget> targets,
                     const BodyOptions& options) noexcept
    : work_(work),
      targets_(targets),
      options_(options),
      collides_(options.self_collision && !work.pairs.empty()) {}

std::optional<BodyReport> BodySolve::run(std::span<rig::Transform> pose, BodyState& state) noexcept {
    start(pose, state);
    BodyReport result;
    result.settled = false;
    double cost = measure();
    const double moved = goals_moved(state);
    TrustRegion trust;
    const double size = work_.size;
    Relaxation relaxation(moved / size);
    for (std::size_t k = 0; k < count_; ++k) goals_[k].stalled = state.left[goals_[k].effector];
    const double limit =
        std::min(std::max(travel_per_metre * moved, travel_kept * state.pace), max_travel * size);
    while (result.iterations < options_.max_iterations) {
        ++result.iterations;
        const double damping = trust.damping(std::sqrt(2.0 * cost) / size);
        find_step(damping, relaxation);
        const double step = step_size();
        if (step < options_.tolerance) {
            result.settled = true;
            break;
        }
        save_turns();
        std::array<double, effector_count> before{};
        for (std::size_t k = 0; k < count_; ++k) before[k] = length(goals_[k].error);
        const double part = std::min(1.0, max_step_turn / step), travelled = travel();
        apply(part);
        const double next = measure();
        // The turn back is exact only to first order, so it may cost as much as its square.
        if (next <= cost + size * size * relaxation_ * relaxation_ * relaxation_ * relaxation_) {
            if (const double now = travel(); now > limit) {
                cut_to(limit, part * std::max(limit - travelled, 0.0) / (now - travelled));
                break;
            }
            result.settled =
                next > min_stalled_cost * size * size && std::abs(cost - next) < stalled_share * cost;
            cost = next;
            trust.succeeded();
            relaxation.succeeded(part * relaxation_);
            for (std::size_t k = 0; k < count_; ++k) {
                Goal& goal = goals_[k];
                const double now = length(goal.error), was = before[k];
                goal.stalled = times(goal.error, was > now ? now / was : 1.0);
            }
            if (result.settled) break;
        } else {
            restore_turns();
            cost = measure();
            trust.failed();
            relaxation.failed();
        }
    }
    const double depth = deepest(), out = outside_;
    std::array<glm::dquat, bone_count> turns;
    for (std::size_t i = 0; i < work_.links.size(); ++i)
        turns[i] = rig::normalised(math::compose(work_.links[i].turn, conjugate(work_.links[i].clip_turn)));
    turn_ends();
    if (has_rotations()) find_contacts();  // for the report: hands and head have capsules
    if (!write_pose(pose)) return std::nullopt;
    report(pose, result);
    result.outside = out;
    state.pace = limit;
    state.left.fill(glm::dvec3(0.0));
    state.weights.fill(0.0);
    state.clip = clip_;
    state.deepest = depth;
    state.outside = out;
    for (std::size_t k = 0; k < count_; ++k) {
        state.left[goals_[k].effector] = goals_[k].error;
        if (goals_[k].target) state.weights[goals_[k].effector] = goals_[k].weight;
    }
    state.turns.resize(work_.links.size());
    std::copy_n(turns.begin(), work_.links.size(), state.turns.begin());
    state.shift = shift_;
    return result;
}

/// Writes the solution to the pose. Returns false and leaves the pose unchanged if it is not finite: bone
/// lengths near the largest or smallest double lose all their digits.
bool BodySolve::write_pose(std::span<rig::Transform> pose) noexcept {
    std::array<rig::Transform, bone_count> before;
    for (std::size_t i = 0; i < work_.links.size(); ++i) before[i] = pose[work_.links[i].node];
    work_.write_pose(pose, shift_);
    bool valid = is_within(shift_);
    for (std::size_t k = 0; k < count_; ++k) valid = valid && is_within(goals_[k].error);
    for (const Link& link : work_.links) valid = valid && is_sane(pose[link.node]);
    if (!valid)
        for (std::size_t i = 0; i < work_.links.size(); ++i) pose[work_.links[i].node] = before[i];
    return valid;
}

/// Cuts the last step down to the limit.
void BodySolve::cut_to(double limit, double part) noexcept {
    for (int i = 0; i < max_travel_cuts; ++i, part *= 0.5) {
        restore_turns();
        apply(part);
        measure();
        if (travel() <= travel_tolerance * limit) return;
    }
    restore_turns();
    measure();
}

double BodySolve::goals_moved(const BodyState& state) const noexcept {
    double largest = std::max({deepest() - state.deepest, outside_ - state.outside, options_.settle}),
           error = 0.0, change = 0.0;
    std::array<double, effector_count> weights{};
    for (std::size_t k = 0; k < count_; ++k) {
        const Goal& goal = goals_[k];
        largest = std::max(largest, length(minus(goal.error, state.left[goal.effector])));
        error = std::max(error, length(goal.error));
        if (goal.target) weights[goal.effector] = goal.weight;
    }
    for (std::size_t e = 0; e < effector_count; ++e) {
        const double before = state.weights[e], now = weights[e];
        if (before > 0.0) change = std::max(change, std::abs(now - before) / std::max(now, before));
    }
    largest = std::max(largest, change * error);  // conflicting targets now share the residual differently
    if (state.turns.empty()) return largest;
    for (std::size_t e = 0; e < effector_count; ++e)
        largest = std::max(largest, length(minus(clip_[e], state.clip[e])));
    return largest;
}

double BodySolve::travel() const noexcept {
    double largest = 0.0;
    for (std::size_t i = 0; i < work_.links.size(); ++i)
        largest = std::max(largest, length(minus(work_.links[i].position, work_.first[i])));
    for (std::size_t i = 0; i < work_.tips.size(); ++i)
        largest = std::max(largest,
                           length(minus(work_.place_of(work_.tips[i]), work_.first[work_.links.size() + i])));
    return largest;
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
    for (std::size_t e = 0; e < effector_count; ++e) {  // independent of the order of the targets
        const auto effector = static_cast<Effector>(e);
        const auto target = std::ranges::find(targets_, effector, &BodyTarget::effector);
        if (target != targets_.end() && target->weight > 0.0) {
            add(effector, target->position, target->weight, &*target);
        } else if (options_.feet_stay && effector >= Effector::LeftFoot) {
            const FootShift& shift = options_.feet[effector == Effector::LeftFoot ? 0 : 1];
            glm::dvec3 at = clip_[e];
            if (!(shift == FootShift())) at = plus(at, shift.stand), at.y += shift.lift;
            add(effector, at, planted_foot_weight, nullptr);
        }
    }
}

void BodySolve::start(std::span<const rig::Transform> pose, const BodyState& state) noexcept {
    work_.read_pose(pose);
    for (std::size_t e = 0; e < effector_count; ++e) clip_[e] = work_.placements[end_of(e).node].position;
    set_goals();
    for (Link& link : work_.links) {
        link.turn = link.clip_turn;
        link.limit = link.base_limit;
        widen(link);
    }
    shift_ = glm::dvec3(0.0);
    work_.place_links(shift_);
    start_balance();
    measure();
    for (BodyLimb& limb : work_.limbs) limb.start = limb.shortening(limb.bend);
    if (!state.turns.empty()) shift_ = state.shift;
    unsigned targeted = 0;
    for (std::size_t k = 0; k < count_; ++k) targeted |= 1u << goals_[k].effector;
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        Link& link = work_.links[i];
        // A limb without a goal takes the clip's pose, gradually if a contact may have moved it. The trunk
        // starts from the last solve and turns back as targets move.
        if (state.turns.empty()) continue;
        const glm::dquat last = math::compose(state.turns[i], link.clip_turn);
        if ((link.effectors & targeted) != 0)
            link.turn = last;
        else if (collides_)
            link.turn = rig::blend(link.clip_turn, last, deflection_kept);
        else if (std::popcount(link.effectors) > 1)
            link.turn = last;
        clamp_turn(link);
    }
    for (std::size_t k = 0; k < count_; ++k) {
        if (goals_[k].effector != static_cast<std::size_t>(Effector::Hips) || !goals_[k].target->rotation)
            continue;
        hips_given_ = true;
        work_.links.front().turn =
            target_rotation(work_.links.front(), *goals_[k].target, work_.links.front().rotation);
    }
    work_.place_links(shift_);
    if (balances_) roll_feet();
    for (std::size_t i = 0; i < work_.links.size(); ++i) work_.first[i] = work_.links[i].position;
    for (std::size_t i = 0; i < work_.tips.size(); ++i)
        work_.first[work_.links.size() + i] = work_.place_of(work_.tips[i]);
}

double BodySolve::measure() noexcept {
    work_.place_links(shift_);
    if (balances_) roll_feet();
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
        goal.error = minus(goal.position, end_of(goal.effector).position);
        if (goal.limb) {
            const double off = goal.limb->shortening(goal.limb->bend) - goal.limb->start;
            goal.error = plus(goal.error, times(goal.limb->along, off));
        }
        cost += 0.5 * goal.weight * dot(goal.error, goal.error);
    }
    find_contacts();
    return cost + measure_balance() + contact_cost();
}

bool BodySolve::has_rotations() const noexcept {
    for (std::size_t k = 0; k < count_; ++k)
        if (goals_[k].target && goals_[k].target->rotation) return true;
    return false;
}

/// Applies the targets' rotations to hands, feet and head; feet without one keep the clip's.
void BodySolve::turn_ends() noexcept {
    work_.place_links(shift_);
    for (std::size_t k = 0; k < count_; ++k) {
        if (side_of(goals_[k]) || goals_[k].target->rotation) turn_end(goals_[k]);
    }
    work_.place_links(shift_);
}

glm::dquat BodySolve::rotation_of_end(const Goal& goal, const Link& link) const noexcept {
    if (!goal.target || !goal.target->rotation) return link.start;
    return target_rotation(link, *goal.target, side_of(goal) ? link.start : link.rotation);
}

void BodySolve::turn_end(const Goal& goal) noexcept {
    Link& link = end_of(goal.effector);
    if (link.parent < 0) return;
    Link& before = work_.links[static_cast<std::size_t>(link.parent)];
    link.turn = math::compose(conjugate(before.rotation), rotation_of_end(goal, link));
    if (goal.effector == static_cast<std::size_t>(Effector::LeftHand) ||
        goal.effector == static_cast<std::size_t>(Effector::RightHand)) {
        // The lower arm takes part of the twist about its own axis, which moves no joint.
        if (const auto along = direction_of(link.offset, 1e-9)) {
            const double twist =
                options_.twist_share * (hinge_angle(*along, link.turn) - hinge_angle(*along, link.clip_turn));
            before.turn = math::compose(before.turn, rotation_about(*along, twist));
            link.turn = math::compose(rotation_about(*along, -twist), link.turn);
        }
    }
    if (clamp_turn(link)) steps_[static_cast<std::size_t>(work_.ends[goal.effector])].freedom.blocked = 1;
}

void BodySolve::report(std::span<const rig::Transform> pose, BodyReport& report) noexcept {
    work_.place_needed(pose);
    for (std::size_t k = 0; k < count_; ++k) {
        const Goal& goal = goals_[k];
        if (!goal.target) continue;
        const Link& link = end_of(goal.effector);
        const double error = length(minus(goal.position, work_.placements[link.node].position));
        report.residuals[goal.effector] = error;
        report.residual = std::max(report.residual, error);
    }
    report.penetration = deepest();
    for (std::size_t i = 0; i < work_.links.size(); ++i)
        if (steps_[i].freedom.blocked > 0)
            report.at_limit[static_cast<std::size_t>(work_.links[i].bone)] = true;
}

}  // namespace tendril::humanoid::detail
