// Measures a filter on a given input: lag, overshoot, settling time, jitter. Pure functions over rows. A
// measure that the input does not determine is empty.
//
// Lag, overshoot and settling time compare the output with the filters' output without memory (immediate(),
// run.hpp), so a filter is not penalised for scaling or shaping its input.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tendril/signal/run.hpp"

namespace tendril::signal {

/// Rows to compare, all lists of the same length; otherwise they count as empty.
struct Response {
    std::span<const double> time;    ///< seconds, ascending
    std::span<const double> wanted;  ///< the output without delay
    std::span<const double> output;
};

/// Whether the output follows `wanted`, and so can be measured.
enum class Following {
    Unknown,        ///< `wanted` does not change, or there are fewer than 3 rows
    Follows,        ///< lag() finds a shift
    DoesNotFollow,  ///< lag() finds none: the output moves independently, or not at all
    Unstable        ///< the output diverges: unstable()
};

/// Whether the output diverges: it is not finite somewhere; or exceeds the range of `wanted` by more than 1e6
/// times its span; or by more than 10 times its span, and in the last quarter of the time a tenth further
/// than in the quarter before. A bounded resonance is not unstable; one without damping is. False if `wanted`
/// does not change. Cost: O(rows).
bool unstable(const Response& response);

/// Seconds: the shift of `wanted` that best fits `output` (least squares, linear between rows, constant
/// beyond the ends), to a small fraction of a row; negative if the output leads. Searches up to `longest`
/// seconds in both directions, but at most a quarter of the recorded time. Among equally good fits, as with a
/// periodic input, takes the smallest shift. Empty if `wanted` or `output` does not change, if the best fit
/// is at the end of the search range, or if the output does not follow: the shifted `wanted` explains less
/// than a tenth of the output's variance (correlation below sqrt(0.1)), or correlates negatively. Cost:
/// O(rows * longest / median dt), at most 1e4 shifts.
std::optional<double> lag(const Response& response, double longest = 1.0);

/// A jump of `wanted` within one row, to a value that it then keeps.
struct Step {
    std::size_t first = 0, end = 0;  ///< rows: the first at the new value, the first after it
    double from = 0.0, to = 0.0;     ///< the output before it, and its target
};
/// The steps of a response: changes by at least a quarter of the span of `wanted`, kept to within a
/// thousandth of the span for at least two more rows.
std::vector<Step> steps_of(const Response& response);

/// Overshoot of the output, relative to the step: the maximum over all steps, 0 without overshoot. Empty
/// without steps.
std::optional<double> overshoot(const Response& response);

/// Seconds from a step until the output stays within 2 % of it: the maximum over all steps. Empty without
/// steps, or if the output has not settled when the input moves on.
std::optional<double> settling_time(const Response& response);

/// The fraction of the input's jitter that remains: the root mean square of the changes of slope of `output`,
/// over the same for `input`. Slopes rather than differences, to allow for uneven times. Empty if the input
/// has no jitter.
std::optional<double> jitter(std::span<const double> time, std::span<const double> input,
                             std::span<const double> output);

/// For an unstable output only `following` is set: the other numbers would be meaningless.
struct Measures {
    Following following = Following::Unknown;
    std::optional<double> lag;            ///< seconds
    std::optional<double> overshoot;      ///< relative to the step
    std::optional<double> settling_time;  ///< seconds, to 2 %
    std::optional<double> jitter;         ///< relative to the input's
    double rate_difference = 0.0;         ///< compare_rates()
};
/// Measures existing rows; `input` as in jitter(). Leaves rate_difference at 0.
Measures measure(const Response& response, std::span<const double> input);
/// All measures of a list of filters on one input. Cost: 0.2 to 0.4 ms for 600 rows, most of it for lag and
/// the frame rates.
Measures measure(std::span<const Filter> filters, std::span<const Sample> samples);

}  // namespace tendril::signal
