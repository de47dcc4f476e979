#include "tendril/humanoid/footsteps.hpp"

#include <algorithm>
#include <cmath>

#include "humanoid/balance.hpp"
#include "humanoid/input.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;

// Fractions of the leg's length.
constexpr double max_step = 0.9, default_step = 0.5, min_step = 0.08, min_feet_distance = 0.18,
                 max_step_height = 0.5;
constexpr double min_outside = 1e-4;  // minimum BodyState::outside that calls for a step
constexpr double max_standing_height = 0.08;

glm::dvec3 flat(const glm::dvec3& v) noexcept {
    return {v.x, 0.0, v.z};
}
glm::dvec3 shortened(const glm::dvec3& v, double limit) noexcept {
    const double size = length(v);
    return size > limit ? times(v, limit / size) : v;
}

glm::dvec3 step_position(const Footstep& step) noexcept {
    const double ease = step.part * step.part * (3.0 - 2.0 * step.part);
    return mix(step.from, step.to, ease);
}

/// The horizontal pull of the targets on the body.
glm::dvec3 target_pull(const BodyState& body) noexcept {
    glm::dvec3 pull{0.0};
    for (const Effector each : {Effector::Hips, Effector::Head, Effector::LeftHand, Effector::RightHand}) {
        const auto i = static_cast<std::size_t>(each);
        if (!(body.weights[i] > 0.0)) continue;
        const glm::dvec3 way = flat(body.left[i]);
        if (dot(way, way) > dot(pull, pull)) pull = way;
    }
    return pull;
}

/// Height of the ground below the sole shifted by `to`, relative to the ground below the clip's sole. nullopt
/// if there is no ground, or if the step from the sole shifted by `from` is too high.
std::optional<double> step_height(const SolePoints& sole, const glm::dvec3& from, const glm::dvec3& to,
                                  const Ground* ground, double leg) noexcept {
    if (ground == nullptr) return 0.0;
    const auto height = [&](const glm::dvec3& by) -> std::optional<double> {
        const auto heel = ground->highest(sole.heel.x + by.x, sole.heel.z + by.z);
        const auto toe = ground->highest(sole.toe.x + by.x, sole.toe.z + by.z);
        if (!heel || !toe) return std::nullopt;
        return std::max(heel->height, toe->height);
    };
    const auto clip = height(glm::dvec3(0.0)), before = height(from), after = height(to);
    if (!clip || !before || !after || std::abs(*after - *before) > max_step_height * leg) return std::nullopt;
    return *after - *clip;
}

bool start_step(Footstep& step, const glm::dvec3& to) noexcept {
    step = {step.to, to, 0.0};
    return true;
}

}  // namespace

Result check(const FootstepsState& state) noexcept {
    return check_fields("footsteps", state);
}

std::array<FootShift, 2> advance_steps(FootstepsState& state, const Soles& soles, double dt,
                                       const FootstepOptions& options) noexcept {
    if (!check(state)) state = {};
    const auto clamped = [&](const Field& option) {
        const double value = option.number(&options);
        return value >= option.range.low ? std::min(value, option.range.high) : option.range.low;
    };
    const double seconds = clamped(field_of<&FootstepOptions::seconds>()),
                 lift = clamped(field_of<&FootstepOptions::lift>());
    std::array<FootShift, 2> shifts;
    for (std::size_t side = 0; side < 2; ++side) {
        Footstep& step = state.feet[side];
        if (dt > 0.0 && step.part < 1.0) step.part = std::min(step.part + dt / seconds, 1.0);
        if (step.part >= 1.0) step = {step.to, step.to, 1.0};
        const double arc = 4.0 * step.part * (1.0 - step.part);
        shifts[side] = {step_position(step),
                        arc * (lift * soles.leg + 0.5 * std::abs(step.to.y - step.from.y))};
    }
    return shifts;
}

bool plan_step(FootstepsState& state, const Soles& soles, const glm::dvec3& centre,
               std::span<const Placement> clip, const BodyState& body, const Ground* ground) noexcept {
    if (state.stepping()) return false;
    const bool has_targets =
        std::any_of(body.weights.begin(), body.weights.end(), [](double each) { return each > 0.0; });
    const double leg = soles.leg;
    if (!has_targets) {  // back to the clip, the further foot first
        const double left = length(state.feet[0].to), right = length(state.feet[1].to);
        if (!(left > 0.0 || right > 0.0)) return false;
        return start_step(state.feet[left >= right ? 0 : 1], glm::dvec3(0.0));
    }
    const glm::dvec3 pull = target_pull(body);
    double hold = body.outside;  // caused by balance, or by a fully stretched leg
    for (const Effector foot : {Effector::LeftFoot, Effector::RightFoot})
        hold = std::max(hold, length(body.left[static_cast<std::size_t>(foot)]));
    if (!(hold > min_outside * leg && length(pull) > no_step_within * leg)) return false;
    for (const Effector foot : {Effector::LeftFoot, Effector::RightFoot})
        if (body.weights[static_cast<std::size_t>(foot)] > 0.0) return false;
    const std::array<SolePoints, 2> at = sole_points(soles, clip);
    const auto over = detail::sole_heights(at, ground);
    glm::dvec3 forward = plus(flat(minus(at[0].toe, at[0].heel)), flat(minus(at[1].toe, at[1].heel)));
    forward = direction_of(forward, 1e-9 * leg).value_or(soles.forward);
    const glm::dvec3 left{forward.z, 0.0, -forward.x};
    const double far = std::clamp(length(pull), default_step * leg, max_step * leg);
    const glm::dvec3 capture = plus(flat(centre), times(pull, far / length(pull)));
    std::array<glm::dvec3, 2> stands;
    for (std::size_t side = 0; side < 2; ++side) {
        if (std::min(over[side].heel, over[side].toe) > max_standing_height * leg) return false;
        stands[side] = plus(flat(mix(at[side].heel, at[side].toe, 0.5)), flat(state.feet[side].to));
    }
    const std::size_t near = length(minus(capture, stands[0])) <= length(minus(capture, stands[1])) ? 0 : 1;
    for (const std::size_t side : {near, 1 - near}) {
        const glm::dvec3& other = stands[1 - side];
        const glm::dvec3 aside = times(left, side == 0 ? 1.0 : -1.0);
        glm::dvec3 way = minus(capture, other);
        way = plus(way, times(aside, std::max(min_feet_distance * leg - dot(way, aside), 0.0)));
        way = shortened(way, max_step * leg);
        for (const double part : {1.0, 0.8, 0.6, 0.4}) {  // shorter steps if the ground requires it
            const glm::dvec3 there = mix(stands[side], plus(other, way), part);
            if (length(minus(capture, there)) > length(minus(capture, stands[side])) - min_step * leg) break;
            glm::dvec3 to = plus(flat(state.feet[side].to), minus(there, stands[side]));
            const auto up = step_height(at[side], state.feet[side].to, to, ground, leg);
            if (!up) continue;
            to.y = *up;
            return start_step(state.feet[side], to);
        }
    }
    return false;
}

}  // namespace tendril::humanoid
