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

/// One step of a list of filters, each fed the output of the one before. `states` has one for each.
double step(std::span<const Filter> filters, std::span<FilterState> states, double input, double dt,
            Result* why = nullptr) noexcept;

/// The output of all filters together at their first step.
double immediate(std::span<const Filter> filters, double input) noexcept;

/// The output after each sample, starting from fresh states.
std::vector<double> run(std::span<const Filter> filters, std::span<const Sample> samples);

/// The same after each filter: one list per filter. Cost as run().
std::vector<std::vector<double>> run_stages(std::span<const Filter> filters, std::span<const Sample> samples);

/// The time after each sample, in seconds; a refused dt (input.hpp) counts as 0.
std::vector<double> times_of(std::span<const Sample> samples);

/// A steady frame rate, or a varying one that is the same in every run.
struct FrameRate {
    double hz = 60.0;       ///< 0.1 to 1e4; others count as 60
    bool jittered = false;  ///< frames last from 0.4 to 1.6 times 1 / hz, pseudo-random
    bool operator==(const FrameRate&) const = default;
};
/// 15, 30, 60, 144 Hz, and 60 Hz jittered.
std::span<const FrameRate> usual_rates() noexcept;

// The filters get the same input at all frame rates, so any difference is theirs. During each frame of the
// slowest rate the input is constant at its value at the end of that frame, and the frames of the other rates
// are split there. Frames start at time 0, where the first sample's dt begins; a run has at most 1e6 frames.

/// The filters at one frame rate.
struct RateRun {
    FrameRate rate;
    std::vector<double> time, output;  ///< per frame, at its end
};
struct RateComparison {
    std::vector<RateRun> runs;
    /// The largest difference between any two runs at the end of a frame of the slowest rate, and its time in
    /// seconds. 0, to rounding, for filters that do not depend on the frame rate.
    double difference = 0.0;
    double at = 0.0;
};
/// No runs if there are no samples.
RateComparison compare_rates(std::span<const Filter> filters, std::span<const Sample> samples,
                             std::span<const FrameRate> rates = usual_rates());

/// The outputs of the same runs at each of the ascending `times`: one list per rate. Between two frames: the
/// output of a frame cut off at that time.
std::vector<std::vector<double>> outputs_at(std::span<const Filter> filters, std::span<const Sample> samples,
                                            std::span<const double> times,
                                            std::span<const FrameRate> rates = usual_rates());

}  // namespace tendril::signal
