// Finds the parameters with which a filter best reproduces a desired response: drawn, recorded, or measured
// elsewhere. Shows which kind of filter to choose, and with which parameters.
//
// Deterministic: the same rows give the same result in every run of a build. Bounded by evaluations, never by
// time: a few hundred runs of a filter over the rows for one parameter, twenty thousand for six. All kinds
// together take about 0.3 s for 300 rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <tendril/signal/filter.hpp>
#include <tendril/signal/run.hpp>
#include <vector>

namespace tendril::app {

/// The rows of an input, and the desired response.
struct FitProblem {
    std::span<const signal::Sample> samples;
    std::span<const double> response;  ///< one for each sample
};

struct Fit {
    signal::Filter filter;
    /// Root mean square of the differences, as a fraction of the response's range.
    double residual = 0.0;
    int evaluations = 0;
};

/// The fit of one kind, computed in slices. The problem and its rows must outlive it.
class FitTask {
  public:
    virtual ~FitTask() = default;
    /// Returns whether there is more to do.
    virtual bool advance() = 0;
    /// Call once advance() has returned false.
    virtual Fit fit() = 0;
    /// Runs of a filter over the rows so far.
    virtual int evaluations() const = 0;
};
std::unique_ptr<FitTask> begin_fit(const signal::Kind& kind, const FitProblem& problem,
                                   const signal::Filter* like = nullptr);

/// The best fit of a kind, searched from `like` too if that is of the kind. A parameter that this input does
/// not determine stays at its default; a threshold that may be anywhere in a range is put in its middle.
Fit fit_kind(const signal::Kind& kind, const FitProblem& problem, const signal::Filter* like = nullptr);

/// Sorts by residual, best first. Residuals up to `indistinguishable` are equal; then the filter with fewer
/// parameters comes first.
inline constexpr double indistinguishable = 1e-6;
void rank(std::vector<Fit>& fits);

/// The residual of a filter with its present parameters.
double residual_of(const signal::Filter& filter, const FitProblem& problem);

/// Maximum less minimum; 1 if the values are constant.
double range_of(std::span<const double> values);

// Two kinds of filter with fits of their own.

/// Key values and slopes follow from the key times by linear least squares. Adds keys where the residual is
/// largest while that helps, and improves their times.
std::unique_ptr<FitTask> begin_curve_fit(const FitProblem& problem);

/// Tries with and without clamp and interpolation, and returns the simplest whose residual is close to the
/// best. The range map stays off, since scale and bias can express it.
std::unique_ptr<FitTask> begin_scale_fit(const FitProblem& problem);

// Runs a filter over the rows of a problem and compares the output with the desired response.

/// Smaller residuals count as exact.
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
    /// The residual of the last run, with `shift` added to every output.
    double residual(double shift = 0.0) const {
        double squares = 0.0;
        for (std::size_t i = 0; i < output_.size(); ++i) {
            const double difference = output_[i] + shift - problem_.response[i];
            squares += difference * difference;
        }
        return std::sqrt(squares / rows()) / range_;
    }
    /// The shift of the last run's outputs with the smallest residual.
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
