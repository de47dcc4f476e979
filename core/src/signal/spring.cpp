#include "tendril/signal/spring.hpp"

#include <limits>

#include "math/checks.hpp"
#include "signal/motion.hpp"
#include "signal/spring_rows.hpp"
#include "signal/stepped.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::SpringState<double>>() noexcept {
    return signal::detail::spring_rows;
}

namespace tendril::signal {
namespace {

using tendril::detail::refused;

template <class T>
bool in_range(const Spring<T>& spring) noexcept {
    return spring.strength >= 0.0 && spring.strength <= max_strength && spring.critical_damping >= 0.0 &&
           spring.critical_damping <= max_damping && is_input(spring.force) &&
           spring.target_velocity_amount >= 0.0 && spring.target_velocity_amount <= 1.0;
}

template <class T>
Result check(const Spring<T>& spring) noexcept {
    const Spring<> numbers{spring.strength, spring.critical_damping, 0.0, spring.target_velocity_amount};
    if (const Result bad = check_fields("step", numbers); !bad || in_range(spring)) return bad;
    return tendril::detail::refused("step", "force", "finite and at most 1e9 in magnitude",
                                    "one that is not");
}

/// The target shifted by the force.
template <class T>
auto shifted(const Spring<T>& spring, const T& target) noexcept {
    const auto position = detail::wide(target);
    if (spring.strength < no_strength) return position;
    const double w = 2.0 * math::pi * spring.strength;
    return detail::moved(position, detail::times(detail::wide(spring.force), 1.0 / (w * w)));
}

}  // namespace

template <class T>
T step(const Spring<T>& spring, SpringState<T>& state, const std::type_identity_t<T>& target, double dt,
       Result* why) noexcept {
    using namespace detail;
    if (why != nullptr && (*why = reason_of(target, dt))) *why = check(spring);
    if (!is_input(target) || !in_range(spring)) return state.value;
    if (!state.started) {
        const T first = narrow<T>(shifted(spring, target));
        if (is_step(dt)) state = {first, Rate<T>{}, target, true};
        return first;
    }
    if (!is_step(dt)) return state.value;

    const double t = bounded_dt(dt), w = 2.0 * math::pi * spring.strength;
    const bool is_spring = spring.strength >= no_strength;
    auto goal = shifted(spring, target);
    auto velocity = wide(state.velocity);
    if (!is_spring) velocity = plus(velocity, times(wide(spring.force), t));
    if (is_spring && spring.target_velocity_amount > 0.0) {
        const auto target_velocity =
            times(displacement(wide(state.previous_target), wide(target)), spring.target_velocity_amount / t);
        goal = moved(goal, times(target_velocity, 2.0 * spring.critical_damping / w));
    }
    const Motion motion = motion_of(is_spring ? spring.strength : 0.0, spring.critical_damping, t);
    const auto error = displacement(goal, wide(state.value));
    state.value = narrow<T>(moved(goal, plus(times(error, motion.x_by_x), times(velocity, motion.x_by_v))));
    state.velocity = narrow<Rate<T>>(plus(times(error, motion.v_by_x), times(velocity, motion.v_by_v)));
    state.previous_target = target;
    return state.value;
}

template double step(const Spring<double>&, SpringState<double>&, const double&, double, Result*) noexcept;
template float step(const Spring<float>&, SpringState<float>&, const float&, double, Result*) noexcept;
template glm::dvec3 step(const Spring<glm::dvec3>&, SpringState<glm::dvec3>&, const glm::dvec3&, double,
                         Result*) noexcept;
template glm::vec3 step(const Spring<glm::vec3>&, SpringState<glm::vec3>&, const glm::vec3&, double,
                        Result*) noexcept;
template glm::dquat step(const Spring<glm::dquat>&, SpringState<glm::dquat>&, const glm::dquat&, double,
                         Result*) noexcept;
template glm::quat step(const Spring<glm::quat>&, SpringState<glm::quat>&, const glm::quat&, double,
                        Result*) noexcept;

SpringFeel feel_of(double strength, double critical_damping) noexcept {
    constexpr double never = std::numeric_limits<double>::infinity();
    const double rate = 2.0 * math::pi * strength * critical_damping;
    return {.half_life = rate > 0.0 ? 2.0 * math::ln2 / rate : never,
            .duration = strength > 0.0 ? 1.0 / strength : never,
            .bounce = critical_damping <= 1.0 ? 1.0 - critical_damping : 1.0 / critical_damping - 1.0};
}

Expected<SpringShape> of_half_life(double half_life, double critical_damping) noexcept {
    if (!(critical_damping > 0.0 && critical_damping <= max_damping))
        return refused("of_half_life", "critical_damping", "over 0 and at most 1000", critical_damping);
    const double strength = math::ln2 / (math::pi * critical_damping * half_life);
    if (!(half_life > 0.0 && strength > 0.0 && strength <= max_strength))
        return refused("of_half_life", "half_life", "such that the strength is over 0 and at most 10000 Hz",
                       half_life);
    return SpringShape{strength, critical_damping};
}

Expected<SpringShape> of_duration(double duration, double bounce) noexcept {
    if (!(duration >= 1.0 / max_strength && duration <= max_dt))
        return refused("of_duration", "duration", "from 1e-4 to 1e9 s", duration);
    if (!(bounce >= 1.0 / max_damping - 1.0 && bounce <= 1.0))
        return refused("of_duration", "bounce", "from -0.999 to 1", bounce);
    return SpringShape{1.0 / duration, bounce >= 0.0 ? 1.0 - bounce : 1.0 / (1.0 + bounce)};
}

}  // namespace tendril::signal
