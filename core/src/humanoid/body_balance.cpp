// Balance in a body's solve: one equation that keeps the centre of mass over the feet. It is one-sided, like
// a contact: it acts once a step would take the centre out of the safe part of the support.
#include <algorithm>
#include <array>

#include "humanoid/balance.hpp"
#include "humanoid/body_solve.hpp"
#include "humanoid/joint_turn.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

namespace {

glm::dvec3 level_part(const glm::dvec3& v) noexcept {
    return {v.x, 0.0, v.z};
}

}  // namespace

glm::dvec3 BodySolve::centre_of_mass() const noexcept {
    glm::dvec3 sum{0.0};
    for (const LinkMass& each : work_.masses) {
        const Link& link = work_.links[static_cast<std::size_t>(each.link)];
        sum = plus(sum, times(plus(link.position, rotated(link.rotation, each.at)), each.point.share));
    }
    return sum;
}

namespace {

/// The sole of a foot that is at `position` and turned by `turn` from the clip's pose `was`.
SolePoints moved_sole(const SolePoints& clip, const glm::dvec3& was, const glm::dvec3& position,
                      const glm::dquat& turn) noexcept {
    return {plus(position, rotated(turn, minus(clip.heel, was))),
            plus(position, rotated(turn, minus(clip.toe, was)))};
}

}  // namespace

std::optional<std::size_t> BodySolve::side_of(const Goal& goal) noexcept {
    if (goal.effector == static_cast<std::size_t>(Effector::LeftFoot)) return 0;
    if (goal.effector == static_cast<std::size_t>(Effector::RightFoot)) return 1;
    return std::nullopt;
}

/// The foot as turn_ends() will turn it, if its parent bone is rotated by `above`. The ankle's limit may tilt
/// a foot that stays. It then rolls over the ball or the heel, whichever would sink into the ground, and its
/// goal moves along.
BodySolve::FootPlace BodySolve::foot_at(const Goal& goal, std::size_t side,
                                        const glm::dquat& above) const noexcept {
    Link link = end_of(goal.effector);
    link.turn = math::compose(conjugate(above), rotation_of_end(goal, link));
    const bool tilted = clamp_turn(link, 0.0f);
    FootPlace place{link.turn, goal.position, {}, clip_heights_[side], tilted};
    const glm::dquat turn = math::compose(math::compose(above, link.turn), conjugate(link.start));
    const SolePoints& clip = clip_soles_[side];
    const glm::dvec3& was = work_.placements[link.node].position;
    if (goal.target) {  // the target may be out of reach: the foot supports from its actual position
        place.sole = moved_sole(clip, was, link.position, turn);
        return place;
    }
    SolePoints now = moved_sole(clip, was, was, turn);
    const double heel = std::max(clip.heel.y - now.heel.y, 0.0), toe = std::max(clip.toe.y - now.toe.y, 0.0),
                 both = heel + toe;
    glm::dvec3 rolled = was;
    if (both > 0.0) {
        const glm::dvec3 by = mix(minus(clip.heel, now.heel), minus(clip.toe, now.toe), toe / both);
        rolled = plus(was, times(by, std::min(both / (rolling_part * work_.soles->leg), 1.0)));
    }
    now = moved_sole(clip, was, rolled, turn);
    place.heights.heel += now.heel.y - clip.heel.y;
    place.heights.toe += now.toe.y - clip.toe.y;
    const FootShift& shift = options_.feet[side];
    place.sole = {plus(now.heel, shift.stand), plus(now.toe, shift.stand)};
    place.goal = plus(rolled, shift.stand);
    place.goal.y += shift.lift;
    return place;
}

/// The safe part of the support. A foot in the middle of a step supports as if it were on the ground. If a
/// foot has a target, heights are measured over the ground, because the target may take the foot anywhere.
Support BodySolve::safe_support(const std::array<SolePoints, 2>& soles,
                                const std::array<SoleHeights, 2>& over) const noexcept {
    return find_support(*work_.soles, soles, foot_target_ ? sole_heights(soles, options_.ground) : over)
        .shrunk(options_.reserve);
}

