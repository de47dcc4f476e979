#include "humanoid/foot.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::humanoid::detail {
namespace {

using namespace rig::detail;

constexpr glm::dvec3 up{0.0, 1.0, 0.0};

/// On the first step, when no speed is known, a sole lower than this over the clip's floor stands, metres.
constexpr double standing = 0.015;
/// A foot locks again once its offset has eased to this fraction of break_distance: otherwise a foot that
/// slides in the clip would alternate between locked and released.
constexpr double relock_part = 0.25;
/// Maximum speed at which the ground turns a foot, radians per second.
constexpr double turn_speed = 3.0;
/// Maximum speed, m/s. Higher ones come from a tiny dt, not from motion.
constexpr double fastest = 1e3;
/// Minimum speed of a foot on the way to its foothold, m/s, and maximum, as a fraction of max_speed.
constexpr double min_shift_speed = 0.4, max_shift_part = 0.6;
/// A foot in the air that still has to rise by more than this returns to the clip no faster either, metres.
constexpr double late_rise = 0.15;
/// A foot is about to land if it is this close to the floor and the clip brakes it so hard that it stops
/// within this time; metres, seconds.
constexpr double landing_time = 0.2, landing_height = 0.15;
/// A heel this high over the toe is about to follow it off the ground, metres.
constexpr double rolled_off = 0.05;

constexpr double hold_speed_part = 0.75, max_hold_part = 0.65, min_clearance = 0.02;

glm::dvec3 level(const glm::dvec3& v) noexcept {
    return {v.x, 0.0, v.z};
}

double height_over_floor(const FootClip& clip, const FootContext& context) noexcept {
    return std::min(clip.heel.y, clip.toe.y) - context.floor;
}

/// The ground below heel and toe, or the reason why the foot cannot stand there.
struct Footing {
    std::optional<GroundHit> heel{}, toe{};  // only if a foot can stand there
    FootAlone alone = FootAlone::No;

    Footing(const glm::dvec3& heel_at, const glm::dvec3& toe_at, double from,
            const FootContext& context) noexcept
        : heel(context.ground.below({heel_at.x, from, heel_at.z})),
          toe(context.ground.below({toe_at.x, from, toe_at.z})) {
        const FootAlone why_heel = check_ground(heel, context), why_toe = check_ground(toe, context);
        const auto is_wall = [&](const std::optional<GroundHit>& hit, FootAlone why) {
            return why == FootAlone::TooSteep ||
                   (why == FootAlone::TooFar && hit->height > context.floor + context.base);
        };
        // A foot may overhang an edge, but not extend into ground that is too steep or too high.
        if (is_wall(heel, why_heel))
            alone = why_heel;
        else if (is_wall(toe, why_toe))
            alone = why_toe;
        else if (why_heel != FootAlone::No && why_toe != FootAlone::No)
            alone = std::max(why_heel, why_toe);
        if (why_heel != FootAlone::No) heel.reset();
        if (why_toe != FootAlone::No) toe.reset();
    }
    glm::dvec3 normal() const noexcept {
        glm::dvec3 sum(0.0);
        if (heel) sum = plus(sum, heel->normal);
        if (toe) sum = plus(sum, toe->normal);
        return direction_of(sum, 1e-9).value_or(up);
    }
};

/// The turn from straight up to the normal, by at most `most` radians.
glm::dquat tilt_to(const glm::dvec3& normal, double most) noexcept {
    const glm::dquat whole = minimal_rotation(up, normal);
    const double angle = 2.0 * half_angle_between({1.0, 0.0, 0.0, 0.0}, whole);
    return angle <= most ? whole : slerp({1.0, 0.0, 0.0, 0.0}, whole, most / angle);
}

glm::dquat eased_turn(const glm::dquat& from, const glm::dquat& to, double left, double most) noexcept {
    const double angle = 2.0 * half_angle_between(from, to);
    if (angle < 1e-7) return to;
    return slerp(from, to, std::min(1.0 - left, most / angle));
}

/// Heel and toe relative to the turned foot's ankle, and the slip of the ankle, since the toe is the anchor.
struct Turned {
    glm::dvec3 heel, ball, toe, slip;

