#include "app/labs/signal/span.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::app {

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
    const double around = std::max(0.5 * std::abs(span.high), 1e-3);  // it does not change
    return {span.low - around, span.high + around};
}

Span widened(const Span& input, std::span<const std::span<const double>> outputs) {
    constexpr double margin = 0.15, step = 0.25, most = 1.0;  // parts of the input's range
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
    constexpr double most = 1e30;  // a float has room for what a plot makes of it
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
