// The rule of input.hpp, implemented once for all filters. Not installed.
#pragma once

#include <algorithm>

#include "signal/space.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal::detail {

static inline double bounded_dt(double dt) noexcept {
    return std::clamp(dt, min_dt, max_dt);
}

/// One step of a filter. `start(dt)` returns the state after a first step; `advance(dt)` changes `state` in
/// any later one. Both get a dt within bounds, and are not called for a refused input.
template <class State, class Start, class Advance>
double stepped(State& state, double input, double dt, const Start& start, const Advance& advance) noexcept {
    if (!is_input(input)) return state.value;
    const bool advances = is_step(dt);
    if (!state.started) {
        State first = start(bounded_dt(advances ? dt : min_dt));
        first.value = bounded(first.value);
        if (!advances) return first.value;
        first.started = true;
        state = std::move(first);
    } else if (advances) {
        advance(bounded_dt(dt));
        state.value = bounded(state.value);
    }
    return state.value;
}

/// The first state of a filter that remembers at most its last output.
static inline OutputState output(double value) noexcept {
    return {.value = value};
}

}  // namespace tendril::signal::detail
