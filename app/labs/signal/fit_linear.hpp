// Two kinds of filter that are fitted in ways of their own.
#pragma once

#include "app/labs/signal/fit.hpp"

namespace tendril::app {

/// Values and slopes of the keys follow from their times by linear least squares; keys are added where most
/// is left, as long as that helps, and their times improved.
std::unique_ptr<FitTask> begin_curve_fit(const FitProblem& problem);

/// With and without its clamp and its interpolation: the simplest that leaves as little as the best. The
/// range map, which scale and bias can say as well, stays off.
std::unique_ptr<FitTask> begin_scale_fit(const FitProblem& problem);

}  // namespace tendril::app
