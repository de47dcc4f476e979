// A damped spring towards a moving target, for numbers, vectors and rotations.
//
//     signal::Spring<glm::vec3> hat{.strength = 3.0, .critical_damping = 0.4};
//     signal::SpringState<glm::vec3> state;  // the first step starts on its target, at rest
//     hat_position = signal::step(hat, state, head_position, dt);
//
// Method: the closed form of x'' = -w^2 (x - target) - 2 z w x', with w = 2 pi strength and z =
// critical_damping, solved exactly in each step. So any dt is stable, and for a resting target half a second
// in one step or in 500 gives the same. Computed in double for every type. One formula for all dampings, so
// the result is continuous across critical damping.
//
// The spring lags behind a steadily moving target by 2 z (1 - target_velocity_amount) / w - dt / 2 seconds.
// Each step holds the target still at its new value, which gains half a frame.
//
// Rotations: the spring acts on the rotation vector (axis times angle) from target to value, the short way
// round. Velocity and force are rotation vectors too (rad/s, rad/s^2), in the space of the values.
//
// Cost: an exponential, a sine and a cosine, about 40 ns; for thousands of springs at once see batch.hpp.
#pragma once

#include <type_traits>

#include "tendril/fields.hpp"
#include "tendril/result.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// The type of a T's rate of change: T itself, or a rotation vector for rotations.
template <class T>
struct RateOf {
    using type = T;
};
template <>
struct RateOf<glm::quat> {
    using type = glm::vec3;
};
template <>
struct RateOf<glm::dquat> {
    using type = glm::dvec3;
};
template <class T>
using Rate = typename RateOf<T>::type;

/// Limits of strength (Hz) and damping ratio. Under no_strength there is neither spring nor damping.
inline constexpr double max_strength = 1e4, max_damping = 1e3, no_strength = 1e-5;

/// T: double, float, glm::dvec3, glm::vec3, glm::dquat or glm::quat. A parameter out of range leaves the
/// state unchanged, as a refused input does.
template <class T = double>
struct Spring {
    /// Undamped frequency in Hz, 0 to 1e4. Under 1e-5 there is neither spring nor damping: the value drifts,
    /// and the force adds to its velocity.
    double strength = 4.0;
    /// Damping ratio, 0 to 1e3: 0 oscillates for ever, 1 is the fastest without overshoot.
    double critical_damping = 1.0;
    /// Force on a mass of 1, at most max_magnitude: shifts the target by force / w^2.
    Rate<T> force{};
    /// How much of the target's velocity is anticipated, 0 to 1: at 1 the spring follows steady motion
    /// without lag, but overshoots jumps.
    double target_velocity_amount = 0.0;
    bool operator==(const Spring&) const = default;
};

template <class T = double>
struct SpringState {
    T value{};           ///< the last output
    Rate<T> velocity{};  ///< 1/s
    T previous_target{};
    bool started = false;  ///< false: the next step is the first
    bool operator==(const SpringState&) const = default;
};

/// Lets `dt` seconds pass and returns the new value. Refusals as in input.hpp. The first step starts at the
/// target, shifted by the force, at rest.
template <class T>
T step(const Spring<T>& spring, SpringState<T>& state, const std::type_identity_t<T>& target, double dt,
       Result* why = nullptr) noexcept;

extern template double step(const Spring<double>&, SpringState<double>&, const double&, double,
                            Result*) noexcept;
extern template float step(const Spring<float>&, SpringState<float>&, const float&, double, Result*) noexcept;
extern template glm::dvec3 step(const Spring<glm::dvec3>&, SpringState<glm::dvec3>&, const glm::dvec3&,
                                double, Result*) noexcept;
extern template glm::vec3 step(const Spring<glm::vec3>&, SpringState<glm::vec3>&, const glm::vec3&, double,
                               Result*) noexcept;
extern template glm::dquat step(const Spring<glm::dquat>&, SpringState<glm::dquat>&, const glm::dquat&,
                                double, Result*) noexcept;
extern template glm::quat step(const Spring<glm::quat>&, SpringState<glm::quat>&, const glm::quat&, double,
                               Result*) noexcept;

/// Other descriptions of the same spring: an editor may set any of them and show all.
struct SpringFeel {
    /// Seconds: 2 ln 2 / (z w), the half-life as in the other filters (D. Holden, "Spring-It-On", 2021).
    /// Infinite without damping.
    double half_life = 0.0;
    /// Seconds: one undamped period, 1 / strength. Infinite without strength.
    double duration = 0.0;
    /// Over -1, up to 1: 0 does not overshoot, 1 oscillates for ever, under 0 is sluggish. 1 - z for z up to
    /// 1, 1 / z - 1 above (as in SwiftUI's springs).
    double bounce = 0.0;
};
SpringFeel feel_of(double strength, double critical_damping) noexcept;

/// Strength and critical damping alone.
struct SpringShape {
    double strength = 4.0, critical_damping = 1.0;
};
/// The spring with this half-life at the given damping. InvalidArgument if the damping is not over 0 and at
/// most 1000, the half-life is not over 0, or the strength would be over 1e4 Hz.
Expected<SpringShape> of_half_life(double half_life, double critical_damping) noexcept;
/// The spring with this duration and bounce. InvalidArgument if the duration is not from 1e-4 to 1e9 s, or
/// the bounce not from -0.999 to 1.
Expected<SpringShape> of_duration(double duration, double bounce) noexcept;

}  // namespace tendril::signal

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::Spring<>>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::SpringState<double>>() noexcept;
