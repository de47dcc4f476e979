// The rule of input.hpp, implemented once for all filters. Not installed.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "math/checks.hpp"
#include "signal/space.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal::detail {

static inline double bounded_dt(double dt) noexcept {
    return std::clamp(dt, min_dt, max_dt);
}

/// Why a step changes nothing, for callers that ask. Time that stands still is no mistake.
template <class T>
Result reason_of(const T& input, double dt) noexcept {
    using tendril::detail::refused;
    if (!is_input(input)) {
        constexpr const char* range = "finite and at most 1e9 in magnitude";
        if constexpr (std::is_floating_point_v<T>) return refused("step", "input", range, input);
        return refused("step", "input", range, "one that is not");
    }
    const bool passes = dt >= 0.0 && dt <= std::numeric_limits<double>::max();
    return passes ? Result() : refused("step", "dt", "finite and not negative", dt);
}

/// One step of a filter. `start(dt)` returns the state after a first step; `advance(dt)` changes `state` in
/// any later one. Both get a dt within bounds, and are not called for a refused input.
template <class State, class Start, class Advance>
double stepped(State& state, double input, double dt, const Start& start, const Advance& advance,
               Result* why) noexcept {
    if (why != nullptr) *why = reason_of(input, dt);
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
