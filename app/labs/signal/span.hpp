// How much of the y axis a plot of signals shows: all of the input, so that it stays legible, and of what
// comes out as much as goes with it. A curve that grows without bound leaves the plot.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/labs/signal/signal_input.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {

struct Span {
    double low = -1.0, high = 1.0;
    bool operator==(const Span&) const = default;
};

/// Of an input: from the start on all that a wave does, else what `values`, those shown, do.
Span span_of(const SignalInput& input, std::span<const double> values);

/// With a margin, and wider where a value goes further: in steps, so that the axis does not follow every
/// swing, and by no more than the input's own range either way.
Span widened(const Span& input, std::span<const std::span<const double>> outputs);

/// The points of a curve from `from` to `to`.
Curve curve_of(std::string name, glm::vec3 colour, std::span<const double> time,
               std::span<const double> values, double from = -1e9, double to = 1e9);

/// Of curves over seconds.
PlotAxes time_axes(const Span& span, double from, double to);

}  // namespace tendril::app
