// The first and last stages of a step: placing the legs, raising the root, finding the feet's goals, and the
// report.
#include <algorithm>
#include <cmath>

#include "humanoid/feet_step.hpp"
#include "humanoid/input.hpp"
#include "tendril/elementary.hpp"

namespace tendril::humanoid {
namespace detail {

using namespace rig::detail;

namespace {

/// If the hips move further and faster than this in a step, the clip has jumped; metres and m/s.
constexpr double min_jump = 1.0, min_jump_speed = 20.0;
/// A leg that could not reach is used again once it falls short by less than this fraction of pelvis_drop.
constexpr double reach_again_part = 0.9;

/// Saves the transforms that a step may change, to blend or restore them.
class Saved {
  public:
    Saved(Pose pose, std::size_t hips, const std::array<Limb, 2>& legs) noexcept : pose_(pose) {
        add(hips);
        for (const Limb& leg : legs)
            for (const std::size_t place : {leg.upper, leg.lower, leg.end}) add(leg.node(place));
    }
    void blend(double weight) noexcept {
        for (std::size_t i = 0; i < count_; ++i)
            pose_[nodes_[i]] = rig::blend(before_[i], pose_[nodes_[i]], weight);
    }
    void restore() noexcept {
        for (std::size_t i = 0; i < count_; ++i) pose_[nodes_[i]] = before_[i];
    }
    bool is_sane() const noexcept {
        return std::all_of(nodes_.begin(), nodes_.begin() + static_cast<std::ptrdiff_t>(count_),
                           [&](std::size_t node) { return detail::is_sane(pose_[node]); });
    }

  private:
    void add(std::size_t node) noexcept {
        nodes_[count_] = node;
        before_[count_++] = pose_[node];
    }
    Pose pose_;
    std::array<std::size_t, 7> nodes_{};
    std::array<rig::Transform, 7> before_{};
    std::size_t count_ = 0;
};

}  // namespace

bool FeetStep::place() noexcept {
    const Placement root = placement(options_.root);
    above_hips_ = root;
    for (const std::int32_t node : plan_.above_hips)
        above_hips_ = above_hips_ * placement(pose_[static_cast<std::size_t>(node)]);
    hips_ = above_hips_ * placement(pose_[plan_.hips]);
    for (std::size_t i = 0; i < 2; ++i) {
        legs_[i] = detail::place(plan_.legs[i], root, pose_);
        if (!legs_[i].is_finite()) return false;
        clips_[i] = {legs_[i].end.position, legs_[i].end.apply(plan_.soles.feet[i].heel),
                     legs_[i].tail.apply(plan_.balls[i]), legs_[i].tail.apply(plan_.soles.feet[i].toe)};
    }
    floor_ = root.apply({0.0, options_.floor.value_or(plan_.soles.floor), 0.0}).y;
    steepest_ = math::cosine(options_.max_slope);
    if (!state_.started || has_jumped()) state_ = {};
    first_step_ = !state_.started;
    last_raise_ = state_.base - state_.drop;
    for (std::size_t i = 0; i < 2; ++i) {
        lifts_[i] = state_.feet[i].lift;
        knees_[i] = legs_[i].lower.position;
    }
    point_knees();
    return true;
}

/// Points the poles along the character's forward, turned with the hips and with the leg.
void FeetStep::point_knees() noexcept {
    const glm::dquat turned = math::compose(hips_.rotation(), conjugate(plan_.hips_at_rest));
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 rest = rotated(turned, plan_.leg_direction[i]);
        const auto now = direction_of(minus(clips_[i].ankle, legs_[i].upper.position), 1e-9);
        poles_[i] = rotated(minimal_rotation(rest, now.value_or(rest)), rotated(turned, plan_.soles.forward));
    }
}

bool FeetStep::has_jumped() const noexcept {
    if (dt_ > 0.0) {
        const double moved = length(minus(hips_.position, state_.hips));
        return moved > min_jump && moved > min_jump_speed * dt_;
    }
    bool same = hips_.position == state_.hips;
    for (std::size_t i = 0; i < 2; ++i)
        same &= clips_[i].heel == state_.feet[i].heel && clips_[i].toe == state_.feet[i].toe;
    return !same;
}

bool FeetStep::is_ground(const std::optional<GroundHit>& hit, double around) const noexcept {
    return hit && hit->normal.y >= steepest_ && std::abs(hit->height - around) <= options_.max_step;
}

/// The ground below the hips; if there is none, the highest ground, if it is above the clip's floor, so that
/// no character starts underground.
double FeetStep::first_base() const noexcept {
    const glm::dvec3& at = hips_.position;
    const auto near = ground_.below({at.x, at.y + options_.ray_start, at.z});
    if (near && near->normal.y >= steepest_ && near->height >= floor_ - options_.max_step)
        return near->height - floor_;
    const auto top = ground_.highest(at.x, at.z);
    return top && top->normal.y >= steepest_ && top->height >= floor_ ? top->height - floor_ : 0.0;
}

/// Mean height of the ground over the clip's floor; state_.base if there is no ground nearby to stand on.
double FeetStep::ground_around() const noexcept {
    if (ground_.kind() == GroundKind::None) return 0.0;
    const double around = floor_ + state_.base, from = around + options_.max_step;
    double sum = 0.0;
    int count = 0;
    for (const glm::dvec3& point : plan_.disc) {
        const double x = hips_.position.x + options_.root_radius * point.x,
                     z = hips_.position.z + options_.root_radius * point.z;
        const auto hit = ground_.below({x, from, z});
        if (!is_ground(hit, around)) continue;
        sum += hit->height - floor_;
        ++count;
    }
    return count > 0 ? sum / count : state_.base;
}

void FeetStep::raise_root() noexcept {
    if (first_step_) state_.base = first_base();
    const double before = state_.base, target = ground_around();
    if (first_step_) {
        state_.base = target;
        state_.root = {.value = target, .previous_target = target, .started = true};
        return;
    }
    if (!(dt_ > 0.0)) return;
    const double sprung = step_spring(state_.root, options_.root_half_life, target, dt_);
    state_.base = move_toward(before, sprung, options_.max_speed * dt_);
    if (state_.base != sprung) set(state_.root, before, state_.base, dt_);
    if (target == 0.0 && std::abs(state_.base) < 1e-9) state_.base = 0.0;
}

void FeetStep::find_feet() noexcept {
    const FootContext context{.ground = ground_,
                              .options = options_,
                              .dt = dt_,
                              .first_step = first_step_,
                              .floor = floor_,
                              .base = state_.base,
                              .decay = math::decay(math::ln2 * dt_ / options_.half_life),
                              .steepest = steepest_};
    for (std::size_t i = 0; i < 2; ++i) {
        FootState& foot = state_.feet[i];
        const bool was_out_of_reach = foot.alone == FootAlone::CannotReach;
        const glm::dvec3 eased = detail::update_lock(foot, clips_[i], context);
        goals_[i] = detail::find_goal(foot, clips_[i], eased, context);
        const double most = options_.pelvis_drop * (was_out_of_reach ? reach_again_part : 1.0);
        if (foot.alone == FootAlone::No && shortfall(i, goals_[i].lift) > most)
            foot.alone = FootAlone::CannotReach;
        if (foot.alone != FootAlone::No) {
            foot.locked = foot.speed_known = false;
            continue;
        }
        ease_lift(i, goals_[i].lift, goals_[i].rise);
    }
}

FeetReport FeetStep::report() const noexcept {
    FeetReport report{.base = state_.base, .drop = state_.drop};
    for (std::size_t i = 0; i < 2; ++i) {
        const FootState& foot = state_.feet[i];
        FootReport& made = report.feet[i];
        made.alone = foot.alone;
        made.heel = legs_[i].end.apply(plan_.soles.feet[i].heel);
        made.toe = legs_[i].tail.apply(plan_.soles.feet[i].toe);
        if (foot.alone != FootAlone::No) continue;
        const auto over = [&](const glm::dvec3& point) {
            const auto hit = ground_.below({point.x, point.y + options_.ray_start, point.z});
            return hit ? point.y - hit->height : 1e300;
        };
        const double lowest = std::min(over(made.heel), over(made.toe));
        made.planted = foot.standing && std::abs(lowest) <= max_gap;
        made.depth = std::max(0.0, -std::min(lowest, over(legs_[i].tail.apply(plan_.balls[i]))));
        made.late = std::max(0.0, foot.goal - foot.lift);
    }
    return report;
}

}  // namespace detail

