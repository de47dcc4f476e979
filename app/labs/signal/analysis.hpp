// What the Signal lab measures: of each filter, of the whole chain at several frame rates, of the whole
// shelf. All of it follows from the part, and is worked out again only when what it follows from has changed.
#pragma once

#include <span>
#include <string>
#include <tendril/signal/measure.hpp>
#include <vector>

#include "app/document/runtime.hpp"
#include "app/labs/signal/fitting.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {

/// Of a filter on the input that reaches it at the measuring rate.
using StageMeasures = signal::Measures;

/// The chain over its measuring rows: for the hand those that went in up to the last quarter of a second,
/// else the input from 0 on. Cost: 1.5 ms for eight filters, and for the hand no more often than that.
struct ChainAnalysis {
    std::vector<double> time, input;
    std::vector<std::vector<double>> outputs;  ///< of each stage
    std::vector<StageMeasures> stages;         ///< of those that are off: what passing through measures
    StageMeasures whole;
    signal::RateComparison rates;  ///< of the whole chain
};

/// A kind of filter on the lab's input.
struct ShelfPoint {
    signal::Filter filter;
    std::optional<std::size_t> stage;  ///< that it is set as; the kind's defaults where the chain has none
    double lag = 0.0;                  ///< seconds
    double jitter = 0.0;               ///< part of the input's
};

class SignalRuntime final : public Runtime {
  public:
    const ChainAnalysis& chain(const SignalPart& part);
    /// Those that both can be measured of.
    const std::vector<ShelfPoint>& shelf(const SignalPart& part);
    /// What the chain would have made of what went in during the last ticks: one list for each stage.
    const std::vector<std::vector<double>>& recent(const SignalPart& part);

    FitWork fit_work;

  private:
    /// All that the numbers follow from.
    struct Source {
        std::vector<std::pair<signal::Filter, bool>> filters;
        SignalInput input;
        InputRows rows;  ///< as far as they do not follow from the input
        bool operator==(const Source&) const = default;
    };
    static Source source_of(const SignalPart& part, InputRows rows);
    static Source measured(const SignalPart& part);

    std::optional<Source> chain_source_, shelf_source_, recent_source_;
    ChainAnalysis chain_;
    std::vector<ShelfPoint> shelf_;
    std::vector<std::vector<double>> recent_;
};

inline SignalRuntime& signal_runtime(const Workspace& workspace) {
    return workspace.runtimes.of<SignalRuntime>(signal_lab);
}

// How much of the y axis a plot of signals shows: all of the input, so that it stays legible, and of what
// comes out as much as goes with it. A curve that grows without bound leaves the plot.

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
