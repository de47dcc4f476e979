#include "app/labs/signal/analysis.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::app {
namespace {

constexpr double measuring_rate = 60.0;

/// The hand's input up to the last full quarter of a second, over a time that is still remembered: the
/// measurements then change four times a second, not every tick, and stay readable.
InputRows hand_rows(const SignalPart& part) {
    constexpr double every = 0.25, same = 1e-6;
    InputRows rows;
    if (part.past.empty()) return rows;
    const double until = std::floor((part.time + same) / every) * every;
    const double from = until - (part.past.back().dt * static_cast<double>(max_past) - every);
    double time = part.time;
    for (std::size_t i = part.past.size(); i-- > 0; time -= std::max(part.past[i].dt, 0.0)) {
        if (time > until + same) continue;
        if (time <= from + same) break;
        rows.push_back(part.past[i]);
    }
    std::reverse(rows.begin(), rows.end());
    return rows;
}

InputRows measured_rows(const SignalPart& part) {
    return part.input.kind == InputKind::Hand ? hand_rows(part) : measuring_rows(part.input, measuring_rate);
}

std::vector<double> inputs_of(const InputRows& rows) {
    std::vector<double> inputs;
    inputs.reserve(rows.size());
    for (const signal::Sample& row : rows) inputs.push_back(row.input);
    return inputs;
}

signal::Measures measure(const std::vector<double>& time, const std::vector<double>& input,
                         const std::vector<double>& output, std::span<const signal::Filter> filters) {
    std::vector<double> wanted;
    wanted.reserve(input.size());
    for (const double each : input) wanted.push_back(signal::immediate(filters, each));
    return signal::measure({time, wanted, output}, input);
}

ChainAnalysis analyse(const SignalPart& part) {
    ChainAnalysis analysis;
    const InputRows rows = measured_rows(part);
    analysis.time = signal::times_of(rows);
    analysis.input = inputs_of(rows);
    analysis.outputs = outputs_for(part, rows);
    for (std::size_t i = 0; i < part.stages.size(); ++i) {
        const auto filters = enabled_filters(part, {lane_of(part, i).first, i + 1});
        signal::Measures measures = measure(analysis.time, analysis.input, analysis.outputs[i], filters);
        if (part.stages[i].enabled)
            measures.rate_difference = signal::compare_rates(filters, rows).difference;
        analysis.stages.push_back(measures);
    }
    const Lane lane = shown_lane(part);
    const std::vector<signal::Filter> filters = enabled_filters(part, lane);
    analysis.whole = measure(analysis.time, analysis.input,
                             lane.end > 0 ? analysis.outputs[lane.end - 1] : analysis.input, filters);
    analysis.rates = signal::compare_rates(filters, rows);
    analysis.whole.rate_difference = analysis.rates.difference;
    return analysis;
}

std::vector<ShelfPoint> measure_shelf(const SignalPart& part, const ChainAnalysis& chain) {
    std::vector<ShelfPoint> points;
    const auto add = [&](const signal::Filter& filter, std::optional<std::size_t> stage,
                         const signal::Measures& measures) {
        if (measures.lag && measures.jitter)
            points.push_back({filter, stage, *measures.lag, *measures.jitter});
    };
    for (std::size_t i = 0; i < part.stages.size(); ++i)
        if (part.stages[i].enabled) add(part.stages[i].filter, i, chain.stages[i]);
    const InputRows rows = measured_rows(part);
    for (const signal::Kind& kind : signal::kinds()) {
        if (std::ranges::any_of(part.stages, [&](const SignalStage& stage) {
                return stage.enabled && &signal::kind_of(stage.filter) == &kind;
            }))
            continue;
        const signal::Filter filter = kind.blank();
        const std::span<const signal::Filter> filters(&filter, 1);
        add(filter, std::nullopt, measure(chain.time, chain.input, signal::run(filters, rows), filters));
    }
    return points;
}

}  // namespace

