// FABRIK's two pulls within limits, after Aristidou, Chrysanthou and Lasenby (2016): wherever a bone is laid,
// the turn between it and the bone that was laid before it is brought within the limit of their joint, so the
// pull from the tip hands on to the root how the bones must be turned about themselves. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// A pull from the tip and one from the root. After it every joint is within its limit.
template <class Watch>
void limited_pulls(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
