// interp_to: moves part of the way to a target in each step, an ease-out that never overshoots. Two versions:
// the one of game engines, which depends on the frame rate, and an exact one, which does not.
//
//     door = interp_to(door, open ? 90.0f : 0.0f, dt, 8.0);
//
// The remaining distance after half a second at speed 10: 0.0005 at 15 Hz (seven steps), 0.0023 at 30, 0.0042
// at 60, 0.0056 at 144; with interp_to_exact 0.0067 at any rate.
//
// Cost: a few ns; for thousands of values at once see batch.hpp.
#pragma once

#include "tendril/fields.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// `current + (target - current) * clamp(dt * speed, 0, 1)`; rotations the short way round (slerp).
///
/// `speed` in 1/s; at or below 0 it jumps to the target. Within a squared distance of 1e-8 (rotations: the
/// squared difference of their components, the short way round) it returns exactly the target. A refused
/// target or dt (input.hpp) returns `current`; a refused `current` or a NaN speed jumps to the target.
float interp_to(float current, float target, double dt, double speed) noexcept;
double interp_to(double current, double target, double dt, double speed) noexcept;
glm::vec3 interp_to(const glm::vec3& current, const glm::vec3& target, double dt, double speed) noexcept;
glm::dvec3 interp_to(const glm::dvec3& current, const glm::dvec3& target, double dt, double speed) noexcept;
glm::quat interp_to(const glm::quat& current, const glm::quat& target, double dt, double speed) noexcept;
glm::dquat interp_to(const glm::dquat& current, const glm::dquat& target, double dt, double speed) noexcept;

/// The same with the factor `1 - exp(-speed * dt)`, however near the target is: two half steps equal one
/// whole step, to rounding.
float interp_to_exact(float current, float target, double dt, double speed) noexcept;
double interp_to_exact(double current, double target, double dt, double speed) noexcept;
glm::vec3 interp_to_exact(const glm::vec3& current, const glm::vec3& target, double dt,
                          double speed) noexcept;
glm::dvec3 interp_to_exact(const glm::dvec3& current, const glm::dvec3& target, double dt,
                           double speed) noexcept;
glm::quat interp_to_exact(const glm::quat& current, const glm::quat& target, double dt,
                          double speed) noexcept;
glm::dquat interp_to_exact(const glm::dquat& current, const glm::dquat& target, double dt,
                           double speed) noexcept;

/// The same as filters: the state is the current value. The first step returns the input.
struct InterpTo {
    double speed = 10.0;  ///< 1/s, -1e6 to 1e6
    bool operator==(const InterpTo&) const = default;
};
struct InterpToExact {
    double speed = 10.0;  ///< 1/s, -1e6 to 1e6
    bool operator==(const InterpToExact&) const = default;
};
double step(const InterpTo& parameters, OutputState& state, double input, double dt,
            Result* why = nullptr) noexcept;
double step(const InterpToExact& parameters, OutputState& state, double input, double dt,
            Result* why = nullptr) noexcept;

}  // namespace tendril::signal

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::InterpTo>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::InterpToExact>() noexcept;
