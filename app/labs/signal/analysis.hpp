// Measurements and fits of the Signal lab: each filter, the whole chain at several frame rates, every kind of
// filter. All are functions of the part, recomputed only when their inputs change. Also the ranges of plots.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <tendril/signal/measure.hpp>
#include <vector>

#include "app/document/runtime.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {

// Fits every kind of filter to the desired response, a slice per tick, so that the window stays responsive.
// The progress is stored in the part and depends on the number of ticks, not on the clock.

/// The search in progress. It is a function of the part: if lost, it is redone up to the part's progress.
class FitWork {
  public:
    /// Computes one slice, some 2 to 15 ms; the last slice of a kind adds its fit to the part.
    void advance(SignalPart& part);

  private:
    /// The search of one kind, with its rows.
    struct Task {
        Task(const SignalPart& part);
        bool of(const SignalPart& part) const;
        void advance();

        InputRows rows;
        std::vector<double> wanted;
        std::vector<signal::Filter> from;
        std::size_t kind;
        FitProblem problem;
        std::unique_ptr<FitTask> task;
        std::size_t shares = 0;
        bool more = true;
    };
    std::unique_ptr<Task> task_;
};

/// The chain over its measuring rows: the input from 0 on or, for the hand, the input up to the last quarter
/// of a second. Cost: 1.5 ms for eight filters; for the hand, at most four times a second.
struct ChainAnalysis {
    std::vector<double> time, input;
    std::vector<std::vector<double>> outputs;  ///< each stage's output
    std::vector<signal::Measures> stages;      ///< each stage's output compared with the input, as plotted
    signal::Measures whole;                    ///< of the shown lane
    signal::RateComparison rates;              ///< the shown lane's
};

/// A stage with its measures; or a kind that no enabled stage has, alone on the input with its defaults.
struct ShelfPoint {
    signal::Filter filter;
    std::optional<std::size_t> stage;
    double lag = 0.0;     ///< seconds
    double jitter = 0.0;  ///< fraction of the input's
};

class SignalRuntime final : public Runtime {
  public:
    const ChainAnalysis& chain(const SignalPart& part);
    /// Stages, then kinds; only those with both a lag and a jitter.
    const std::vector<ShelfPoint>& shelf(const SignalPart& part);
    /// Each stage's output for the input of the last ticks.
    const std::vector<std::vector<double>>& recent(const SignalPart& part);

    FitWork fit_work;

  private:
    /// All inputs to the measurements.
    struct Source {
        std::vector<SignalStage> stages;  ///< without their state
        std::size_t lane = 0;
        SignalInput input;
        InputRows rows;  ///< empty if derived from `input`
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

// The y range of a plot of signals: the whole input, so that it stays legible, and a limited part of the
// outputs. A curve that grows without bound leaves the plot.

struct Span {
    double low = -1.0, high = 1.0;
    bool operator==(const Span&) const = default;
};

/// The range of an input: everything that a wave can reach; otherwise the range of the shown rows, `values`.
Span span_of(const SignalInput& input, std::span<const double> values);

/// Adds a margin and makes room for the outputs: in steps, so that the axis does not follow every swing, and
/// at most by the input's range at either end.
Span widened(const Span& input, std::span<const std::span<const double>> outputs);

/// The points of a curve with times from `from` to `to`.
Curve curve_of(std::string name, glm::vec3 colour, std::span<const double> time,
               std::span<const double> values, double from = -1e9, double to = 1e9);

/// Axes for curves over seconds.
PlotAxes time_axes(const Span& span, double from, double to);

}  // namespace tendril::app
