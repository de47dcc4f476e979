// Filters that change a value rather than its motion: dead zone and hysteresis. For curves see curve.hpp.
// Cost: a few ns.
#pragma once

#include "tendril/fields.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

/// 0 within `width` of 0, `sign(x) (|x| - width)` outside. Hides the play of a joystick.
struct DeadZone {
    double width = 0.1;  ///< 0 to 1e9
    bool operator==(const DeadZone&) const = default;
};
double step(const DeadZone& parameters, OutputState& state, double input, double dt,
            Result* why = nullptr) noexcept;

/// 1 from `high` up, 0 from `low` down, unchanged in between, and 0 at first: a switch that does not flicker.
/// `low` must not exceed `high`; if they are equal, that value gives 1.
struct Hysteresis {
    double low = 0.4;   ///< -1e9 to 1e9
    double high = 0.6;  ///< -1e9 to 1e9
    bool operator==(const Hysteresis&) const = default;
};
double step(const Hysteresis& parameters, OutputState& state, double input, double dt,
            Result* why = nullptr) noexcept;

}  // namespace tendril::signal

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::DeadZone>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::Hysteresis>() noexcept;
