#include "tendril/signal/smoothing.hpp"

#include "signal/stepped.hpp"
#include "tendril/elementary.hpp"

namespace tendril::signal {
namespace {

MotionState at_rest(double value) noexcept {
    return {.value = value};
}

}  // namespace

double step(const ExponentialDecay& parameters, OutputState& state, double input, double dt,
            Result* why) noexcept {
    return detail::stepped(
        state, input, dt, [&](double) { return detail::output(input); },
        [&](double time) {
            const double halves = time / std::max(parameters.halflife, min_dt);
            state.value = input + (state.value - input) * math::decay(math::ln2 * halves);
        },
        why);
}

double step(const RateLimit& parameters, OutputState& state, double input, double dt, Result* why) noexcept {
    return detail::stepped(
        state, input, dt, [&](double) { return detail::output(input); },
        [&](double time) {
            const double change = input - state.value;
            const double limit = (change > 0.0 ? parameters.rise : parameters.fall) * time;
            if (std::abs(change) <= limit) {
                state.value = input;
            } else {
                state.value += change > 0.0 ? limit : -limit;
            }
        },
        why);
}

double step(const SmoothDamp& parameters, MotionState& state, double input, double dt, Result* why) noexcept {
    const auto advance = [&](double time) {
        const double smooth_time = std::max(parameters.smooth_time, 1e-4), w = 2.0 / smooth_time;
        const double x = w * time, left = 1.0 / (1.0 + x + 0.48 * x * x + 0.235 * x * x * x);
        const double furthest = parameters.max_speed * smooth_time, before = state.value;
        const double distance = std::clamp(before - input, -furthest, furthest);
        const double goal = before - distance;
        const double gained = (state.velocity + w * distance) * time;
        state.velocity = detail::bounded((state.velocity - w * gained) * left);
        state.value = goal + (distance + gained) * left;
        const bool was_under = input > before, is_over = state.value > input;
        if (was_under == is_over) state = {.value = input, .velocity = 0.0, .started = true};
    };
    return detail::stepped(
        state, input, dt, [&](double) { return at_rest(input); }, advance, why);
}

double step(const SpringSemiImplicit& parameters, MotionState& state, double input, double dt,
            Result* why) noexcept {
    const auto advance = [&](double time) {
        const double w = 2.0 * math::pi * parameters.strength;
        const double force =
            w * w * (input - state.value) - 2.0 * parameters.critical_damping * w * state.velocity;
        state.velocity = detail::bounded(state.velocity + force * time);
        state.value += state.velocity * time;
    };
    return detail::stepped(
        state, input, dt, [&](double) { return at_rest(input); }, advance, why);
}

double step(const OneEuro& parameters, MotionState& state, double input, double dt, Result* why) noexcept {
    const auto advance = [&](double time) {
        const auto alpha = [time](double cutoff) {
            const double ratio = 2.0 * math::pi * cutoff * time;
            return ratio / (1.0 + ratio);
        };
        if (parameters.reset_jump > 0.0 && std::abs(input - state.value) > parameters.reset_jump) {
            state.value = input;
            state.velocity = 0.0;
            return;
        }
        const double slope = (input - state.value) / time;
        state.velocity += alpha(parameters.derivative_cutoff) * (slope - state.velocity);
        const double cutoff = parameters.min_cutoff + parameters.beta * std::abs(state.velocity);
        state.value += alpha(cutoff) * (input - state.value);
    };
    return detail::stepped(
        state, input, dt, [&](double) { return at_rest(input); }, advance, why);
}

}  // namespace tendril::signal
