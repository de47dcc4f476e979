// Shared by tests of fits.
#pragma once

#include <algorithm>

#include "app/labs/signal/fit.hpp"

namespace tendril::test {

/// Whether the response determines the field: a change of 2 % leaves a residual above `least`.
inline bool excited(const signal::Filter& truth, const Field& field, int axis, const app::FitProblem& problem,
                    double least) {
    double smallest = 1e9;
    for (const double factor : {0.98, 1.02}) {
        signal::Filter other = truth;
        field.set_number(signal::fields_in(other), factor * field.number(signal::fields_in(truth), axis),
                         axis);
        if (signal::check(other)) smallest = std::min(smallest, app::residual_of(other, problem));
    }
    return smallest > least && smallest < 1e9;
}

}  // namespace tendril::test
