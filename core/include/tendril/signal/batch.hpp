// Springs and interp_to for thousands of values at once: crowds, particles, hair tips, panels full of
// springs.
//
//     signal::SpringArrays springs{.strength = strength, .critical_damping = damping, .target = target,
//                                  .value = value, .velocity = velocity, .previous_target = previous};
//     start_springs(springs);         // once
//     step_springs(springs, dt);      // every frame
//
// Method: as in spring.hpp and interpolate.hpp, but in floats and with the widest vector unit of the machine
// (Highway chooses it at run time). Each value has its own parameters. All vector units give the same bits.
//
// Compared with spring.hpp, which computes in double: values differ by at most 1e-6 of |value| + |target| +
// the target's shift by force and target velocity + |velocity| / w, and by as much again for each oscillation
// within one dt (velocities by w times that). So a dt of minutes is stable and finite, but the phase of an
// undamped spring is lost. Magnitudes under 1e-25 count as 0. interp_to differs by 1e-6 of the distance.
//
// A vector is three springs with the same parameters.
//
// Cost: O(values), no allocation, no threads. Any part of the arrays may be stepped separately, so a job
// system can pass subspans. Compared with a loop of `step`, for 1e3 to 1e6 springs on one thread, minimum
// over all kinds of damping (tests/bench/signal.cpp): 10 times the throughput with AVX-512, 6 times with
// AVX2, 3.5 times with SSE4; interp_to at least 13 times, limited by memory.
#pragma once

#include <span>
#include <string_view>

#include "tendril/result.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// One float per spring in each list, all of the same length, with the meanings and ranges of Spring and
/// SpringState. An empty `force` or `target_velocity_amount` counts as 0. The lists must not overlap.
struct SpringArrays {
    std::span<const float> strength, critical_damping;
    std::span<const float> force{}, target_velocity_amount{};
    std::span<const float> target;
    std::span<float> value, velocity, previous_target;
};

struct BatchOptions {
    /// One of ik::vector_units(), for comparisons; empty: the widest.
    std::string_view vector_unit{};
};

/// Puts every spring at its target, shifted by its force, at rest. With an invalid strength, damping, force
/// or target its value, velocity and previous target become 0. InvalidArgument for lists of different
/// lengths.
Result start_springs(const SpringArrays& springs) noexcept;

/// Lets `dt` seconds pass. A spring with a parameter, target or state that is not finite or out of its range
/// (states: 1e30) is unchanged, as are all springs if dt is refused (input.hpp). InvalidArgument for lists of
/// different lengths and for an unknown vector unit.
Result step_springs(const SpringArrays& springs, double dt, const BatchOptions& options = {}) noexcept;

/// interp_to of every value, in place. A refused target leaves its value unchanged. Errors as above.
Result interp_to(std::span<float> current, std::span<const float> target, std::span<const float> speed,
                 double dt, const BatchOptions& options = {}) noexcept;
/// interp_to_exact of every value, in place.
Result interp_to_exact(std::span<float> current, std::span<const float> target, std::span<const float> speed,
                       double dt, const BatchOptions& options = {}) noexcept;

}  // namespace tendril::signal
