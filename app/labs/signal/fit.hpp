// Finds the parameters with which a filter answers an input as one wants it to: drawn, recorded, or measured
// somewhere else. So one can see which filter of the shelf to take, and with which numbers.
//
// Deterministic: the same rows give the same answer at every run, on the same build. Bounded by evaluations,
// never by time: some hundred runs of a filter over the rows where it has one parameter, twenty thousand
// where it has six. All kinds together take about 0.3 s for 300 rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <tendril/signal/filter.hpp>
#include <tendril/signal/run.hpp>
#include <vector>

namespace tendril::app {

/// Rows of an input, and what should come of it.
struct FitProblem {
    std::span<const signal::Sample> samples;
    std::span<const double> response;  ///< one for each sample
};

struct Fit {
    signal::Filter filter;
    /// What is left: the root mean square of the differences, as a part of the response's range.
    double residual = 0.0;
    int evaluations = 0;
};

/// A fit of one kind, worked out a share at a time. The problem and its rows have to outlive it.
class FitTask {
  public:
    virtual ~FitTask() = default;
    /// Whether there is more to do after this share.
    virtual bool advance() = 0;
    /// When there is nothing more to do.
    virtual Fit fit() = 0;
    /// Runs of a filter over the rows, so far.
    virtual int evaluations() const = 0;
};
std::unique_ptr<FitTask> begin_fit(const signal::Kind& kind, const FitProblem& problem,
                                   const signal::Filter* like = nullptr);

/// The best of a kind, beginning from `like` too where that is of the kind. A parameter that this input says
/// nothing about is left at its default; where a range of a threshold does equally well, it is the middle.
Fit fit_kind(const signal::Kind& kind, const FitProblem& problem, const signal::Filter* like = nullptr);

/// Every kind's, the best first: by what is left, where residuals of up to `indistinguishable` count as equal
/// and the filter with fewer parameters comes first.
inline constexpr double indistinguishable = 1e-6;
void rank(std::vector<Fit>& fits);

/// Of a filter as it is.
double residual_of(const signal::Filter& filter, const FitProblem& problem);

/// The range of a response; 1 where it does not change.
double range_of(std::span<const double> values);

// Two kinds of filter that are fitted in ways of their own.

/// Values and slopes of the keys follow from their times by linear least squares; keys are added where most
/// is left, as long as that helps, and their times improved.
std::unique_ptr<FitTask> begin_curve_fit(const FitProblem& problem);

/// With and without its clamp and its interpolation: the simplest that leaves as little as the best. The
/// range map, which scale and bias can say as well, stays off.
std::unique_ptr<FitTask> begin_scale_fit(const FitProblem& problem);

// What a filter makes of the rows of a fit, and how far that is from what is wanted.

/// Residuals under this leave nothing to improve.
inline constexpr double exact_residual = 1e-7;

class Trial {
  public:
    explicit Trial(const FitProblem& problem)
        : problem_(problem), range_(range_of(problem.response)), output_(problem.samples.size()) {}

    void run(const signal::Filter& filter) {
        signal::FilterState state;
        for (std::size_t i = 0; i < output_.size(); ++i)
            output_[i] = signal::step(filter, state, problem_.samples[i].input, problem_.samples[i].dt);
    }
    /// Of the last run, with so much added to every output.
    double residual(double shift = 0.0) const {
        double squares = 0.0;
        for (std::size_t i = 0; i < output_.size(); ++i) {
            const double difference = output_[i] + shift - problem_.response[i];
            squares += difference * difference;
        }
        return std::sqrt(squares / rows()) / range_;
    }
    /// What, added to every output of the last run, leaves the smallest residual.
    double best_shift() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < output_.size(); ++i) sum += problem_.response[i] - output_[i];
        return sum / rows();
    }
    double residual_of(const signal::Filter& filter) {
        run(filter);
        return residual();
    }

  private:
    double rows() const { return static_cast<double>(std::max<std::size_t>(output_.size(), 1)); }

    const FitProblem& problem_;
    double range_;
    std::vector<double> output_;
};

}  // namespace tendril::app
