// Any filter of this module, chosen at run time: for graphs, panels and files.
//
//     signal::Filter filter = signal::find_kind("one_euro")->blank();
//     if (const Result bad = signal::check(filter); !bad) return bad;
//     signal::FilterState state;
//     output = signal::step(filter, state, input, dt);
//
// One list, kinds(), has every kind with the table of its struct (tendril/fields.hpp). Code that reads
// files, draws panels, fits parameters or generates code uses it and needs no list of its own. A program that
// knows its filters calls the `step` of their own headers instead.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <variant>

#include "tendril/fields.hpp"
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

/// The state of a filter. A fresh one suits every filter: the first step gives it the right type. A state of
/// another type, left by a previous filter, counts as fresh; one of the same type continues.
using FilterState =
    std::variant<OutputState, SpringState<>, MotionState, MovingAverageState, InertializeState>;

/// See input.hpp. Does not check that parameters are in range: check() does.
double step(const Filter& filter, FilterState& state, double input, double dt,
            Result* why = nullptr) noexcept;

/// The first output after a reset: depends on the input alone. 0 for a refused input.
double immediate(const Filter& filter, double input) noexcept;

/// The last output; 0 before the first step.
double value(const FilterState& state) noexcept;
bool started(const FilterState& state) noexcept;

/// Checks ranges and relations between parameters. InvalidArgument, naming the parameter and its value:
/// `rate_limit: rise must be 0 to 1e9 1/s, got -1`. A curve has 1 to 1000 keys.
Result check(const Filter& filter) noexcept;

/// In the order of Filter's alternatives.
inline constexpr std::array<const char*, std::variant_size_v<Filter>> kind_names{
    "interp_to",  "interp_to_exact", "scale_bias_clamp",     "spring",   "exponential_decay",
    "rate_limit", "smooth_damp",     "spring_semi_implicit", "one_euro", "moving_average",
    "dead_zone",  "hysteresis",      "inertialize",          "curve"};

/// The table of a kind, such as fields<OneEuro>(), and its name.
struct Kind : FieldKind {
    const char* name;            ///< "one_euro"
    Filter (*blank)() noexcept;  ///< makes one with default parameters
};

/// In the order of Filter's alternatives.
std::span<const Kind> kinds() noexcept;
/// Null for an unknown name.
const Kind* find_kind(std::string_view name) noexcept;
const Kind& kind_of(const Filter& filter) noexcept;
/// The struct that the filter holds. Use only with kind_of(filter).table(): a row of another kind would
/// access memory out of bounds.
void* fields_in(Filter& filter) noexcept;
const void* fields_in(const Filter& filter) noexcept;
/// The name of the filter's kind.
const char* kind(const Filter& filter) noexcept;

}  // namespace tendril::signal
