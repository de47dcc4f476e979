// Balance in a body's solve: one equation that keeps the centre of mass over the feet. It is one-sided, as a
// contact's: it acts once a step would take the centre out of the safe part of the support.
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

/// Where a foot's sole is if the foot is at `position`, turned by `turn` from the clip's pose `was`.
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

/// Turns the feet as turn_ends() will. The ankle's limit may tilt a foot that stays: then it rolls over the
/// ball or the heel, whichever would sink into the ground, and its goal moves along. Finds the support, to
/// which a foot in the middle of a step belongs as if it did not rise.
void BodySolve::roll_feet() noexcept {
    std::array<SolePoints, 2>& soles = soles_ = clip_soles_;
    std::array<SoleHeights, 2> over = clip_heights_;
    bool target = false;
    for (std::size_t k = 0; k < count_; ++k) {
        Goal& goal = goals_[k];
        const auto foot = side_of(goal);
        if (!foot) continue;
        const std::size_t side = *foot;
        Link& link = end_of(goal.effector);
        const glm::dquat above = work_.links[static_cast<std::size_t>(link.parent)].rotation;
        link.rotation = math::compose(above, link.own);  // a rotation is blended in once, not at each round
        link.turn = math::compose(conjugate(above), rotation_of_end(goal));
        clamp_turn(link);
        link.rotation = math::compose(above, link.turn);
        const glm::dquat turn = math::compose(link.rotation, conjugate(link.start));
        const SolePoints& clip = clip_soles_[side];
        const glm::dvec3& was = work_.placements[link.node].position;
        if (goal.target) {
            soles[side] = moved_sole(clip, was, link.position, turn);
            target = true;
            continue;
        }
        SolePoints now = moved_sole(clip, was, was, turn);
        const double heel = std::max(clip.heel.y - now.heel.y, 0.0),
                     toe = std::max(clip.toe.y - now.toe.y, 0.0), both = heel + toe;
        glm::dvec3 rolled = was;
        if (both > 0.0) {
            const glm::dvec3 by = mix(minus(clip.heel, now.heel), minus(clip.toe, now.toe), toe / both);
            rolled = plus(was, times(by, std::min(both / (rolling_part * work_.soles->leg), 1.0)));
        }
        now = moved_sole(clip, was, rolled, turn);
        over[side].heel += now.heel.y - clip.heel.y;
        over[side].toe += now.toe.y - clip.toe.y;
        const FootShift& shift = options_.feet[side];
        soles[side] = {plus(now.heel, shift.stand), plus(now.toe, shift.stand)};
        goal.position = plus(rolled, shift.stand);
        goal.position.y += shift.lift;
    }
    work_.place_links(shift_);
    // A target may take a foot anywhere, or be out of its reach: the foot supports where it is.
    if (target) over = sole_heights(soles, options_.ground);
    safe_ = find_support(*work_.soles, soles, over).shrunk(options_.reserve);
}

/// What the clip's pose is out of balance by is allowed.
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
    const glm::dvec3 way = level_part(minus(centre_, safe_.nearest(centre_)));
    const double far = length(way);
    if (!(far > allowed_)) return 0.0;
    out_ = times(way, 1.0 / far);
    outside_ = far - allowed_;
    return 0.5 * balance_weight * outside_ * outside_;
}

/// Of a row that moves the centre of mass along `out_`: what each link's turn moves. A limb without a goal is
/// no counterweight.
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
    if (outside_ > 0.0) add_balance_row(out_, outside_);
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
        if (const glm::dvec3 along = support_gradient(goals_[k], out); along != glm::dvec3(0.0))
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t row = 3 * k + static_cast<std::size_t>(axis);
                rows_[row_count_].shift = plus(rows_[row_count_].shift, times(rows_[row].shift, along[axis]));
                for (std::size_t i = 0; i < work_.links.size(); ++i)
                    if (steps_[i].rows >> row & 1u)
                        columns_[i][row_count_] =
                            plus(columns_[i][row_count_], times(columns_[i][row], along[axis]));
            }
    ++row_count_;
}

/// A foot that follows a target carries its part of the support along: how far the point of the safe part
/// nearest to the centre of mass moves along `out` as the foot moves along each axis.
glm::dvec3 BodySolve::support_gradient(const Goal& goal, const glm::dvec3& out) const noexcept {
    const auto side = side_of(goal);
    if (!side || !goal.target) return glm::dvec3(0.0);
    const double step = 1e-3 * work_.soles->leg, now = dot(safe_.nearest(centre_), out);
    glm::dvec3 gradient{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        std::array<SolePoints, 2> moved = soles_;
        SolePoints& sole = moved[*side];
        sole.heel[axis] += step, sole.toe[axis] += step;
        const Support support =
            find_support(*work_.soles, moved, sole_heights(moved, options_.ground)).shrunk(options_.reserve);
        if (support.count > 0) gradient[axis] = (dot(support.nearest(centre_), out) - now) / step;
    }
    return gradient;
}

bool BodySolve::hold_balance() noexcept {
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
    const glm::dvec3 way = level_part(minus(then, nearest));
    const double far = length(way);
    if (!(far > allowed_ + 1e-9)) return false;
    const glm::dvec3 out = times(way, 1.0 / far);
    add_balance_row(out, dot(level_part(minus(centre_, nearest)), out) - allowed_);
    return true;
}

}  // namespace tendril::humanoid::detail
