// The units that are filters of the signal module.
#include <cmath>

#include "rig/math.hpp"
#include "rig/runner.hpp"
#include "tendril/signal/curve.hpp"
#include "tendril/signal/scale_bias_clamp.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::rig {
namespace {

/// Smaller changes and speeds count as rest; in metres, radians or plain numbers.
constexpr double min_motion = 1e-9;

double blended(double from, double to, double weight) noexcept {
    return from + (to - from) * weight;
}
glm::dvec3 blended(const glm::dvec3& from, const glm::dvec3& to, double weight) noexcept {
    return detail::mix(from, to, weight);
}
glm::dquat blended(const glm::dquat& from, const glm::dquat& to, double weight) noexcept {
    return blend(from, to, weight);
}
double difference(double a, double b) noexcept {
    return a - b;
}
glm::dvec3 difference(const glm::dvec3& a, const glm::dvec3& b) noexcept {
    return detail::minus(a, b);
}
double size(double rate) noexcept {
    return std::abs(rate);
}
double size(const glm::dvec3& rate) noexcept {
    return detail::length(rate);
}

}  // namespace

void Runner::operator()(const AlphaInterpolate& op) noexcept {
    const double value = read(op.value);
    const signal::ScaleBiasClamp parameters{.map_range = read(op.map_range),
                                            .in_range = op.in_range,
                                            .out_range = op.out_range,
                                            .scale = read(op.scale),
                                            .bias = read(op.bias),
                                            .clamp = read(op.clamp),
                                            .clamp_min = read(op.clamp_min),
                                            .clamp_max = read(op.clamp_max),
                                            .interp = read(op.interp),
                                            .speed_increasing = read(op.speed_increasing),
                                            .speed_decreasing = read(op.speed_decreasing)};
    if (skipped_) return set_output(0, value);
    if (!std::holds_alternative<signal::OutputState>(memory().held)) memory().held = signal::OutputState();
    auto& state = std::get<signal::OutputState>(memory().held);
    const signal::OutputState before = state;
    if (!parameters.interp) {
        // Without easing the input takes effect at once, even in a step of zero time.
        signal::OutputState at_once{.value = before.value};
        set_output(0, blended(value, signal::step(parameters, at_once, value, dt_), weight_));
        if (at_once.started) state = at_once;
        return;
    }
    const double result = signal::step(parameters, state, value, dt_);
    moving_ |= std::abs(state.value - before.value) > min_motion;
    set_output(0, blended(value, result, weight_));
}

template <class T>
void Runner::spring(const SpringInterpolate& op, const T& target) noexcept {
    using Rate = signal::Rate<T>;
    if (skipped_) {
        set_output(0, target);
        return set_output(1, Rate{});
    }
    signal::Spring<T> parameters{.strength = parameter(op.strength, signal::max_strength),
                                 .critical_damping = parameter(op.critical_damping, signal::max_damping),
                                 .target_velocity_amount = parameter(op.target_velocity_amount, 1.0)};
    if (op.force) parameters.force = std::get<Rate>(read(*op.force));
    using Memory = signal::SpringState<T>;
    if (!std::holds_alternative<Memory>(memory().held)) memory().held = Memory();
    auto& state = std::get<Memory>(memory().held);
    const Rate before = state.velocity;
    const T result = signal::step(parameters, state, target, dt_);
    // The velocity is 0 at a turning point, and before a force without a spring has moved the value; neither
    // is rest.
    moving_ |= size(state.velocity) > min_motion || size(difference(state.velocity, before)) > min_motion ||
               (parameters.strength < signal::no_strength && size(parameters.force) > min_motion);
    set_output(0, blended(target, result, weight_));
    set_output(1, state.velocity);
}

void Runner::operator()(const SpringInterpolate& op) noexcept {
    const Value target = read(op.target);
    if (const auto* number = std::get_if<double>(&target)) return spring(op, *number);
    if (const auto* vector = std::get_if<glm::dvec3>(&target)) return spring(op, *vector);
    spring(op, std::get<glm::dquat>(target));
}

void Runner::operator()(const EvaluateCurve& op) noexcept {
    const double value = read(op.value);
    set_output(0, blended(value, signal::evaluate(op.curve, value), weight_));
}

void Runner::operator()(const SetCurve& op) noexcept {
    double& curve = state_.curves[static_cast<std::size_t>(op.resolved.index)];
    const double to = blended(curve, read(op.value), weight_);
    if (weight_ > 0.0 && is_in_range(to)) curve = to;
    set_output(0, curve);
}

}  // namespace tendril::rig
