// What a filter costs and what it gains, measured on an input at hand: lag, overshoot, settling time, jitter.
// Pure functions over rows; a measure that the input says nothing about is left empty.
//
// Lag, overshoot and settling compare the output with what the filters return without any memory
// (immediate(), run.hpp), so that a filter that scales or bends is not blamed for that.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tendril/signal/run.hpp"

namespace tendril::signal {

/// Rows to compare, all lists of the same length; others count as empty.
struct Response {
    std::span<const double> time;    ///< seconds, ascending
    std::span<const double> wanted;  ///< what would be there at once
    std::span<const double> output;
};

/// Whether an output can be measured by what is wanted.
enum class Following {
    Unknown,        ///< `wanted` does not change, or there are less than 3 rows
    Follows,        ///< lag() finds a shift
    DoesNotFollow,  ///< it moves by itself, or not at all: lag() finds none
    Unstable        ///< it runs away: unstable()
};

/// Whether the output runs away: it is not finite somewhere; or it goes farther beyond the values that
/// `wanted` has than 1e6 times what those span; or farther than 10 times that, and in the last quarter of the
/// time a tenth farther than in the quarter before. A resonance that stays within bounds is not unstable, one
/// without damping is. False where `wanted` does not change. Cost: O(rows).
bool unstable(const Response& response);

/// Seconds: the shift of `wanted` that fits `output` best (least squares, straight between the rows, held
/// beyond the ends), to a small part of a row; negative where the output runs ahead. Looked for up to
/// `longest` seconds either way, and up to a quarter of the time that there is; of fits that are as good, as
/// with a periodic input, the smallest shift. Empty where one of the two does not change, where nothing
/// within that time fits best, and where the output does not follow: where `wanted`, shifted so, explains
/// less than a tenth of the output's variance (correlation below sqrt(0.1)), or would have it go the other
/// way. Cost: O(rows * longest / median dt), 1e4 shifts at most.
std::optional<double> lag(const Response& response, double longest = 1.0);

/// A jump of `wanted` within one row, to a value that it then keeps.
struct Step {
    std::size_t first = 0, end = 0;  ///< rows: the first at the new value, and the first of another
    double from = 0.0, to = 0.0;     ///< the output before it, and what it should come to
};
/// The steps of a response: changes by at least a quarter of what `wanted` spans, kept to a thousandth of
/// that for two more rows at least.
std::vector<Step> steps_of(const Response& response);

/// How far the output goes beyond a step, as a part of the step: the most of all steps, 0 where none does.
/// Empty without steps.
std::optional<double> overshoot(const Response& response);

/// Seconds from a step until the output stays within 2 % of it: the longest of all steps. Empty without
/// steps, and where the output has not settled when the input moves on.
std::optional<double> settling_time(const Response& response);

/// What of the input's jitter is left: the root mean square of the second differences of `output` over that
/// of `input`, slopes rather than differences so that it holds for uneven times. Empty where the input has
/// none.
std::optional<double> jitter(std::span<const double> time, std::span<const double> input,
                             std::span<const double> output);

/// Of an unstable output only that is said: its other numbers would mean nothing.
struct Measures {
    Following following = Following::Unknown;
    std::optional<double> lag;            ///< seconds
    std::optional<double> overshoot;      ///< part of the step
    std::optional<double> settling_time;  ///< seconds, to 2 %
    std::optional<double> jitter;         ///< part of the input's
    double rate_difference = 0.0;         ///< compare_rates()
};
/// Of rows that are there already; `input` is what jitter() takes. The frame rates are left at 0.
Measures measure(const Response& response, std::span<const double> input);
/// All of them for a list of filters on one input. Cost: 0.2 to 0.4 ms for 600 rows, most of it lag and
/// the frame rates.
Measures measure(std::span<const Filter> filters, std::span<const Sample> samples);

}  // namespace tendril::signal
