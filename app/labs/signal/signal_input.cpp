#include "app/labs/signal/signal_input.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tendril::app {
namespace {

/// -1 to 1, as good as random; the same on every machine.
double shuffled(std::int64_t number) {
    auto x = static_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-52 - 1.0;
}

/// Where in its period a wave is: over 0 and up to 1.
double phase(double time, double period) {
    const double periods = time / period - 1e-9;
    return periods - std::floor(periods);
}

/// Smooth between random values a quarter of a period apart, and at 60 Hz an error of a tenth of that.
double noise(double time, double period) {
    const double place = 4.0 * time / period;
    const double first = std::floor(place), u = place - first;
    const auto knot = static_cast<std::int64_t>(first);
    const double from = shuffled(2 * knot), to = shuffled(2 * knot + 2);
    const double drift = from + (to - from) * (u * u * (3.0 - 2.0 * u));
    return 0.9 * drift + 0.1 * shuffled(2 * static_cast<std::int64_t>(std::floor(60.0 * time + 1e-6)) + 1);
}

/// The row of a recording that a time falls into: each holds for the dt that ends with it. It begins with the
/// first; later its end is the last one's.
double played(const InputRows* rows, double time) {
    const double length = length_of(rows);
    if (length <= 0.0) return 0.0;
    double left = time > 0.0 ? phase(time, length) * length : 0.0;
    for (const signal::Sample& row : *rows) {
        left -= std::max(row.dt, 0.0);
        if (left <= 1e-9) return row.input;
    }
    return rows->back().input;
}

}  // namespace

double length_of(const InputRows* rows) {
    double length = 0.0;
    if (rows != nullptr)
        for (const signal::Sample& row : *rows) length += std::max(row.dt, 0.0);
    return length;
}

double input_at(const SignalInput& input, double time) {
    switch (input.kind) {
        case InputKind::Hand:
            return input.hand;
        case InputKind::Square:
            return phase(time, input.period) < 0.5 ? input.amplitude : -input.amplitude;
        case InputKind::Sine:
            return input.amplitude * std::sin(2.0 * std::numbers::pi * phase(time, input.period));
        case InputKind::Noise:
            return input.amplitude * noise(time, input.period);
        case InputKind::Recorded:
            return played(input.recording.get(), time);
        case InputKind::Csv:
            return played(input.file.get(), time);
    }
    return 0.0;
}

InputRows measuring_rows(const SignalInput& input, double rate) {
    double seconds = 0.0;
    if (input.kind == InputKind::Recorded || input.kind == InputKind::Csv)
        seconds = length_of(input.kind == InputKind::Csv ? input.file.get() : input.recording.get());
    else if (input.kind != InputKind::Hand)
        seconds = input.period * std::max(2.0, std::ceil(4.0 / input.period));
    seconds = std::min(seconds, max_measured_seconds);
    InputRows rows;
    if (seconds <= 0.0) return rows;
    rows.push_back({signal::min_dt, input_at(input, 0.0)});
    const auto count = static_cast<std::size_t>(std::floor(seconds * rate + 1e-6));
    for (std::size_t i = 1; i <= count; ++i)
        rows.push_back({1.0 / rate, input_at(input, static_cast<double>(i) / rate)});
    return rows;
}

}  // namespace tendril::app
