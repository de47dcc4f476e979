// A queue with a running sum, as two stacks. New entries are summed as they arrive. When the old stack is
// empty, all entries move to it, each with the sum from itself to the newest, and then leave one by one. A
// single running sum from which entries are subtracted would keep the rounding error of the largest value
// ever seen.
#include "signal/stepped.hpp"
#include "tendril/signal/smoothing.hpp"

namespace tendril::signal {
namespace {

using Entry = MovingAverageState::Entry;

double time_in(const MovingAverageState& state) noexcept {
    return state.new_time + (state.first < state.split ? state.entries[state.first].time_on : 0.0);
}
double area_in(const MovingAverageState& state) noexcept {
    return state.new_area + (state.first < state.split ? state.entries[state.first].area_on : 0.0);
}

void push(MovingAverageState& state, double dt, double input) noexcept {
    state.entries.push_back({.dt = dt, .input = input});
    state.new_time += dt;
    state.new_area += dt * input;
}

/// Drops entries that have left the window, and sums the others from the newest back.
void refill_old(MovingAverageState& state) noexcept {
    state.entries.erase(state.entries.begin(),
                        state.entries.begin() + static_cast<std::ptrdiff_t>(state.first));
    double time = 0.0, area = 0.0;
    for (auto entry = state.entries.rbegin(); entry != state.entries.rend(); ++entry) {
        entry->time_on = time += entry->dt;
        entry->area_on = area += entry->dt * entry->input;
    }
    state.first = 0;
    state.split = state.entries.size();
    state.new_time = state.new_area = 0.0;
}

/// Drops entries entirely older than the window; the newest stays.
void drop_old(MovingAverageState& state, double window) noexcept {
    while (state.first + 1 < state.entries.size()) {
        if (state.first == state.split) refill_old(state);
        if (time_in(state) - state.entries[state.first].dt < window) break;
        ++state.first;
    }
}

void add_sample(MovingAverageState& state, double window, double dt, double input) noexcept {
    push(state, dt, input);
    drop_old(state, window);
    const Entry& oldest = state.entries[state.first];
    const double time = time_in(state), excess = std::max(time - window, 0.0);
    // The newest sample fills the window alone if it is at least as long.
    if (excess >= time || state.first + 1 == state.entries.size()) {
        state.value = input;
    } else {
        state.value = (area_in(state) - excess * oldest.input) / (time - excess);
    }
}

}  // namespace

double step(const MovingAverage& parameters, MovingAverageState& state, double input, double dt,
            Result* why) noexcept {
    return detail::stepped(
        state, input, dt,
        [&](double time) {
            MovingAverageState first;
            add_sample(first, parameters.window, time, input);
            return first;
        },
        [&](double time) { add_sample(state, parameters.window, time, input); }, why);
}

}  // namespace tendril::signal
