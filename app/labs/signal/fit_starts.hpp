// Where the search for a filter's parameters begins: guesses that follow from the rows, for kinds of which a
// search all over the range misses some.
#pragma once

#include <vector>

#include "app/labs/signal/fit_space.hpp"

namespace tendril::app {

/// Filters of the kind to begin with; none for most kinds. Each can be checked by one run over the rows.
std::vector<signal::Filter> first_guesses(const signal::Kind& kind, const FitProblem& problem,
                                          const FitFacts& facts);

}  // namespace tendril::app
