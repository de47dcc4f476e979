#include "tendril/signal/inertialize.hpp"

#include "signal/motion.hpp"
#include "signal/stepped.hpp"

namespace tendril::signal {
namespace {

void advance(const Inertialize& parameters, InertializeState& state, double input, double dt) noexcept {
    const double change = input - state.input;
    const bool jumps = std::abs(change) > parameters.threshold;
    if (jumps) {
        state.offset = state.value - input;
        state.offset_velocity = state.velocity;
    } else if (state.jumped) {
        state.offset_velocity -= change / dt;
    }
    // A critically damped spring with that w; its strength in Hz is w / (2 pi).
    const double strength = math::ln2 / (math::pi * std::max(parameters.halflife, 1e-6));
    const detail::Motion motion = detail::motion_of(strength, 1.0, dt);
    const double offset = state.offset, velocity = state.offset_velocity, before = state.value;
    state.offset = motion.x_by_x * offset + motion.x_by_v * velocity;
    state.offset_velocity = motion.v_by_x * offset + motion.v_by_v * velocity;
    state.value = input + state.offset;
    state.velocity = (state.value - before) / dt;
    state.input = input;
    state.jumped = jumps;
}

}  // namespace

double step(const Inertialize& parameters, InertializeState& state, double input, double dt,
            Result* why) noexcept {
    return detail::stepped(
        state, input, dt, [&](double) { return InertializeState{.value = input, .input = input}; },
        [&](double time) { advance(parameters, state, input, time); }, why);
}

}  // namespace tendril::signal