    Turned(const FootState& foot, const FootClip& clip) noexcept
        : heel(rotated(foot.turn, minus(clip.heel, clip.ankle))),
          ball(rotated(foot.turn, minus(clip.ball, clip.ankle))),
          toe(rotated(foot.turn, minus(clip.toe, clip.ankle))) {
        const glm::dvec3 back = minus(minus(clip.toe, clip.ankle), toe);  // exactly 0 without a turn
        slip = {foot.offset_x + back.x, 0.0, foot.offset_z + back.z};
    }
};

/// The part of its shift that a foot makes in this step. It is eased; but on the way to a foothold it is no
/// faster than a knee may move, and fast enough to get there.
glm::dvec3 ease_shift(FootState& foot, const FootContext& context) noexcept {
    const double way = std::sqrt(foot.shift_x * foot.shift_x + foot.shift_z * foot.shift_z);
    if (!(way > 1e-9)) {
        const glm::dvec3 rest{foot.shift_x, 0.0, foot.shift_z};
        foot.shift_x = foot.shift_z = 0.0;
        return rest;
    }
    double by = way * (1.0 - context.decay);
    const double most = max_shift_part * context.options.max_speed * context.dt;
    if (foot.shift_x != -foot.offset_x || foot.shift_z != -foot.offset_z)
        by = std::min(std::max(by, min_shift_speed * context.dt), most);
    else if (!foot.locked && foot.goal - foot.lift > late_rise)
        by = std::min(by, most);
    const double part = std::min(1.0, by / way);
    const glm::dvec3 moved{foot.shift_x * part, 0.0, foot.shift_z * part};
    foot.shift_x -= moved.x, foot.shift_z -= moved.z;
    return moved;
}

bool is_over_foothold(const FootState& foot, const FeetOptions& options) noexcept {
    const double far = relock_part * options.break_distance;
    return foot.shift_x * foot.shift_x + foot.shift_z * foot.shift_z <= far * far;
}

/// Horizontal velocity of the toe, m/s.
glm::dvec3 velocity_of(const FootState& foot, const FootClip& clip, const FootContext& context) noexcept {
    if (context.first_step || !(context.dt > 0.0)) return foot.velocity;
    const glm::dvec3 v =
        plus(times(minus(clip.toe, foot.toe), 1.0 / context.dt), context.options.root_velocity);
    const double speed = std::sqrt(v.x * v.x + v.z * v.z), part = speed > fastest ? fastest / speed : 1.0;
    return {v.x * part, 0.0, v.z * part};
}

/// Where and when the clip stops a foot, if it goes on to brake it as in this step.
struct Stop {
    glm::dvec3 way{0.0};
    double seconds = 1e9;

