// Filters at frame rates other than the input's own.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/random.hpp"
#include "signal/stepped.hpp"
#include "tendril/signal/run.hpp"

namespace tendril::signal {
namespace {

constexpr std::size_t max_frames = 1'000'000;
constexpr double same_time = 1e-9;  ///< seconds: times closer than this are equal

constexpr FrameRate all_usual_rates[] = {{15.0}, {30.0}, {60.0}, {144.0}, {60.0, true}};

double hz_of(const FrameRate& rate) {
    return rate.hz >= 0.1 && rate.hz <= 1e4 ? rate.hz : 60.0;
}

/// The input at every rate: constant over each frame of the slowest rate.
class HeldInput {
  public:
    HeldInput(std::span<const Sample> samples, std::span<const FrameRate> rates) {
        const std::vector<double> times = times_of(samples);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (!is_input(samples[i].input)) continue;
            if (!rows_.empty() && times[i] - rows_.back().time < same_time) rows_.pop_back();
            rows_.push_back({times[i], samples[i].input});
        }
        for (const FrameRate& rate : rates) slowest_ = std::min(slowest_, hz_of(rate));
    }
    bool empty() const { return rows_.empty(); }
    double end() const { return rows_.back().time; }
    /// The end of a frame of the slowest rate, counted from 1.
    double frame_end(std::size_t frame) const {
        return std::min(static_cast<double>(frame) / slowest_, end());
    }
    /// The frame of the slowest rate that contains a time.
    std::size_t frame_at(double time) const {
        return static_cast<std::size_t>(std::max(std::ceil((time - same_time) * slowest_), 1.0));
    }
    /// A row's input applies from the time of the row before it to its own.
    double at(double time) const {
        const double held = frame_end(frame_at(time)) - same_time;
        const auto row = std::lower_bound(rows_.begin(), rows_.end(), held,
                                          [](const Row& each, double value) { return each.time < value; });
        return row == rows_.end() ? rows_.back().value : row->value;
    }

  private:
    struct Row {
        double time, value;
    };
    std::vector<Row> rows_;
    double slowest_ = 1e4;
};

/// Random numbers from 0 to 1, the same in every run.
class Unit {
  public:
    double next() { return static_cast<double>(math::random_bits(state_) >> 11) * 0x1p-53; }

  private:
    std::uint64_t state_ = 1;
};

/// The ends of a rate's frames, split at the slowest rate's.
std::vector<double> frame_ends(const FrameRate& rate, const HeldInput& input) {
    const double hz = hz_of(rate), end = input.end();
    std::vector<double> times;
    Unit random;
    double own = 0.0;  // the end of the rate's own frame, before splitting
    std::size_t whole = 0, slow = 1;
    while (times.size() < max_frames && (times.empty() || times.back() < end - same_time)) {
        const double now = times.empty() ? 0.0 : times.back();
        while (own <= now + same_time) {
            // Frames of equal length are counted, to avoid summing rounding errors.
            own = rate.jittered ? own + (0.4 + 1.2 * random.next()) / hz : static_cast<double>(++whole) / hz;
        }
        while (input.frame_end(slow) <= now + same_time && input.frame_end(slow) < end) ++slow;
        const double cut = input.frame_end(slow);
        times.push_back(own < cut - same_time ? own : cut);
    }
    return times;
}

/// The input at ascending times.
class Reader {
  public:
    explicit Reader(const HeldInput& input) : input_(input) {}
    double at(double time) {
        if (time > held_until_ + same_time) {
            held_ = input_.at(time);
            held_until_ = input_.frame_end(input_.frame_at(time));
        }
        return held_;
    }

  private:
    const HeldInput& input_;
    double held_ = 0.0, held_until_ = 0.0;  ///< the value in the frame read last, and the end of that frame
};

/// Filters that run frame by frame.
class Runner {
  public:
    Runner(std::span<const Filter> filters, const HeldInput& input)
        : filters_(filters), states_(filters.size()), input_(input), reader_(input) {}

    double now() const { return now_; }
    double output() const { return output_; }
    void advance(double to) {
        output_ = step(filters_, states_, reader_.at(to), to - now_);
        now_ = to;
    }
    /// The output of a frame that would end at `to`; changes nothing.
    double ahead(double to) const {
        std::vector<FilterState> copies = states_;
        return step(filters_, copies, input_.at(to), to - now_);
    }

  private:
    std::span<const Filter> filters_;
    std::vector<FilterState> states_;
    const HeldInput& input_;
    Reader reader_;
    double now_ = 0.0, output_ = 0.0;
};

RateRun run_of(std::span<const Filter> filters, const HeldInput& input, const FrameRate& rate) {
    RateRun run{rate, frame_ends(rate, input), {}};
    Runner runner(filters, input);
    for (const double time : run.time) {
        runner.advance(time);
        run.output.push_back(runner.output());
    }
    return run;
}

void find_difference(RateComparison& comparison, const HeldInput& input) {
    // Each frame of the slowest rate ends with a frame of every other rate.
    auto& runs = comparison.runs;
    std::vector<std::size_t> at(runs.size(), 0);
    for (std::size_t slow = 1; !runs.empty(); ++slow) {
        const double time = input.frame_end(slow);
        double low = max_output, high = -max_output;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            while (at[i] < runs[i].time.size() && runs[i].time[at[i]] < time) ++at[i];
            if (at[i] == runs[i].time.size()) return;
            low = std::min(low, runs[i].output[at[i]]);
            high = std::max(high, runs[i].output[at[i]]);
        }
        if (high - low > comparison.difference) {
            comparison.difference = high - low;
            comparison.at = time;
        }
        if (time >= input.end()) break;
    }
}

}  // namespace

std::span<const FrameRate> usual_rates() noexcept {
    return all_usual_rates;
}

RateComparison compare_rates(std::span<const Filter> filters, std::span<const Sample> samples,
                             std::span<const FrameRate> rates) {
    RateComparison comparison;
    const HeldInput input(samples, rates);
    if (input.empty()) return comparison;
    for (const FrameRate& rate : rates) comparison.runs.push_back(run_of(filters, input, rate));
    find_difference(comparison, input);
    return comparison;
}

std::vector<std::vector<double>> outputs_at(std::span<const Filter> filters, std::span<const Sample> samples,
                                            std::span<const double> times, std::span<const FrameRate> rates) {
    const HeldInput input(samples, rates);
    std::vector<std::vector<double>> outputs(rates.size(), std::vector<double>(times.size(), 0.0));
    if (input.empty()) return outputs;
    for (std::size_t i = 0; i < rates.size(); ++i) {
        const std::vector<double> frames = frame_ends(rates[i], input);
        Runner runner(filters, input);
        std::size_t frame = 0;
        for (std::size_t k = 0; k < times.size(); ++k) {
            while (frame < frames.size() && frames[frame] <= times[k] + same_time)
                runner.advance(frames[frame++]);
            const bool between = times[k] > runner.now() + same_time;
            outputs[i][k] = between ? runner.ahead(times[k]) : runner.output();
        }
    }
    return outputs;
}

}  // namespace tendril::signal
