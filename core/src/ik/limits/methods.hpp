// The methods within limits: each elementary step is followed by bringing what it moved within the limits.
// Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/method.hpp"

namespace tendril::ik::detail {

/// FABRIK's forward and backward reaching, from scratch.pose to scratch.trial, of which every joint is within
/// its limit. After Aristidou, Chrysanthou and Lasenby (2016): wherever a bone is placed, the rotation
/// between it and the bone that was placed before it is clamped to the limit of their joint, so forward
/// reaching hands on to the root how the bones must be twisted.
template <class Watch>
void limited_reaching(Problem& problem, Watch watch) noexcept;

/// One iteration of a method other than the default, on scratch.pose.
template <class Watch>
void limited_iteration(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
