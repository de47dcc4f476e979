// Any filter of this room, chosen at run time: for graphs, panels and files.
//
//     signal::Filter filter = signal::find_kind("one_euro")->blank();
//     if (const Result bad = signal::check(filter); !bad) return bad;
//     signal::FilterState state;
//     output = signal::step(filter, state, input, dt);
//
// One table, kinds(), has every kind with its parameters by name, unit and range: what reads files, draws
// panels, fits parameters and writes code goes through it and needs no list of its own. A program that knows
// its filters calls the `step` of their own headers instead.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "tendril/result.hpp"
#include "tendril/signal/curve.hpp"
#include "tendril/signal/inertialize.hpp"
#include "tendril/signal/interpolate.hpp"
#include "tendril/signal/scale_bias_clamp.hpp"
#include "tendril/signal/shaping.hpp"
#include "tendril/signal/smoothing.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::signal {

/// The parameters of one filter; kinds() is in this order.
using Filter =
    std::variant<InterpTo, InterpToExact, ScaleBiasClamp, Spring<>, ExponentialDecay, RateLimit, SmoothDamp,
                 SpringSemiImplicit, OneEuro, MovingAverage, DeadZone, Hysteresis, Inertialize, Curve>;

/// What a filter remembers. A fresh one suits every filter: the first step gives it the right form. One of
/// another form, left by a filter that was there before, is taken as fresh; one of the same form goes on.
using FilterState =
    std::variant<OutputState, SpringState<>, MotionState, MovingAverageState, InertializeState>;

/// As input.hpp says. Parameters out of their range are not looked for here: check() does that.
double step(const Filter& filter, FilterState& state, double input, double dt) noexcept;

/// What the first step after a reset would return: what the input says without any memory. 0 for a refused
/// input.
double immediate(const Filter& filter, double input) noexcept;

/// The last output; 0 before the first step.
double value(const FilterState& state) noexcept;
bool started(const FilterState& state) noexcept;

/// Ranges, and what must hold between parameters. InvalidArgument, naming the parameter and its value:
/// `rate_limit: rise must be from 0 to 1e9, got -1`.
Result check(const Filter& filter) noexcept;

enum class ParameterType : std::uint8_t { Number, Flag };

/// A number or a flag of one kind of filter. The keys of a curve are no parameters in this sense.
struct Parameter {
    std::string_view name;  ///< as files have it: "speed_increasing"
    std::string_view unit;  ///< "s", "Hz", "1/s" or nothing
    ParameterType type = ParameterType::Number;
    int element = -1;  ///< 0 or 1 of a pair, {low, high}, which has two rows of one name; else -1
    double minimum = 0.0, maximum = 1.0;  ///< what check() lets pass
    /// Where it is of use, for sliders and fits; with `logarithmic` by ratio rather than by difference.
    double low = 0.0, high = 1.0;
    bool logarithmic = false;
    /// Of a filter of that kind; the others are left alone, and read as 0. Flags are 0 and 1.
    double (*get)(const Filter&) noexcept = nullptr;
    void (*set)(Filter&, double) noexcept = nullptr;
};

struct Kind {
    const char* name;            ///< "one_euro"
    Filter (*blank)() noexcept;  ///< with every parameter's default
    std::span<const Parameter> parameters;
};

/// All of them, in the order of Filter's alternatives.
std::span<const Kind> kinds() noexcept;
/// Null for an unknown name.
const Kind* find_kind(std::string_view name) noexcept;
const Kind& kind_of(const Filter& filter) noexcept;
/// Its name.
const char* kind(const Filter& filter) noexcept;

}  // namespace tendril::signal
