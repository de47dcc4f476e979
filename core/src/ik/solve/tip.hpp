// A tip orientation without limits: the last bone is placed as it is asked for, and the chain before it
// brings its start to where that leaves it. Any method can do that. With limits the last joint has a say too,
// and limited.cpp does both at once. Not installed.
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/report.hpp"

namespace tendril::ik::detail {

/// options.tip_orientation is set and there are no limits. The status is that of the chain without its last
/// bone, the residual that of the tip. A two-bone solver takes three bones here, or two, of which one is
/// left.
template <class Watch>
Report run_with_tip_orientation(Method method, Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
