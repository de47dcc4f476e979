// Finds the parameters with which a filter answers an input as one wants it to: drawn, recorded, or measured
// somewhere else. So one can see which filter of the shelf to take, and with which numbers.
//
// Deterministic: the same rows give the same answer at every run, on the same build. Bounded by evaluations,
// never by time: some hundred runs of a filter over the rows where it has one parameter, twenty thousand
// where it has six. All kinds together take about 0.3 s for 300 rows.
#pragma once

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

}  // namespace tendril::app
