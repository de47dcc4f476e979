// The search space of a fit: its parameters, their ranges and scales; and initial guesses. Ranges follow from
// the rows: signals in degrees or at 1000 Hz fit as well as signals from 0 to 1 at 60 Hz.
#pragma once

#include <tendril/signal/filter.hpp>
#include <vector>

#include "app/labs/signal/fit.hpp"

namespace tendril::app {

/// The facts that ranges depend on.
struct FitFacts {
    explicit FitFacts(const FitProblem& problem);

    double shortest = 1.0 / 60.0;  ///< seconds: the smallest dt, ignoring values of nearly 0
    double duration = 1.0;         ///< seconds of all rows
    double input_low = 0.0, input_high = 1.0;
    double response_low = 0.0, response_high = 1.0;
    double largest_jump = 1.0;  ///< the input's, from row to row
    double speed = 1.0;         ///< the input's: root mean square, 1/s

    double input_range() const { return input_high - input_low; }
    double response_range() const { return response_high - response_low; }
    double span() const;  ///< the larger range; never 0
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

/// The space of any kind but curve and scale_bias_clamp, which have fits of their own.
std::vector<Dimension> fit_space(const signal::Kind& kind, const FitFacts& facts);

/// The dimension of one parameter; `field` must be a field of the kind.
Dimension dimension(const signal::Kind& kind, const char* field, double low, double high,
                    Dimension::Scale scale, bool stepped = false);

// Initial guesses from the rows, for kinds whose optimum a search of the whole range can miss.

/// Filters of the kind to start from; none for most kinds. Checking each takes one run over the rows.
std::vector<signal::Filter> first_guesses(const signal::Kind& kind, const FitProblem& problem,
                                          const FitFacts& facts);

}  // namespace tendril::app
