// What every filter takes, and what it does with anything else: one rule for the whole room.
//
// A filter is a struct of parameters and a struct of state. `step(parameters, state, input, dt)` lets `dt`
// seconds pass with that input and returns the output, which the state keeps as `value`.
//
// - A refused input (not finite, or over max_magnitude in magnitude) changes nothing: the step returns the
//   output that there was. A caller that must know asks is_input first: nothing else decides.
// - A dt that is not finite, 0 or negative changes nothing either. Others count as at least min_dt and at
//   most max_dt.
// - The first step after a reset (a fresh state) returns what the input alone says; each filter says what
//   that is. With a refused dt it returns the same, but the filter has not started.
// - Outputs are finite, and at most max_output in magnitude, whatever parameters within their ranges
//   (filter.hpp has them and checks them), inputs and times come in whatever order.
//
// States are values: copied, compared and put back, they give the same bits as the first time. No step
// allocates or throws, except that a moving average allocates until its window is full.
#pragma once

#include "tendril/magnitude.hpp"
#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::signal {

/// Seconds: a shorter step counts as this long, a longer one as that long (30 years).
inline constexpr double min_dt = 1e-9, max_dt = 1e9;

/// No output is larger. Only what grows without bound gets there: an unstable filter, or a constant force
/// without a spring.
inline constexpr double max_output = 1e30;

/// Whether filters take it: finite, and at most max_magnitude (1e9) in magnitude. Rotations: finite and of a
/// length between 1e-3 and 1e3; they need not be normalised.
bool is_input(double value) noexcept;
bool is_input(float value) noexcept;
bool is_input(const glm::vec3& value) noexcept;
bool is_input(const glm::dvec3& value) noexcept;
bool is_input(const glm::quat& value) noexcept;
bool is_input(const glm::dquat& value) noexcept;

/// Whether time passes: finite and over 0.
bool is_step(double dt) noexcept;

/// The state of a filter that remembers nothing but its output.
struct OutputState {
    double value = 0.0;    ///< the last output
    bool started = false;  ///< false: the next step is the first
    bool operator==(const OutputState&) const = default;
};

}  // namespace tendril::signal
