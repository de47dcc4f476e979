#include "humanoid/foot.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::humanoid::detail {
namespace {

using namespace rig::detail;

constexpr glm::dvec3 up{0.0, 1.0, 0.0};

/// Metres. On the first step, when no speed is known, a sole lower than this over the clip's floor stands.
constexpr double standing = 0.015;
/// A foot locks again once its offset has eased to this part of break_distance: otherwise a foot that slides
/// in the clip would alternate between locked and released.
constexpr double lock_again = 0.25;
/// How fast the ground may turn a foot, radians per second.
constexpr double turn_speed = 3.0;
/// m/s. Higher speeds come from a tiny dt, not from motion.
constexpr double fastest = 1e3;
/// How far a foot in the air looks ahead, seconds and metres; and how far the ground must be above the plane
/// below the foot, or from one look to the next, to count as a step, metres.
constexpr double ahead[]{0.04, 0.08, 0.12, 0.16, 0.2}, farthest = 0.8;
/// m/s. A faster foot keeps only heel and toe over the ground below them.
constexpr double fastest_swing = 4.0;
constexpr double step_over_plane = 0.02;
/// Parts of max_speed: how fast a foot is lifted over what it sees ahead, and how fast it is kept back in
/// front of what it is not over in time.
constexpr double lifting = 0.45, waiting = 0.75;
/// It waits for a riser that it comes to within so many looks, seconds apart.
constexpr double looks = 3.0, looks_apart = 1.0 / 60.0;
constexpr double patience = 0.65;  // how far it is kept back, as part of break_distance

double height_over_floor(const FootClip& clip, const FootContext& context) noexcept {
    return std::min(clip.heel.y, clip.toe.y) - context.floor;
}

FootAlone judge(const std::optional<GroundHit>& hit, const FootContext& context) noexcept {
    if (!hit) return FootAlone::NoHit;
    if (hit->normal.y < context.steepest) return FootAlone::TooSteep;
    const double step = std::abs(hit->height - (context.floor + context.base));
    return step <= context.options.max_step ? FootAlone::No : FootAlone::TooFar;
}

/// The ground below heel and toe, or why the foot cannot stand there.
struct Footing {
    std::optional<GroundHit> heel{}, toe{};  // only what can be stood on
    FootAlone alone = FootAlone::No;

