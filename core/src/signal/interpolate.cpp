#include "tendril/signal/interpolate.hpp"

#include "signal/stepped.hpp"
#include "tendril/elementary.hpp"

namespace tendril::signal {
namespace {

/// `part_of(dt)` is the part of the way to move, at least 0. Within the squared distance `arrived` the result
/// is the target.
template <class T, class Part>
T interpolated(const T& current, const T& target, double dt, double speed, double arrived,
               const Part& part_of) noexcept {
    if (!is_input(target) || !is_step(dt)) return current;
    if (!(speed > 0.0) || !is_input(current)) return target;
    const auto from = detail::wide(current), to = detail::wide(target);
    if (detail::squared_distance(from, to) < arrived) return target;
    const double part = part_of(detail::bounded_dt(dt));
    if (part >= 1.0) return target;
    return detail::narrow<T>(detail::moved(from, detail::times(detail::displacement(from, to), part)));
}

template <class T>
T by_steps(const T& current, const T& target, double dt, double speed) noexcept {
    return interpolated(current, target, dt, speed, 1e-8, [&](double time) { return time * speed; });
}
template <class T>
T exactly(const T& current, const T& target, double dt, double speed) noexcept {
    return interpolated(current, target, dt, speed, 0.0,
                        [&](double time) { return 1.0 - math::decay(time * speed); });
}

}  // namespace

float interp_to(float current, float target, double dt, double speed) noexcept {
    return by_steps(current, target, dt, speed);
}
double interp_to(double current, double target, double dt, double speed) noexcept {
    return by_steps(current, target, dt, speed);
}
glm::vec3 interp_to(const glm::vec3& current, const glm::vec3& target, double dt, double speed) noexcept {
    return by_steps(current, target, dt, speed);
}
glm::dvec3 interp_to(const glm::dvec3& current, const glm::dvec3& target, double dt, double speed) noexcept {
    return by_steps(current, target, dt, speed);
}
glm::quat interp_to(const glm::quat& current, const glm::quat& target, double dt, double speed) noexcept {
    return by_steps(current, target, dt, speed);
}
glm::dquat interp_to(const glm::dquat& current, const glm::dquat& target, double dt, double speed) noexcept {
    return by_steps(current, target, dt, speed);
}

float interp_to_exact(float current, float target, double dt, double speed) noexcept {
    return exactly(current, target, dt, speed);
}
double interp_to_exact(double current, double target, double dt, double speed) noexcept {
    return exactly(current, target, dt, speed);
}
glm::vec3 interp_to_exact(const glm::vec3& current, const glm::vec3& target, double dt,
                          double speed) noexcept {
    return exactly(current, target, dt, speed);
}
glm::dvec3 interp_to_exact(const glm::dvec3& current, const glm::dvec3& target, double dt,
                           double speed) noexcept {
    return exactly(current, target, dt, speed);
}
glm::quat interp_to_exact(const glm::quat& current, const glm::quat& target, double dt,
                          double speed) noexcept {
    return exactly(current, target, dt, speed);
}
glm::dquat interp_to_exact(const glm::dquat& current, const glm::dquat& target, double dt,
                           double speed) noexcept {
    return exactly(current, target, dt, speed);
}

double step(const InterpTo& parameters, OutputState& state, double input, double dt, Result* why) noexcept {
    return detail::stepped(
        state, input, dt, [&](double) { return detail::output(input); },
        [&](double time) { state.value = by_steps(state.value, input, time, parameters.speed); }, why);
}
double step(const InterpToExact& parameters, OutputState& state, double input, double dt,
            Result* why) noexcept {
    return detail::stepped(
        state, input, dt, [&](double) { return detail::output(input); },
        [&](double time) { state.value = exactly(state.value, input, time, parameters.speed); }, why);
}

}  // namespace tendril::signal
