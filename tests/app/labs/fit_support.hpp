// What tests of fits share.
#pragma once

#include <algorithm>

#include "app/labs/signal/fit.hpp"

namespace tendril::test {

/// Whether the response says what the field is: where it is 2 % off, more than `least` is left.
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
