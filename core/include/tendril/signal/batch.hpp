// Springs and interp_to for thousands of values at once: crowds, particles, hair tips, panels full of
// springs.
//
//     signal::SpringArrays springs{.strength = strength, .critical_damping = damping, .target = target,
//                                  .value = value, .velocity = velocity, .previous_target = previous};
//     start_springs(springs);         // once
//     step_springs(springs, dt);      // every frame
//
// Method: that of spring.hpp and interpolate.hpp in floats, with the widest vector unit that this machine has
// (Highway chooses it at run time); each value has its own parameters. All vector units give the same bits.
//
// Against spring.hpp, which works in double: values differ by at most 1e-6 of |value| + |target| + by how
// much force and target velocity shift it + |velocity| / w, and by as much again for each swing within one dt
// (and velocities by that times w). So a dt of minutes is stable and finite, but the phase of a spring
// without damping is then lost. Magnitudes under 1e-25 count as 0. interp_to differs by 1e-6 of the distance.
//
// A vector is three springs with the same parameters.
//
// Cost: O(values), no allocation, no thread. Any part of the arrays may be stepped apart from the rest, so a
// job system takes subspans. Over a plain loop of `step`, 1e3 to 1e6 springs, one thread, the least of all
// kinds of damping (tests/bench/signal.cpp): 10 times the throughput with AVX-512, 6 times with AVX2, 3.5
// times with SSE4; interp_to 13 times and more, where memory is the limit.
#pragma once

#include <span>
#include <string_view>

#include "tendril/result.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// One float a spring in each list, all of the same length; the meanings and ranges of Spring and
/// SpringState. `force` and `target_velocity_amount` may be left empty: 0. No two lists overlap.
struct SpringArrays {
    std::span<const float> strength, critical_damping;
    std::span<const float> force{}, target_velocity_amount{};
    std::span<const float> target;
    std::span<float> value, velocity, previous_target;
};

struct BatchOptions {
    /// One of ik::vector_units(), for comparing; the widest where left empty.
    std::string_view vector_unit{};
};

/// Puts every spring on its target, shifted by its force, at rest. Springs that step_springs would leave
/// alone get 0 for what is out of range. InvalidArgument for lists of different lengths.
Result start_springs(const SpringArrays& springs) noexcept;

/// Lets `dt` seconds pass. A spring with a parameter, target or state that is not finite or out of its range
/// (states: 1e30) is left alone, as all are where dt is refused (input.hpp). InvalidArgument for lists of
/// different lengths and for an unknown vector unit.
Result step_springs(const SpringArrays& springs, double dt, const BatchOptions& options = {}) noexcept;

/// interp_to of every value, in place. A target that is refused leaves its value alone. Errors as above.
Result interp_to(std::span<float> current, std::span<const float> target, std::span<const float> speed,
                 double dt, const BatchOptions& options = {}) noexcept;
/// interp_to_exact of every value, in place.
Result interp_to_exact(std::span<float> current, std::span<const float> target, std::span<const float> speed,
                       double dt, const BatchOptions& options = {}) noexcept;

}  // namespace tendril::signal