/// Turns the feet, moves the goals of those that roll, and finds the support.
void BodySolve::roll_feet() noexcept {
    soles_ = clip_soles_;
    heights_ = clip_heights_;
    foot_target_ = false;
    for (std::size_t k = 0; k < count_; ++k) {
        Goal& goal = goals_[k];
        const auto side = side_of(goal);
        if (!side) continue;
        Link& link = end_of(goal.effector);
        const glm::dquat above = work_.links[static_cast<std::size_t>(link.parent)].rotation;
        const FootPlace place = foot_at(goal, *side, above);
        link.turn = place.turn;
        goal.position = place.goal;
        soles_[*side] = place.sole;
        heights_[*side] = place.heights;
        tilted_[*side] = place.tilted;
        foot_target_ = foot_target_ || goal.target;
    }
    work_.place_links(shift_);
    safe_ = safe_support(soles_, heights_);
}

/// Allows the imbalance of the clip's own pose.
void BodySolve::start_balance() noexcept {
    balances_ = false;
    if (!options_.balance || !work_.soles) return;
    clip_soles_ = sole_points(*work_.soles, work_.placements);
    clip_heights_ = sole_heights(clip_soles_, options_.ground);
    safe_ = find_support(*work_.soles, clip_soles_, clip_heights_).shrunk(options_.reserve);
    if (safe_.count == 0) return;
    const glm::dvec3 centre = centre_of_mass();
    allowed_ = length(minus(centre, safe_.nearest(centre)));
    balances_ = true;
}

double BodySolve::measure_balance() noexcept {
    outside_ = 0.0;
    if (!balances_ || safe_.count == 0) return 0.0;
    centre_ = centre_of_mass();
    const glm::dvec3 offset = level_part(minus(centre_, safe_.nearest(centre_)));
    const double distance = length(offset);
    if (!(distance > allowed_)) return 0.0;
    away_ = times(offset, 1.0 / distance);
    outside_ = distance - allowed_;
    return 0.5 * balance_weight * outside_ * outside_;
}

/// Finds mass_arms_, from the mass that each link's turn moves. Limbs without a goal are no counterweight.
void BodySolve::find_mass_arms() noexcept {
    std::array<double, bone_count> mass{};
    std::array<glm::dvec3, bone_count> moment{};
    for (const LinkMass& each : work_.masses) {
        const auto i = static_cast<std::size_t>(each.link);
        const Link& link = work_.links[i];
        mass[i] += each.point.share;
        moment[i] =
            plus(moment[i], times(plus(link.position, rotated(link.rotation, each.at)), each.point.share));
    }
    for (std::size_t i = work_.links.size(); i-- > 0;) {
        const Link& link = work_.links[i];
        mass_arms_[i] = minus(moment[i], times(link.position, mass[i]));
        if (link.parent < 0) continue;
        const auto above = static_cast<std::size_t>(link.parent);
        mass[above] += mass[i];
        moment[above] = plus(moment[above], moment[i]);
    }
}

void BodySolve::start_balance_step() noexcept {
    balance_row_ = -1;
    balance_released_ = false;
    if (!balances_ || safe_.count == 0) return;
    find_mass_arms();
    if (outside_ > 0.0) add_balance_row(away_, outside_);
}

void BodySolve::add_balance_row(const glm::dvec3& out, double by) noexcept {
    balance_row_ = static_cast<int>(row_count_);
    rows_[row_count_] = {times(out, -1.0), by, balance_weight};
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        columns_[i][row_count_] = glm::dvec3(0.0);
        if (steps_[i].rows == 0) continue;
        columns_[i][row_count_] = cross(mass_arms_[i], times(out, -1.0));
        steps_[i].rows |= 1u << row_count_;
    }
    for (std::size_t k = 0; k < count_; ++k)
        if (const auto side = side_of(goals_[k])) add_support_columns(k, *side, out);
    ++row_count_;
}