FeetReport Feet::step(std::span<rig::Transform> pose, const Ground& ground, double dt, FeetState& state,
                      const FeetOptions& options) const noexcept {
    if (!plan_) return {.accepted = tendril::detail::moved_from("step", "feet")};
    const detail::FeetPlan& plan = *plan_;
    if (const Result bad = detail::check_pose("step", pose, plan.nodes); !bad) return {.accepted = bad};
    if (const Result bad = check(options); !bad) return {.accepted = bad};
    if (const Result bad = check(state); !bad) return {.accepted = bad};
    FeetState next = state;
    detail::FeetStep step(plan, pose, ground, dt, next, options);
    if (!step.place()) return {.accepted = detail::refused_bones("step")};
    step.raise_root();
    step.find_feet();
    step.lower_pelvis();
    step.limit_standing_knees();
    detail::Saved saved(pose, plan.hips, plan.legs);
    step.move();
    FeetReport report = step.report();
    if (options.weight < 1.0) {
        saved.blend(options.weight);
        const Placement root = placement(options.root);
        for (std::size_t i = 0; i < 2; ++i) {
            const detail::LimbPlacement leg = detail::place(plan.legs[i], root, pose);
            report.feet[i].planted = false;
            report.feet[i].heel = leg.end.apply(plan.soles.feet[i].heel);
            report.feet[i].toe = leg.tail.apply(plan.soles.feet[i].toe);
        }
    }
    // Extremely short or long bones may give unusable numbers.
    bool valid = saved.is_sane() && check(next);
    for (const FootReport& foot : report.feet)
        valid = valid && detail::is_within(foot.heel) && detail::is_within(foot.toe);
    if (!valid) {
        saved.restore();
        return {.accepted = detail::refused_bones("step")};
    }
    state = next;
    return report;
}

}  // namespace tendril::humanoid
