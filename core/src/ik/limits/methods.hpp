// The methods within limits: after each elementary step, a clamp of the joints that moved. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/method.hpp"

namespace tendril::ik::detail {

/// FABRIK's forward and backward reaching, from scratch.pose to scratch.trial, with every joint within its
/// limit. After Aristidou, Chrysanthou and Lasenby (2016): whenever a bone is placed, the rotation between it
/// and the previously placed bone is clamped to the limit of their joint, so forward reaching propagates the
/// required twist to the root.
template <class Watch>
void limited_reaching(Problem& problem, Watch watch) noexcept;

/// One iteration of a method other than the default, on scratch.pose.
template <class Watch>
void limited_iteration(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
