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
    double hz = 60.0;       ///< 0.1 to 1e4; others count as 60
    bool jittered = false;  ///< frames last from 0.4 to 1.6 times 1 / hz, pseudo-random
    bool operator==(const FrameRate&) const = default;
};
/// 15, 30, 60, 144 Hz, and 60 Hz jittered.
std::span<const FrameRate> usual_rates() noexcept;

// At other frame rates all see the same input, so that what differs is the filters' own: in every frame of
// the slowest rate the input is what it is at the end of that frame, and the frames of the others are cut
// where those end. Frames count from time 0, where the first sample's dt begins; no rate has more than 1e6.

/// How the filters look at one frame rate.
struct RateRun {
    FrameRate rate;
    std::vector<double> time, output;  ///< of its own frames, at their ends
};
struct RateComparison {
    std::vector<RateRun> runs;
    /// The largest difference between any two of them at the end of a frame of the slowest, and when that is,
    /// in seconds. 0 for filters that do not depend on the frame rate, but for rounding.
    double difference = 0.0;
    double at = 0.0;
};
/// No runs where there is no sample.
RateComparison compare_rates(std::span<const Filter> filters, std::span<const Sample> samples,
                             std::span<const FrameRate> rates = usual_rates());

/// The outputs of the same runs at each of `times`, which ascend: one list for each rate. Between two frames
/// it is what a frame that ended then would give.
std::vector<std::vector<double>> outputs_at(std::span<const Filter> filters, std::span<const Sample> samples,
                                            std::span<const double> times,
                                            std::span<const FrameRate> rates = usual_rates());

}  // namespace tendril::signal
