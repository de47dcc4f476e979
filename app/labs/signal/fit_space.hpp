// What is searched when filters are fitted: which parameters, over which ranges, on what scale. The ranges
// follow from the rows at hand, so that a signal in degrees or at 1000 Hz is fitted as well as one from 0 to
// 1 at 60.
#pragma once

#include <optional>
#include <tendril/signal/filter.hpp>
#include <vector>

#include "app/labs/signal/fit.hpp"

namespace tendril::app {

/// What the ranges follow from.
struct FitFacts {
    explicit FitFacts(const FitProblem& problem);

    double shortest = 1.0 / 60.0;  ///< seconds: the smallest dt, but for what takes next to no time
    double duration = 1.0;         ///< seconds of all rows
    double input_low = 0.0, input_high = 1.0;
    double response_low = 0.0, response_high = 1.0;
    double largest_jump = 1.0;  ///< of the input from row to row
    double speed = 1.0;         ///< of the input, root mean square, 1/s

    double input_range() const { return input_high - input_low; }
    double response_range() const { return response_high - response_low; }
    double span() const;  ///< the larger of both; never 0
};

/// One searched parameter: its values from `low` to `high` lie at 0 to 1 of a dimension.
struct Dimension {
    enum class Scale {
        Even,
        Ratio,  ///< by ratio: low and high are over 0
        Cube,   ///< finer the nearer to low, which it reaches
        Fifth   ///< finer still
    };
    const Field* field = nullptr;
    double low = 0.0, high = 1.0;
    Scale scale = Scale::Even;
    bool stepped = false;  ///< a threshold

    double value(double at) const;
    double at(double value) const;
};

/// Of a kind of filter but a curve and scale_bias_clamp, which are fitted in their own ways.
std::vector<Dimension> fit_space(const signal::Kind& kind, const FitFacts& facts);

/// The dimension of a number; `field` must be one of the kind's.
Dimension dimension(const signal::Kind& kind, const char* field, double low, double high,
                    Dimension::Scale scale, bool stepped = false);

// Where the search for a filter's parameters begins: guesses that follow from the rows, for kinds of which a
// search all over the range misses some.

/// Filters of the kind to begin with; none for most kinds. Each can be checked by one run over the rows.
std::vector<signal::Filter> first_guesses(const signal::Kind& kind, const FitProblem& problem,
                                          const FitFacts& facts);

}  // namespace tendril::app
