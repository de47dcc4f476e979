// A list of filters, applied in order, over a whole recorded input: at the input's own times, and again at
// other frame rates.
#pragma once

#include <span>
#include <vector>

#include "tendril/signal/filter.hpp"

namespace tendril::signal {

/// One row: `dt` seconds pass, and at their end the input is `input`.
struct Sample {
    double dt = 0.0;
    double input = 0.0;
    bool operator==(const Sample&) const = default;
};

/// One step of a list of filters, each on what the one before it puts out. `states` has one for each.
double step(std::span<const Filter> filters, std::span<FilterState> states, double input, double dt) noexcept;

/// What all filters together return at their first step.
double immediate(std::span<const Filter> filters, double input) noexcept;

/// The output after each sample, from fresh states on.
std::vector<double> run(std::span<const Filter> filters, std::span<const Sample> samples);

/// The same after each filter: one list for each filter. Cost as run().
std::vector<std::vector<double>> run_stages(std::span<const Filter> filters, std::span<const Sample> samples);

/// The time after each sample, seconds; a refused dt (input.hpp) takes none.
std::vector<double> times_of(std::span<const Sample> samples);

/// A steady frame rate, or one that varies: the same at every run.
struct FrameRate {
    double hz = 60.0;       ///< 0.1 to 1e5; others count as 60
    bool jittered = false;  ///< frames last from 0.4 to 1.6 times 1 / hz, pseudo-random
    bool operator==(const FrameRate&) const = default;
};
/// 15, 30, 60, 144 Hz, and 60 Hz jittered.
std::span<const FrameRate> usual_rates() noexcept;

/// When frames begin: from `begin` on, up to `end`. At most 1e6 of them.
std::vector<double> frame_times(const FrameRate& rate, double begin, double end);

/// Runs the filters on frames rather than on the input's own rows: at each of `frames` they are given what
/// the input is at that time, straight between its samples. Returns the output at each of `times`, for which
/// the filters take the rest of the way to that time from the frame before it, on copies of their states: so
/// outputs of different frame rates can be compared at any time. Both lists ascend; times before the first
/// frame count as that.
std::vector<double> run_at(std::span<const Filter> filters, std::span<const Sample> samples,
                           std::span<const double> frames, std::span<const double> times);

/// How the filters look at one frame rate.
struct RateRun {
    FrameRate rate;
    std::vector<double> time, output;  ///< of its own frames
};
struct RateComparison {
    std::vector<RateRun> runs;
    /// The largest difference between any two of them at one time, looked for at the frames of the slowest.
    /// 0 where there are not two samples.
    double difference = 0.0;
    double at = 0.0;  ///< where that is, seconds
};
RateComparison compare_rates(std::span<const Filter> filters, std::span<const Sample> samples,
                             std::span<const FrameRate> rates = usual_rates());

}  // namespace tendril::signal
