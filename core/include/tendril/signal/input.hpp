// The inputs that every filter accepts, and how it treats others: one rule for the whole module.
//
// A filter is a struct of parameters and a struct of state. `step(parameters, state, input, dt)` lets `dt`
// seconds pass with that input and returns the output, which the state keeps as `value`.
//
// - A refused input (not finite, or over max_magnitude in magnitude) changes nothing: the step returns the
//   last output. To know beforehand, call is_input; it is the only criterion. To know why, pass a Result as
//   the last argument: success, or "step: input must be finite and at most 1e9 in magnitude, got nan".
// - A dt that is not finite, 0 or negative changes nothing either. Others are clamped to [min_dt, max_dt].
// - The output of the first step after a reset (a fresh state) depends on the input alone, as each filter
//   describes. With a refused dt it is the same, but the filter has not started.
// - Outputs are finite, and at most max_output in magnitude, for any parameters within their ranges (listed
//   and checked by filter.hpp) and any inputs and times.
//
// States are values: copied, compared and restored, they give the same bits again. No step allocates or
// throws, except that a moving average allocates until its window is full.
#pragma once

#include "tendril/fields.hpp"
#include "tendril/magnitude.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril::signal {

/// A dt is clamped to this range, seconds (up to 30 years).
inline constexpr double min_dt = 1e-9, max_dt = 1e9;

/// Limit of all outputs. Only unbounded growth reaches it: an unstable filter, or a constant force without a
/// spring.
inline constexpr double max_output = 1e30;

/// Whether filters accept a value: finite, and at most max_magnitude (1e9) in magnitude. Rotations: finite,
/// with a length between 1e-3 and 1e3; they need not be normalised.
bool is_input(double value) noexcept;
bool is_input(float value) noexcept;
bool is_input(const glm::vec3& value) noexcept;
bool is_input(const glm::dvec3& value) noexcept;
bool is_input(const glm::quat& value) noexcept;
bool is_input(const glm::dquat& value) noexcept;

/// Whether time passes in a step: `dt` is finite and over 0.
bool is_step(double dt) noexcept;

/// The state of a filter that remembers only its output.
struct OutputState {
    double value = 0.0;    ///< the last output
    bool started = false;  ///< false: the next step is the first
    bool operator==(const OutputState&) const = default;
};

}  // namespace tendril::signal

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::OutputState>() noexcept;
