#include "tendril/signal/scale_bias_clamp.hpp"

#include "signal/stepped.hpp"
#include "tendril/signal/interpolate.hpp"

namespace tendril::signal {
namespace {

/// The first three stages. Bounded by max_output, even for the narrowest in_range.
double without_memory(const ScaleBiasClamp& parameters, double value) noexcept {
    if (parameters.map_range) {
        const auto [in_low, in_high] = parameters.in_range;
        const auto [out_low, out_high] = parameters.out_range;
        const double width = in_high - in_low;
        const double part = width != 0.0 ? detail::bounded((value - in_low) / width) : 0.0;
        value = out_low + part * (out_high - out_low);
    }
    value = detail::bounded(value * parameters.scale + parameters.bias);
    if (parameters.clamp) value = std::min(std::max(value, parameters.clamp_min), parameters.clamp_max);
    return value;
}

/// interp_to without its limit on magnitude, which earlier stages may exceed.
double eased(double from, double to, double speed, double dt) noexcept {
    if (!(speed > 0.0) || detail::squared_distance(from, to) < 1e-8 || dt * speed >= 1.0) return to;
    return from + (to - from) * (dt * speed);
}

}  // namespace

double step(const ScaleBiasClamp& parameters, OutputState& state, double input, double dt,
            Result* why) noexcept {
    const auto wanted = [&] { return without_memory(parameters, input); };
    return detail::stepped(
        state, input, dt, [&](double) { return detail::output(wanted()); },
        [&](double time) {
            const double to = wanted();
            const double speed =
                to >= state.value ? parameters.speed_increasing : parameters.speed_decreasing;
            state.value = parameters.interp ? eased(state.value, to, speed, time) : to;
        },
        why);
}

}  // namespace tendril::signal
