// What a filter makes of the rows of a fit, and how far that is from what is wanted.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/labs/signal/fit.hpp"

namespace tendril::app {

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