SignalRuntime::Source SignalRuntime::source_of(const SignalPart& part, InputRows rows) {
    Source source;
    source.stages = part.stages;
    for (SignalStage& stage : source.stages) stage.state = {};
    source.lane = shown_lane(part).first;
    source.input = part.input;
    if (part.input.kind == InputKind::Hand) source.input.hand = 0.0;  // the next tick adds it to `past`
    source.rows = std::move(rows);
    return source;
}

/// The source of the measured rows. Rows derived from the input need not be compared.
SignalRuntime::Source SignalRuntime::measured(const SignalPart& part) {
    return source_of(part, part.input.kind == InputKind::Hand ? hand_rows(part) : InputRows());
}

const ChainAnalysis& SignalRuntime::chain(const SignalPart& part) {
    if (Source source = measured(part); chain_source_ != source) {
        chain_ = analyse(part);
        chain_source_ = std::move(source);
    }
    return chain_;
}

const std::vector<ShelfPoint>& SignalRuntime::shelf(const SignalPart& part) {
    if (Source source = measured(part); shelf_source_ != source) {
        shelf_ = measure_shelf(part, chain(part));
        shelf_source_ = std::move(source);
    }
    return shelf_;
}

const std::vector<std::vector<double>>& SignalRuntime::recent(const SignalPart& part) {
    if (Source source = source_of(part, part.past); recent_source_ != source) {
        recent_ = outputs_for(part, part.past);
        recent_source_ = std::move(source);
    }
    return recent_;
}

Span span_of(const SignalInput& input, std::span<const double> values) {
    const bool wave =
        input.kind == InputKind::Square || input.kind == InputKind::Sine || input.kind == InputKind::Noise;
    Span span = wave ? Span{-std::abs(input.amplitude), std::abs(input.amplitude)} : Span{};
    const auto include = [&](std::span<const double> rows) {
        if (rows.empty()) return;
        const auto [low, high] = std::minmax_element(rows.begin(), rows.end());
        span.low = std::min(span.low, *low), span.high = std::max(span.high, *high);
    };
    if ((input.kind == InputKind::Recorded || input.kind == InputKind::Csv) && !values.empty())
        span = {values.front(), values.front()};
    include(values);
    if (span.high - span.low > 1e-6 * std::max(std::abs(span.low), std::abs(span.high))) return span;
    const double around = std::max(0.5 * std::abs(span.high), 1e-3);  // it is constant
    return {span.low - around, span.high + around};
}

Span widened(const Span& input, std::span<const std::span<const double>> outputs) {
    constexpr double margin = 0.15, step = 0.25, most = 1.0;  // fractions of the input's range
    const double range = input.high - input.low;
    double below = 0.0, above = 0.0;
    for (const std::span<const double> output : outputs)
        for (const double value : output) {
            below = std::max(below, (input.low - value) / range);
            above = std::max(above, (value - input.high) / range);
        }
    const auto room = [&](double past) {
        return past <= margin ? margin : margin + std::min(std::ceil((past - margin) / step) * step, most);
    };
    return {input.low - room(below) * range, input.high + room(above) * range};
}

Curve curve_of(std::string name, glm::vec3 colour, std::span<const double> time,
               std::span<const double> values, double from, double to) {
    constexpr double most = 1e30;  // keeps the plot within the range of floats
    Curve curve{std::move(name), colour, {}};
    curve.points.reserve(time.size());
    for (std::size_t i = 0; i < time.size() && i < values.size(); ++i)
        if (time[i] >= from && time[i] <= to + 1e-6)
            curve.points.push_back(
                {static_cast<float>(time[i]), static_cast<float>(std::clamp(values[i], -most, most))});
    return curve;
}

PlotAxes time_axes(const Span& span, double from, double to) {
    return {.x = "time, s",
            .min_y = 0.0f,
            .from_x = static_cast<float>(from),
            .min_x = static_cast<float>(to),
            .low_y = static_cast<float>(span.low),
            .high_y = static_cast<float>(span.high),
            .fixed_y = true,
            .reads_all = true};
}

}  // namespace tendril::app