    Stop(const glm::dvec3& velocity, const glm::dvec3& before, double dt) noexcept {
        const double speed = length(velocity), braking = (dot(before, velocity) / speed - speed) / dt;
        if (speed > 1e-9 && braking > 0.0)
            way = times(velocity, 0.5 * speed / braking), seconds = speed / braking;
    }
};

/// Remaining movement in the clip of a foot that is about to land or has landed; nullopt for any other.
std::optional<glm::dvec3> landing_in(const FootState& foot, const FootClip& clip, const Stop& stop,
                                     const FootContext& context) noexcept {
    if (foot.locked) return glm::dvec3(0.0);
    if (context.first_step || !(context.dt > 0.0) || height_over_floor(clip, context) > landing_height)
        return std::nullopt;
    if (length(foot.velocity) < context.options.enter_speed) return glm::dvec3(0.0);
    return stop.seconds < landing_time ? std::optional(stop.way) : std::nullopt;
}

glm::dvec3 shift_of(const FootState& foot) noexcept {
    return {foot.shift_x, 0.0, foot.shift_z};
}

/// Chooses the foothold of a foot that is about to land or has just been locked; a foot in the air returns to
/// the clip.
void choose_foothold(FootState& foot, const FootClip& clip, const std::optional<glm::dvec3>& landing,
                     double from, const FootContext& context) noexcept {
    const glm::dvec3 offset{foot.offset_x, 0.0, foot.offset_z}, last = plus(offset, shift_of(foot));
    if (foot.locked && foot.edges_known) return;
    glm::dvec3 to(0.0);
    if (landing) {
        const Turned turned(foot, clip);
        const glm::dvec3 heel =
            plus(plus(clip.ankle, turned.heel), plus(minus(turned.slip, offset), *landing));
        to = find_foothold(heel, plus(heel, minus(turned.toe, turned.heel)), from, last, context);
    }
    foot.edges_known = foot.locked;
    foot.shift_x = to.x - offset.x, foot.shift_z = to.z - offset.z;
    if (!context.first_step) return;
    if (foot.locked) foot.lock_x += foot.shift_x, foot.lock_z += foot.shift_z;
    foot.offset_x = to.x, foot.offset_z = to.z;
    foot.shift_x = foot.shift_z = 0.0;
}

/// Slows a foot down so that it is above a riser before it gets there. A foot that is already far behind
/// keeps its distance: otherwise it would fall further behind at each stair.
glm::dvec3 hold_back(FootState& foot, const glm::dvec3& by, const glm::dvec3& eased,
                     const FootContext& context) noexcept {
    const auto back = direction_of(times(by, -1.0), 1e-9);
    if (!back) return glm::dvec3(0.0);
    const double behind = std::sqrt(foot.offset_x * foot.offset_x + foot.offset_z * foot.offset_z),
                 gained = -dot(eased, *back);
    const double most = std::min(hold_speed_part * context.options.max_speed * context.dt,
                                 std::max(0.0, max_hold_part * context.options.break_distance - behind));
    const glm::dvec3 held = times(*back, std::clamp(length(by), 0.0, std::max(0.0, most + gained)));
    foot.offset_x += held.x, foot.offset_z += held.z;
    foot.shift_x -= held.x, foot.shift_z -= held.z;
    return held;
}

/// Lifts a foot that comes down on its foothold from above: it stays over the step that it has yet to cross,
/// and its heel over a step behind it until clear of the edge, because a stretched leg lands slightly short.
double lift_over_landing(const FootClip& clip, const Turned& turned, const Footing& footing,
                         const glm::dvec3& way, double from, const FootContext& context) noexcept {
    const glm::dvec3 ankle = plus(clip.ankle, turned.slip);
    double lift = -1e300;
    const auto step_at = [&](const std::optional<GroundHit>& hit, const glm::dvec3& point,
                             const glm::dvec3& by) {
        if (!hit) return -1e300;
        const auto there = context.ground.below({ankle.x + point.x + by.x, from, ankle.z + point.z + by.z});
        const bool is_step = check_ground(there, context) == FootAlone::No &&
                             there->height > height_of_plane(*hit, by.x, by.z) + step_over_plane;
        return is_step ? there->height - point.y - clip.ankle.y : -1e300;
    };
    lift = std::max({lift, step_at(footing.heel, turned.heel, way), step_at(footing.toe, turned.toe, way)});
    const glm::dvec3 back =
        times(direction_of(level(minus(turned.heel, turned.toe)), 1e-9).value_or(glm::dvec3(0.0)),
              context.options.edge);
    const double clear =
        step_at(footing.heel, turned.heel, plus(way, times(back, 0.95))) > -1e300 ? 0.2 : 0.95;
    return std::max(lift, step_at(footing.heel, turned.heel, times(back, clear)));
}

}  // namespace

glm::dvec3 update_lock(FootState& foot, const FootClip& clip, const FootContext& context) noexcept {
    const FeetOptions& options = context.options;
    const double height = height_over_floor(clip, context);
    const glm::dvec3 before{foot.offset_x, 0.0, foot.offset_z};
    const auto lock = [&] {
        foot.locked = true;
        foot.edges_known = false;
        foot.lock_x = clip.toe.x + foot.offset_x, foot.lock_z = clip.toe.z + foot.offset_z;
    };
    if (context.first_step) {
        if (height < std::min(options.low, standing)) lock();
    } else if (context.dt > 0.0) {
        const glm::dvec3 moved = plus(minus(clip.toe, foot.toe), times(options.root_velocity, context.dt));
        const double speed = length(moved) / context.dt;
        if (foot.locked) {
            const glm::dvec3 by = ease_shift(foot, context);
            foot.lock_x += by.x - options.root_velocity.x * context.dt;
            foot.lock_z += by.z - options.root_velocity.z * context.dt;
            // A foot that rolls off below the root has a step to climb, and no time to lose.
            const bool below = context.base - foot.lift > step_over_plane;
            const bool leaves = below && clip.heel.y - clip.toe.y > rolled_off;
            const bool fast =
                speed > (foot.speed_known && !leaves ? options.leave_speed : options.enter_speed);
            const double x = foot.lock_x - clip.toe.x, z = foot.lock_z - clip.toe.z;
            const bool far = x * x + z * z > options.break_distance * options.break_distance;
            // A released foot follows the clip again, at the offset it had before.
            if (fast || far || height > options.low) {
                foot.locked = false;
                foot.shift_x = -foot.offset_x, foot.shift_z = -foot.offset_z;
            } else {
                foot.offset_x = x, foot.offset_z = z;
            }
        } else if (foot.alone == FootAlone::No && height < options.low && speed < options.enter_speed &&
                   is_over_foothold(foot, options)) {
            lock();
        }
        foot.speed_known = foot.locked;
        if (!foot.locked) {
            const glm::dvec3 by = ease_shift(foot, context);
            foot.offset_x += by.x, foot.offset_z += by.z;
            if (std::abs(foot.offset_x) + std::abs(foot.offset_z) < 1e-9) foot.offset_x = foot.offset_z = 0.0;
        }
    } else if (foot.locked) {
        foot.offset_x = foot.lock_x - clip.toe.x, foot.offset_z = foot.lock_z - clip.toe.z;
    }
    const double planting = foot.locked ? 1.0 : 0.0;
    foot.planting = context.first_step ? planting : planting + (foot.planting - planting) * context.decay;
    return minus(glm::dvec3(foot.offset_x, 0.0, foot.offset_z), before);
}

