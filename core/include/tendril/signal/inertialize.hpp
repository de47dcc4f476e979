// Inertialization: passes its input through but smooths its jumps, as at a cut from one animation clip to
// another.
//
// Method: D. Bollo, "Inertialization: High-Performance Animation Transitions in Gears of War", GDC 2018, with
// the critically damped spring of D. Holden ("Spring-It-On", 2021) to decay the offset. If the input jumps by
// more than the threshold in one step, the output's distance and velocity relative to it become an offset
// that decays with w = 2 ln 2 / halflife.
//
// The input's velocity after a jump is known only one step later; until then it counts as 0.
//
// Cost: one exponential, about 40 ns.
#pragma once

#include "tendril/fields.hpp"
#include "tendril/signal/input.hpp"

namespace tendril::signal {

struct Inertialize {
    double halflife = 0.1;   ///< s, 0 (jumps pass) to 1e4
    double threshold = 0.5;  ///< 0 to 1e9: a larger change in one step is a jump
    bool operator==(const Inertialize&) const = default;
};

struct InertializeState {
    double value = 0.0;     ///< the last output
    double velocity = 0.0;  ///< output velocity in the last step, 1/s
    double input = 0.0;     ///< the last input
    double offset = 0.0;    ///< output minus input
    double offset_velocity = 0.0;
    bool jumped = false;  ///< in the last step: the input's velocity is not known yet
    bool started = false;
    bool operator==(const InertializeState&) const = default;
};

/// The first step returns the input.
double step(const Inertialize& parameters, InertializeState& state, double input, double dt,
            Result* why = nullptr) noexcept;

}  // namespace tendril::signal

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::Inertialize>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::InertializeState>() noexcept;
