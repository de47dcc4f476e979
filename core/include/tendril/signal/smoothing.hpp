// Smoothing filters, which games put between a noisy or jumping number and the screen. Springs, interp_to and
// inertialize have files of their own.
//
// The first step of each returns the input. Cost: 5 to 30 ns each.
#pragma once

#include <cstddef>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// `x += (input - x) (1 - 2^(-dt / halflife))`: the remaining distance halves every `halflife` seconds, at
/// any frame rate.
struct ExponentialDecay {
    double halflife = 0.1;  ///< s, 0 (no smoothing) to 1e4
    bool operator==(const ExponentialDecay&) const = default;
};
double step(const ExponentialDecay& parameters, OutputState& state, double input, double dt,
            Result* why = nullptr) noexcept;

/// Limits the speed, separately up and down.
struct RateLimit {
    double rise = 1.0;  ///< 1/s, 0 to 1e9
    double fall = 1.0;  ///< 1/s, 0 to 1e9
    bool operator==(const RateLimit&) const = default;
};
double step(const RateLimit& parameters, OutputState& state, double input, double dt,
            Result* why = nullptr) noexcept;

/// A value with a velocity.
struct MotionState {
    double value = 0.0;     ///< the last output
    double velocity = 0.0;  ///< 1/s
    bool started = false;
    bool operator==(const MotionState&) const = default;
};

/// Unity's Mathf.SmoothDamp (T. Lowe, "Critically Damped Ease-In/Ease-Out Smoothing", Game Programming Gems
/// 4, 2004): a critically damped spring with 1 / (1 + x + 0.48 x^2 + 0.235 x^3) for exp(-x), x = 2 dt /
/// smooth_time, and the distance clamped to max_speed * smooth_time. If it would pass the input it stops
/// there, velocity 0. Not exact: one step of 0.5 s with smooth_time 0.1 s goes 0.9626 of the way, a spring
/// 0.9995.
struct SmoothDamp {
    double smooth_time = 0.1;  ///< s, 0 to 1e4; under 1e-4 counts as 1e-4
    double max_speed = 1e6;    ///< 1/s, 0 to 1e9
    bool operator==(const SmoothDamp&) const = default;
};
double step(const SmoothDamp& parameters, MotionState& state, double input, double dt,
            Result* why = nullptr) noexcept;

/// The spring found in most games: velocity first, then position (semi-implicit Euler). Unstable if (w dt)^2
/// + 4 z w dt is over 4: at 8 Hz and damping 1 under 60.7 frames per second. Its output then oscillates ever
/// wider, up to max_output.
struct SpringSemiImplicit {
    double strength = 4.0;          ///< Hz, 0 to 1e4
    double critical_damping = 1.0;  ///< 0 to 1e3
    bool operator==(const SpringSemiImplicit&) const = default;
};
double step(const SpringSemiImplicit& parameters, MotionState& state, double input, double dt,
            Result* why = nullptr) noexcept;

/// The 1 Euro filter (G. Casiez, N. Roussel, D. Vogel, CHI 2012): a low pass whose cutoff rises with speed,
/// so that a hand at rest is steady and a hand that moves has little lag. `alpha(c) = 1 / (1 + 1 / (2 pi c
/// dt))`; the derivative is taken against the last output.
struct OneEuro {
    double min_cutoff = 1.0;         ///< Hz, 0 to 1e6
    double beta = 0.1;               ///< Hz per 1/s, 0 to 1e6
    double derivative_cutoff = 1.0;  ///< Hz, 0 to 1e6
    double reset_jump = 0.0;         ///< restart if input and output are farther apart, 0 to 1e9; 0: never
    bool operator==(const OneEuro&) const = default;
};
double step(const OneEuro& parameters, MotionState& state, double input, double dt,
            Result* why = nullptr) noexcept;

/// The mean of the last `window` seconds, each sample weighted by the dt of its own step, the oldest in part.
/// Until the window is full, the mean of all samples.
///
/// Cost: 20 ns per step on average for any window; 32 bytes per sample in it, at times twice that.
struct MovingAverage {
    double window = 0.2;  ///< s, 0 (no smoothing) to 3600
    bool operator==(const MovingAverage&) const = default;
};
struct MovingAverageState {
    struct Entry {
        double dt = 0.0, input = 0.0;
        double time_on = 0.0, area_on = 0.0;  ///< sums of dt and dt * input from this entry up to `split`
        bool operator==(const Entry&) const = default;
    };
    double value = 0.0;  ///< the last output
    bool started = false;
    // A queue with a running sum, as two stacks: nothing is ever subtracted, so no rounding error remains.
    std::vector<Entry> entries{};           ///< oldest first
    std::size_t first = 0;                  ///< entries before this one have left the window
    std::size_t split = 0;                  ///< entries before this one have their sums
    double new_time = 0.0, new_area = 0.0;  ///< sums of the entries from `split` on
    bool operator==(const MovingAverageState&) const = default;
};
double step(const MovingAverage& parameters, MovingAverageState& state, double input, double dt,
            Result* why = nullptr) noexcept;

}  // namespace tendril::signal

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::ExponentialDecay>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::RateLimit>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::SmoothDamp>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::SpringSemiImplicit>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::OneEuro>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::MovingAverage>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::MotionState>() noexcept;
/// All fields but `entries`.
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::MovingAverageState>() noexcept;