/// The support moves with the feet: a foot that follows a target moves its part along, and one that rolls
/// lifts its heel or its toes off the ground. Adds this effect to the balance row: how far it moves, along
/// `out`, the point of the safe part nearest to the centre of mass.
void BodySolve::add_support_columns(std::size_t goal_index, std::size_t side,
                                    const glm::dvec3& out) noexcept {
    constexpr double step = 1e-3;  // radians, and leg lengths
    const Goal& goal = goals_[goal_index];
    const Link& foot = end_of(goal.effector);
    const glm::dquat above = work_.links[static_cast<std::size_t>(foot.parent)].rotation;
    const double now = dot(safe_.nearest(centre_), out);
    const auto moved_by = [&](const SolePoints& sole, const SoleHeights& heights) {
        std::array<SolePoints, 2> soles = soles_;
        std::array<SoleHeights, 2> over = heights_;
        soles[side] = sole, over[side] = heights;
        const Support support = safe_support(soles, over);
        return support.count > 0 ? dot(support.nearest(centre_), out) - now : 0.0;
    };
    glm::dvec3 by_move{0.0}, by_turn{0.0};
    const double distance = step * work_.soles->leg;
    // Mirror the trial steps for a mirrored foot.
    const glm::dvec3 &ahead = work_.soles->forward, left{ahead.z, 0.0, -ahead.x}, up{0.0, 1.0, 0.0};
    const double sign = side == 0 ? 1.0 : -1.0;
    for (const glm::dvec3& axis : {left, times(up, sign), times(ahead, sign)}) {
        const FootPlace turned = foot_at(goal, side, math::compose(rotation_about(axis, step), above));
        if (!turned.tilted && !tilted_[side]) continue;
        by_turn = plus(by_turn, times(axis, moved_by(turned.sole, turned.heights) / step));
    }
    for (const glm::dvec3& axis : {times(left, sign), up, ahead}) {
        if (!goal.target) break;
        const SolePoints& sole = soles_[side];
        const glm::dvec3 by = times(axis, distance);
        by_move =
            plus(by_move,
                 times(axis, moved_by({plus(sole.heel, by), plus(sole.toe, by)}, heights_[side]) / distance));
    }
    Row& balance = rows_[row_count_];
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        const Link& link = work_.links[i];
        if (!(link.effectors >> goal.effector & 1u) || &link == &foot || steps_[i].rows == 0) continue;
        glm::dvec3& column = columns_[i][row_count_];
        column = plus(column, by_turn);
        for (std::size_t axis = 0; axis < 3; ++axis)
            column = plus(column, times(columns_[i][3 * goal_index + axis], by_move[static_cast<int>(axis)]));
    }
    balance.shift = plus(balance.shift, by_move);
}

bool BodySolve::update_balance() noexcept {
    if (!balances_ || safe_.count == 0) return false;
    if (balance_row_ >= 0) {
        const auto row = static_cast<std::size_t>(balance_row_);
        if (balance_released_ || forces_[row] >= 0.0) return false;
        rows_[row].weight = released_contact_weight;
        return balance_released_ = true;
    }
    glm::dvec3 moved = shift_step_;
    for (std::size_t i = 0; i < work_.links.size(); ++i)
        if (work_.links[i].effectors != 0) moved = plus(moved, cross(steps_[i].turn, mass_arms_[i]));
    const glm::dvec3 then = plus(centre_, moved), nearest = safe_.nearest(then);
    const glm::dvec3 offset = level_part(minus(then, nearest));
    const double distance = length(offset);
    if (!(distance > allowed_ + 1e-9 * work_.size)) return false;
    const glm::dvec3 out = times(offset, 1.0 / distance);
    add_balance_row(out, dot(level_part(minus(centre_, nearest)), out) - allowed_);
    return true;
}

}  // namespace tendril::humanoid::detail