FootGoal find_goal(FootState& foot, const FootClip& clip, const glm::dvec3& eased,
                   const FootContext& context) noexcept {
    const double from = clip.ankle.y + context.base + context.options.ray_start;
    const glm::dvec3 before = foot.velocity;
    foot.velocity = velocity_of(foot, clip, context);  // even without ground: braking is measured from this
    const auto footing_of = [&](const Turned& turned) {
        const glm::dvec3 ankle = plus(clip.ankle, turned.slip);
        return Footing(plus(ankle, turned.heel), plus(ankle, turned.toe), from, context);
    };
    const auto turn_by = [&](const Footing& footing) {
        const glm::dquat goal = footing.alone == FootAlone::No
                                    ? tilt_to(footing.normal(), context.options.max_turn)
                                    : glm::dquat{1.0, 0.0, 0.0, 0.0};
        foot.turn =
            context.first_step ? goal : eased_turn(foot.turn, goal, context.decay, turn_speed * context.dt);
    };
    turn_by(footing_of(Turned(foot, clip)));
    const Stop stop(foot.velocity, before, context.dt);
    const auto landing = landing_in(foot, clip, stop, context);
    choose_foothold(foot, clip, landing, from, context);
    Turned turned(foot, clip);
    FootGoal goal;
    Clearance way;
    glm::dvec3 held(0.0);
    if (!(foot.locked && foot.standing) && context.dt > 0.0 && !context.first_step) {
        const glm::dvec3 ankle = plus(plus(clip.ankle, turned.slip), {0.0, foot.lift, 0.0}),
                         root = times(context.options.root_velocity, context.dt);
        SwingSole sole{
            .points = {plus(ankle, turned.heel), plus(ankle, turned.ball), plus(ankle, turned.toe)},
            .moved = plus(level(plus(minus(clip.toe, foot.toe), root)), eased),
            .velocity = foot.velocity,
            .before = before};
        if (landing) sole.remaining = length(plus(*landing, shift_of(foot)));
        // By the time at which the clip stops, the foot has made its shift too.
        if (stop.seconds < 1.0) {
            const double part = length(plus(stop.way, shift_of(foot))) / length(stop.way);
            sole.velocity = times(sole.velocity, part), sole.before = times(before, part);
        }
        way = find_clearance(sole, from, context);
        if (!foot.locked && way.part < 1.0) {
            held = hold_back(foot, times(sole.moved, 1.0 - way.part), eased, context);
            turned = Turned(foot, clip);
        }
    }
    const Footing footing = footing_of(turned);
    foot.alone = footing.alone;
    goal.slip = turned.slip;
    goal.shifted = length(plus(eased, held));
    if (foot.alone != FootAlone::No) return goal;

    double support = -1e300;
    if (footing.heel) support = std::max(support, footing.heel->height - turned.heel.y);
    if (footing.toe) support = std::max(support, footing.toe->height - turned.toe.y);
    goal.contact = support - clip.ankle.y;
    const double clearance = std::max(0.0, height_over_floor(clip, context)) * (1.0 - foot.planting);
    goal.lift =
        std::max(clearance + goal.contact, std::min(clearance, min_clearance) + way.raise + foot.lift);
    if (landing && !foot.standing && !context.first_step)
        goal.lift = std::max(goal.lift, lift_over_landing(clip, turned, footing,
                                                          plus(*landing, shift_of(foot)), from, context));
    if (context.dt > 0.0 && !context.first_step) {
        const glm::dvec3 normal = footing.normal(), v = foot.velocity;
        goal.rise = -(normal.x * v.x + normal.z * v.z) / normal.y * context.dt;
    }
    return goal;
}

}  // namespace tendril::humanoid::detail