    Footing(const glm::dvec3& heel_at, const glm::dvec3& toe_at, double from,
            const FootContext& context) noexcept
        : heel(context.ground.below({heel_at.x, from, heel_at.z})),
          toe(context.ground.below({toe_at.x, from, toe_at.z})) {
        const FootAlone why_heel = judge(heel, context), why_toe = judge(toe, context);
        const auto is_wall = [&](const std::optional<GroundHit>& hit, FootAlone why) {
            return why == FootAlone::TooSteep ||
                   (why == FootAlone::TooFar && hit->height > context.floor + context.base);
        };
        // A foot may stick out over an edge, but not into ground that is too steep or too high.
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

/// From straight up to the normal, by at most `most` radians.
glm::dquat turn_to(const glm::dvec3& normal, double most) noexcept {
    const glm::dquat whole = minimal_rotation(up, normal);
    const double angle = 2.0 * half_angle_between({1.0, 0.0, 0.0, 0.0}, whole);
    return angle <= most ? whole : slerp({1.0, 0.0, 0.0, 0.0}, whole, most / angle);
}

glm::dquat eased_turn(const glm::dquat& from, const glm::dquat& to, double left, double most) noexcept {
    const double angle = 2.0 * half_angle_between(from, to);
    if (angle < 1e-7) return to;
    return slerp(from, to, std::min(1.0 - left, most / angle));
}

/// Heel and toe relative to the ankle once the foot is turned, and how far the ankle slips, since the toe is
/// the anchor.
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

void ease(FootState& foot, double left) noexcept {
    foot.offset_x *= left, foot.offset_z *= left;
    if (std::abs(foot.offset_x) + std::abs(foot.offset_z) < 1e-9) foot.offset_x = foot.offset_z = 0.0;
}

bool is_eased(const FootState& foot, const FeetOptions& options) noexcept {
    const double far = lock_again * options.break_distance;
    return foot.offset_x * foot.offset_x + foot.offset_z * foot.offset_z <= far * far;
}

double height_of_plane(const GroundHit& hit, double x, double z) noexcept {
    return hit.height - (hit.normal.x * x + hit.normal.z * z) / hit.normal.y;
}

/// How far to move the foot along a unit vector so that neither heel nor toe is on the edge of a step; 0 if
/// there are edges on both sides or on neither.
double off_edge(const Footing& footing, const glm::dvec3& heel_at, const glm::dvec3& toe_at,
                const glm::dvec3& along, double from, const FootContext& context) noexcept {
    const auto is_edge = [&](const std::optional<GroundHit>& hit, const glm::dvec3& at, double by) {
        if (!hit) return false;
        const double x = along.x * by, z = along.z * by;
        const auto there = context.ground.below({at.x + x, from, at.z + z});
        return there && std::abs(there->height - height_of_plane(*hit, x, z)) > step_over_plane;
    };
    const double margin = context.options.edge;
    const bool before = is_edge(footing.heel, heel_at, margin) || is_edge(footing.toe, toe_at, margin);
    const bool behind = is_edge(footing.heel, heel_at, -margin) || is_edge(footing.toe, toe_at, -margin);
    return before == behind ? 0.0 : before ? -margin : margin;
}

void keep_off_edges(FootState& foot, const Footing& footing, const glm::dvec3& heel_at,
                    const glm::dvec3& toe_at, double from, const FootContext& context) noexcept {
    foot.edges_known = true;
    const glm::dvec3 way = minus(toe_at, heel_at);
    const glm::dvec3 along =
        direction_of(glm::dvec3(way.x, 0.0, way.z), 1e-9).value_or(glm::dvec3(0.0, 0.0, 1.0));
    const glm::dvec3 side(along.z, 0.0, -along.x);
    const double a = off_edge(footing, heel_at, toe_at, along, from, context),
                 b = off_edge(footing, heel_at, toe_at, side, from, context);
    foot.shift_x = along.x * a + side.x * b, foot.shift_z = along.z * a + side.z * b;
}

/// Of the toe, horizontal, m/s.
glm::dvec3 velocity_of(const FootState& foot, const FootClip& clip, const FootContext& context) noexcept {
    if (context.fresh || !(context.dt > 0.0)) return foot.velocity;
    const glm::dvec3 v =
        plus(times(minus(clip.toe, foot.toe), 1.0 / context.dt), context.options.root_velocity);
    const double speed = std::sqrt(v.x * v.x + v.z * v.z), part = speed > fastest ? fastest / speed : 1.0;
    return {v.x * part, 0.0, v.z * part};
}

/// Keeps a heel that steps down supported until it clears the edge of the upper step: a stretched leg lands
/// the foot slightly short of its goal.
double heel_clear_of_edge(const FootClip& clip, const Turned& turned, const Footing& footing, double from,
                          const FootContext& context) noexcept {
    if (!footing.heel || context.fresh || !(context.dt > 0.0)) return -1e300;
    const glm::dvec3 sole = minus(turned.toe, turned.heel);
    const glm::dvec3 behind =
        times(direction_of(glm::dvec3(sole.x, 0.0, sole.z), 1e-9).value_or(glm::dvec3(0.0)),
              -0.95 * context.options.edge);
    const glm::dvec3 heel = plus(plus(clip.ankle, turned.slip), turned.heel);
    const auto there = context.ground.below({heel.x + behind.x, from, heel.z + behind.z});
    const bool is_step = judge(there, context) == FootAlone::No &&
                         there->height > height_of_plane(*footing.heel, behind.x, behind.z) + step_over_plane;
    return is_step ? there->height - turned.heel.y : -1e300;
}

/// The path of a swinging toe over the ground ahead of it.
class ToeWay {
  public:
    /// `last_velocity`: the toe's velocity in the previous step.
    ToeWay(const FootState& foot, const FootClip& clip, const glm::dvec3& last_velocity,
           const glm::dvec3& toe, double from, const FootContext& context) noexcept
        : foot_(foot), context_(context), last_velocity_(last_velocity), from_(from), toe_(toe) {
        if (foot.locked || context.fresh || !(context.dt > 0.0)) return;
        eased_ = 1.0 / context.eased - 1.0;
        back_ = {foot.toe.x - clip.toe.x + foot.offset_x * eased_, 0.0,
                 foot.toe.z - clip.toe.z + foot.offset_z * eased_};
        before_ = plus(toe, back_);
        if (const auto hit = context.ground.below({before_.x, from, before_.z});
            judge(hit, context) == FootAlone::No)
            hit_ = *hit, is_known_ = true;
    }
    /// How far to hold the foot back so that it reaches a riser only once it is above it.
    glm::dvec3 wait() const noexcept {
        const double way = length(back_);
        if (!is_known_ || !(way > 1e-9)) return glm::dvec3(0.0);
        // Distances along the way are counted in steps of this size.
        const double most = context_.options.max_speed * context_.dt;
        const double own = toe_.y + foot_.lift - hit_.height - step_over_plane;
        const auto height_after = [&](double steps) { return height_at(times(back_, -steps)); };
        double there = 0.0, inside = 0.0;
        const double look = std::max(1.0, looks_apart / context_.dt);
        while (inside < looks * look && !(inside > 0.0 && there > own + most * inside))
            there = height_after(inside += look);
        if (!(there > own + most * inside)) return glm::dvec3(0.0);
        double free = inside - look;
        while (inside - free > 0.02) {
            const double middle = 0.5 * (free + inside);
            (height_after(middle) > own + most * middle ? inside : free) = middle;
        }
        const double needed = (there - own) / most;  // steps
        // A foot that is already far behind keeps that distance: it would fall further behind at each stair.
        const double behind = std::sqrt(foot_.offset_x * foot_.offset_x + foot_.offset_z * foot_.offset_z);
        const double left = std::max(0.0, patience * context_.options.break_distance - behind);
        const double most_back = eased_ * behind + std::min(waiting * most, left);
        return times(back_, std::clamp(1.0 - free / needed, 0.0, std::min(1.0, most_back / way)));
    }
    /// The height that the toe needs now to clear every step ahead in time, rising at a steady speed. It
    /// changes continuously as the foot moves.
    double height(const glm::dvec3& waited) const noexcept {
        if (!is_known_) return -1e300;
        const glm::dvec3 velocity = foot_.velocity, gone = minus(waited, back_);
        const double speed = length(velocity), rate = lifting * context_.options.max_speed;
        // A foot that brakes may stop before the edge.
        const double braking =
            speed > 1e-9 ? std::max(0.0, (dot(last_velocity_, velocity) / speed - speed) / context_.dt) : 0.0;
        const auto height_in = [&](double seconds) {
            const double t = braking * seconds > speed ? speed / braking : seconds;
            const double part = t - (speed > 1e-9 ? 0.5 * braking * t * t / speed : 0.0);
            return height_at(plus(gone, times(velocity, part)));
        };
        double needed = 0.0, lower = 0.0, since = 0.0;
        for (const double seconds : ahead) {
            if (seconds * speed > farthest) break;
            const double there = height_in(seconds);
            double first = seconds, last = since;
            for (const double step = there - lower; step > step_over_plane && first - last > 0.003;) {
                const double middle = 0.5 * (first + last);
                (height_in(middle) > lower + 0.5 * step ? first : last) = middle;
            }
            needed = std::max(needed, there - rate * first);
            lower = there, since = seconds;
        }
        return needed > 0.0 ? height_of_plane(hit_, gone.x, gone.z) + needed : -1e300;
    }

  private:
    /// The ground's height above the plane under the toe's previous place; 0 where no foot can stand.
    double height_at(const glm::dvec3& by) const noexcept {
        const auto there = context_.ground.below({before_.x + by.x, from_, before_.z + by.z});
        return judge(there, context_) == FootAlone::No ? there->height - height_of_plane(hit_, by.x, by.z)
                                                       : 0.0;
    }

    const FootState& foot_;
    const FootContext& context_;
    glm::dvec3 last_velocity_;
    double from_;
    glm::dvec3 toe_;                      // in this step, as far as the clip and its offset go
    glm::dvec3 before_{0.0}, back_{0.0};  // before the step, and the way back there
    double eased_ = 0.0;                  // how much longer the offset was
    GroundHit hit_{};                     // below `before_`
    bool is_known_ = false;
};

}  // namespace

void update_lock(FootState& foot, const FootClip& clip, const FootContext& context) noexcept {
    const FeetOptions& options = context.options;
    const double height = height_over_floor(clip, context);
    const auto lock = [&] {
        foot.locked = true;
        foot.edges_known = false;
        foot.shift_x = foot.shift_z = 0.0;
        foot.lock_x = clip.toe.x + foot.offset_x, foot.lock_z = clip.toe.z + foot.offset_z;
    };
    if (context.fresh) {
        if (height < std::min(options.low, standing)) lock();
    } else if (context.dt > 0.0) {
        const glm::dvec3 moved = plus(minus(clip.toe, foot.toe), times(options.root_velocity, context.dt));
        const double speed = length(moved) / context.dt;
        if (foot.locked) {
            foot.lock_x += foot.shift_x * (1.0 - context.eased) - options.root_velocity.x * context.dt;
            foot.lock_z += foot.shift_z * (1.0 - context.eased) - options.root_velocity.z * context.dt;
            foot.shift_x *= context.eased, foot.shift_z *= context.eased;
            const bool fast = speed > (foot.speed_known ? options.leave_speed : options.enter_speed);
            const double x = foot.lock_x - clip.toe.x, z = foot.lock_z - clip.toe.z;
            const bool far = x * x + z * z > options.break_distance * options.break_distance;
            // A released foot follows the clip again, at the offset it had before.
            if (fast || far || height > options.low)
                foot.locked = false;
            else
                foot.offset_x = x, foot.offset_z = z;
        } else if (foot.alone == FootAlone::No && height < options.low && speed < options.enter_speed &&
                   is_eased(foot, options)) {
            lock();
        }
        foot.speed_known = foot.locked;
        if (!foot.locked) ease(foot, context.eased);
    } else if (foot.locked) {
        foot.offset_x = foot.lock_x - clip.toe.x, foot.offset_z = foot.lock_z - clip.toe.z;
    }
    const double planting = foot.locked ? 1.0 : 0.0;
    foot.planting = context.fresh ? planting : planting + (foot.planting - planting) * context.eased;
}

FootGoal find_goal(FootState& foot, const FootClip& clip, const FootContext& context) noexcept {
    const double from = clip.ankle.y + context.base + context.options.ray_start;
    const glm::dvec3 before = foot.velocity;
    foot.velocity = velocity_of(foot, clip, context);  // without ground too: no foot brakes from what it was
    const auto footing_of = [&](const Turned& turned) {
        const glm::dvec3 ankle = plus(clip.ankle, turned.slip);
        return Footing(plus(ankle, turned.heel), plus(ankle, turned.toe), from, context);
    };
    const auto turn_by = [&](const Footing& footing) {
        const glm::dquat goal = footing.alone == FootAlone::No
                                    ? turn_to(footing.normal(), context.options.max_turn)
                                    : glm::dquat{1.0, 0.0, 0.0, 0.0};
        foot.turn =
            context.fresh ? goal : eased_turn(foot.turn, goal, context.eased, turn_speed * context.dt);
    };
    turn_by(footing_of(Turned(foot, clip)));
    const Turned unhindered(foot, clip);
    const ToeWay way(foot, clip, before, plus(plus(clip.ankle, unhindered.slip), unhindered.toe), from,
                     context);
    const glm::dvec3 waited = way.wait();
    const double over_step = way.height(waited);
    foot.offset_x += waited.x, foot.offset_z += waited.z;
    Turned turned(foot, clip);
    Footing footing = footing_of(turned);
    foot.alone = footing.alone;
    FootGoal goal{.slip = turned.slip};
    if (foot.alone != FootAlone::No) return goal;

    if (foot.locked && !foot.edges_known) {
        const glm::dvec3 ankle = plus(clip.ankle, turned.slip);
        keep_off_edges(foot, footing, plus(ankle, turned.heel), plus(ankle, turned.toe), from, context);
        if (context.fresh) {
            foot.lock_x += foot.shift_x, foot.lock_z += foot.shift_z;
            foot.offset_x += foot.shift_x, foot.offset_z += foot.shift_z;
            foot.shift_x = foot.shift_z = 0.0;
            turned = Turned(foot, clip);
            footing = footing_of(turned);
            goal.slip = turned.slip;
        }
    }
    double support = -1e300;
    if (footing.heel) support = std::max(support, footing.heel->height - turned.heel.y);
    if (footing.toe) support = std::max(support, footing.toe->height - turned.toe.y);
    goal.contact = support - clip.ankle.y;
    const double clearance = std::max(0.0, height_over_floor(clip, context)) * (1.0 - foot.planting);
    const glm::dvec3 ankle = plus(clip.ankle, turned.slip);
    // A foot that outruns its lift would only be late over what it races across.
    const bool keeps_up = length(velocity_of(foot, clip, context)) < fastest_swing;
    if (!foot.standing && keeps_up)
        support = std::max(support, heel_clear_of_edge(clip, turned, footing, from, context));
    if (!foot.locked && keeps_up) {
        const double lowest = std::min({turned.heel.y, turned.ball.y, turned.toe.y});
        double highest = over_step;
        // A heel that follows its toe up a step must be over it too.
        if (footing.heel && footing.toe) {
            const glm::dvec3 sole = minus(turned.toe, turned.heel);
            if (footing.toe->height > height_of_plane(*footing.heel, sole.x, sole.z) + step_over_plane)
                highest = std::max(highest, footing.toe->height);
        }
        support = std::max(support, highest - lowest);
        const glm::dvec3 ball = plus(ankle, turned.ball);
        const auto below = context.ground.below({ball.x, from, ball.z});
        if (judge(below, context) == FootAlone::No)
            support = std::max(support, below->height - turned.ball.y);
    }
    goal.lift = clearance + support - clip.ankle.y;
    if (context.dt > 0.0 && !context.fresh) {
        const glm::dvec3 normal = footing.normal(), v = foot.velocity;
        goal.rise = -(normal.x * v.x + normal.z * v.z) / normal.y * context.dt;
    }
    return goal;
}

}  // namespace tendril::humanoid::detail
