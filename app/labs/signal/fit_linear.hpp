// Two kinds of filter that are fitted in ways of their own.
#pragma once

#include "app/labs/signal/fit.hpp"

namespace tendril::app {

/// Values and slopes of the keys follow from their times by linear least squares; keys are added where most
/// is left, as long as that helps, and their times improved.
Fit fit_curve(const FitProblem& problem);

/// With and without its clamp and its interpolation: the simplest that leaves as little as the best. The
/// range map, which scale and bias can say as well, stays off.
Fit fit_scale_bias_clamp(const FitProblem& problem);

}  // namespace tendril::app
