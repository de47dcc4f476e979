#include "tendril/signal/shaping.hpp"

#include "signal/stepped.hpp"

namespace tendril::signal {

double step(const DeadZone& parameters, OutputState& state, double input, double dt, Result* why) noexcept {
    const auto shaped = [&] {
        const double outside = std::max(std::abs(input) - parameters.width, 0.0);
        return input < 0.0 ? 0.0 - outside : outside;  // never -0
    };
    return detail::stepped(
        state, input, dt, [&](double) { return detail::output(shaped()); },
        [&](double) { state.value = shaped(); }, why);
}

double step(const Hysteresis& parameters, OutputState& state, double input, double dt, Result* why) noexcept {
    const auto switched = [&](double before) {
        if (input >= parameters.high) return 1.0;
        return input <= parameters.low ? 0.0 : before;
    };
    return detail::stepped(
        state, input, dt, [&](double) { return detail::output(switched(0.0)); },
        [&](double) { state.value = switched(state.value); }, why);
}

}  // namespace tendril::signal
