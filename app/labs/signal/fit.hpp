// Finds the parameters with which a filter best reproduces a desired response that was drawn, recorded, or
// measured elsewhere. Shows which kind of filter to choose, and with which parameters.
//
// Deterministic: the same rows give the same result in every run of a build. Bounded by evaluations, never by
// time: a few hundred runs of a filter over the rows for one parameter, twenty thousand for six. All kinds
// together take about 0.3 s for 300 rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
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

/// The best fit of a kind; the search also starts from `like` if it is of that kind. A parameter that this
/// input does not determine stays at its default; a threshold is put in the middle of its possible range.
Fit fit_kind(const signal::Kind& kind, const FitProblem& problem, const signal::Filter* like = nullptr);

/// Sorts by residual, best first. Residuals up to `indistinguishable` are equal; among those, fewer
/// parameters come first.
inline constexpr double indistinguishable = 1e-6;
void rank(std::vector<Fit>& fits);

/// The residual of a filter with its present parameters.
double residual_of(const signal::Filter& filter, const FitProblem& problem);

/// Maximum minus minimum; 1 if the values are constant.
double range_of(std::span<const double> values);

// Two kinds of filter have their own fits.

/// Key values and slopes follow from the key times by linear least squares. Adds keys where the residual is
/// largest as long as that helps, and improves their times.
std::unique_ptr<FitTask> begin_curve_fit(const FitProblem& problem);

/// Tries all combinations of clamp and interpolation, and returns the simplest whose residual is close to the
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
    /// The constant that, added to the last run's outputs, gives the smallest residual.
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

// The search space of a fit: its parameters, their ranges and scales; and initial guesses. Ranges follow from
// the rows: signals in degrees or at 1000 Hz fit as well as signals from 0 to 1 at 60 Hz.

/// The facts that ranges depend on.
struct FitFacts {
    explicit FitFacts(const FitProblem& problem);

    double shortest = 1.0 / 60.0;  ///< seconds: the smallest dt, ignoring values of nearly 0
    double duration = 1.0;         ///< duration of all rows, seconds
    double input_low = 0.0, input_high = 1.0;
    double response_low = 0.0, response_high = 1.0;
    double largest_jump = 1.0;  ///< of the input, from row to row
    double speed = 1.0;         ///< of the input: root mean square, 1/s

    double input_range() const { return input_high - input_low; }
    double response_range() const { return response_high - response_low; }
    double span() const;  ///< the larger of both ranges; never 0
};

/// A searched parameter: maps its values from `low` to `high` to 0 to 1.
struct Dimension {
    enum class Scale {
        Even,
        Ratio,  ///< logarithmic; low and high must be positive
        Cube,   ///< finer towards low, which it includes
        Fifth   ///< finer still
    };
    const Field* field = nullptr;
    double low = 0.0, high = 1.0;
    Scale scale = Scale::Even;
    bool stepped = false;  ///< a threshold

    double value(double at) const;
    double at(double value) const;
};

/// The search space of any kind except curve and scale_bias_clamp, which have their own fits.
std::vector<Dimension> fit_space(const signal::Kind& kind, const FitFacts& facts);

/// The dimension of one parameter; `field` must be a field of the kind.
Dimension dimension(const signal::Kind& kind, const char* field, double low, double high,
                    Dimension::Scale scale, bool stepped = false);

// Initial guesses from the rows, for kinds whose optimum a search of the whole range can miss.

/// Filters of the kind to start from; none for most kinds. Checking each takes one run over the rows.
std::vector<signal::Filter> first_guesses(const signal::Kind& kind, const FitProblem& problem,
                                          const FitFacts& facts);

// Minimises a function of a few numbers, each from 0 to 1: evaluates points spread evenly over the range,
// then improves the best with NLopt's local methods (Sbplx, Nelder-Mead). Deterministic: no random numbers,
// no clock; the number of dimensions bounds the evaluations.

using Objective = std::function<double(std::span<const double>)>;

struct Search {
    std::size_t dimensions = 1;
    /// Dimensions in which the function is a step function, as for a threshold: local methods fail there.
    std::vector<std::size_t> stepped{};
    /// Additional points to try.
    std::vector<std::vector<double>> starts{};
    double enough = 0.0;  ///< stop at this value or below
};

struct Minimum {
    std::vector<double> at;
    double value = 0.0;
    int evaluations = 0;
};

/// The search, computed in slices. Cost: some 200 evaluations in one dimension to 10 000 in six, at most 1500
/// in one slice. Values that are not finite count as very large.
class Minimiser {
  public:
    Minimiser(Objective objective, Search search);

    /// Returns whether there is more to do.
    bool advance();
    /// The best point so far.
    const Minimum& best() const { return best_; }

  private:
    using Point = std::vector<double>;

    std::size_t dimensions() const { return search_.dimensions; }
    bool enough() const { return best_.value <= search_.enough; }
    std::size_t point_count() const;
    double value(std::span<const double> at);
    void spread();
    Point scan(Point at);
    void improve(int algorithm, Point at, double step, std::size_t evaluations_each);

    Objective objective_;
    Search search_;
    Minimum best_;
    std::vector<Point> candidates_;  ///< the best of the initial points, to be improved
    std::size_t shares_ = 0;
};

}  // namespace tendril::app
