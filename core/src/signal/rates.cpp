// Filters at frame rates other than the input's own.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "signal/stepped.hpp"
#include "tendril/signal/run.hpp"

namespace tendril::signal {
namespace {

constexpr std::size_t max_frames = 1'000'000;
constexpr double same_time = 1e-9;  ///< seconds: times nearer than that are the same

constexpr FrameRate all_usual_rates[] = {{15.0}, {30.0}, {60.0}, {144.0}, {60.0, true}};

/// The input as a function of time.
class Polyline {
  public:
    explicit Polyline(std::span<const Sample> samples) {
        const std::vector<double> times = times_of(samples);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (!is_input(samples[i].input)) continue;
            if (!points_.empty() && times[i] - points_.back().time < same_time) points_.pop_back();
            points_.push_back({times[i], samples[i].input});
        }
    }
    bool empty() const { return points_.empty(); }
    double begin() const { return points_.front().time; }
    double end() const { return points_.back().time; }

    /// Held beyond the ends. Quick where the times ascend.
    double at(double time) {
        if (time < points_[next_].time && next_ > 0 && time < points_[next_ - 1].time) next_ = 0;
        while (next_ + 1 < points_.size() && points_[next_].time <= time) ++next_;
        const Point& to = points_[next_];
        if (next_ == 0 || time >= to.time) return to.value;
        const Point& from = points_[next_ - 1];
        return from.value + (to.value - from.value) * ((time - from.time) / (to.time - from.time));
    }

  private:
    struct Point {
        double time, value;
    };
    std::vector<Point> points_;
    std::size_t next_ = 0;
};

/// SplitMix64 (Steele, Lea, Flood 2014), 0 to 1: the same frames everywhere.
class Unit {
  public:
    double next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

  private:
    std::uint64_t state_ = 1;
};

/// The largest difference between any two of several outputs, and where.
void find_difference(const std::vector<std::vector<double>>& outputs, std::span<const double> times,
                     RateComparison& comparison) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        double low = outputs.front()[i], high = low;
        for (const std::vector<double>& output : outputs) {
            low = std::min(low, output[i]);
            high = std::max(high, output[i]);
        }
        if (high - low <= comparison.difference) continue;
        comparison.difference = high - low;
        comparison.at = times[i];
    }
}

}  // namespace

std::span<const FrameRate> usual_rates() noexcept {
    return all_usual_rates;
}

std::vector<double> frame_times(const FrameRate& rate, double begin, double end) {
    const double hz = rate.hz >= 0.1 && rate.hz <= 1e5 ? rate.hz : 60.0;
    std::vector<double> times;
    Unit random;
    for (double time = begin; time <= end + same_time && times.size() < max_frames;) {
        times.push_back(time);
        const double frames = static_cast<double>(times.size());
        // Counted, not added up, where frames are even.
        time = rate.jittered ? time + (0.4 + 1.2 * random.next()) / hz : begin + frames / hz;
    }
    return times;
}

std::vector<double> run_at(std::span<const Filter> filters, std::span<const Sample> samples,
                           std::span<const double> frames, std::span<const double> times) {
    Polyline input(samples);
    if (input.empty() || frames.empty()) return std::vector<double>(times.size(), 0.0);
    std::vector<FilterState> states(filters.size());
    const double first = frames.size() > 1 ? frames[1] - frames[0] : min_dt;
    double now = frames.front(), output = step(filters, states, input.at(now), first);
    std::vector<double> outputs;
    outputs.reserve(times.size());
    std::size_t frame = 1;
    for (const double time : times) {
        for (; frame < frames.size() && frames[frame] <= time + same_time; ++frame) {
            output = step(filters, states, input.at(frames[frame]), frames[frame] - now);
            now = frames[frame];
        }
        if (time - now <= same_time) {
            outputs.push_back(output);
        } else {
            std::vector<FilterState> ahead = states;
            outputs.push_back(step(filters, ahead, input.at(time), time - now));
        }
    }
    return outputs;
}

RateComparison compare_rates(std::span<const Filter> filters, std::span<const Sample> samples,
                             std::span<const FrameRate> rates) {
    RateComparison comparison;
    const Polyline input(samples);
    if (input.empty() || rates.empty()) return comparison;
    for (const FrameRate& rate : rates) {
        RateRun run{rate, frame_times(rate, input.begin(), input.end()), {}};
        run.output = run_at(filters, samples, run.time, run.time);
        comparison.runs.push_back(std::move(run));
    }
    // Within the frames that all of them have.
    const RateRun* slowest = &comparison.runs.front();
    double last = input.end();
    for (const RateRun& run : comparison.runs) {
        if (run.time.size() < slowest->time.size()) slowest = &run;
        if (run.time.size() == max_frames) last = std::min(last, run.time.back());
    }
    std::vector<double> times = slowest->time;
    while (!times.empty() && times.back() > last + same_time) times.pop_back();
    std::vector<std::vector<double>> outputs;
    for (const RateRun& run : comparison.runs) outputs.push_back(run_at(filters, samples, run.time, times));
    find_difference(outputs, times, comparison);
    return comparison;
}

}  // namespace tendril::signal
