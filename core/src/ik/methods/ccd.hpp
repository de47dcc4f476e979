// Cyclic coordinate descent: one joint after the other, from the tip's side to the root, turns so that the
// tip lies on its line to the target. Not installed.
//
// Source: L.-C. T. Wang, C. C. Chen, "A combined optimization method for solving the inverse kinematics
// problem of mechanical manipulators", IEEE Transactions on Robotics and Automation 7(4), 1991.
//
// Cost: O(n) an iteration. While a joint turns, those nearer to the root stand still; so the pass that finds
// the turns moves nothing but the tip, and a second one applies all of them.
//
// It converges to any target within reach, but near full reach it crawls, and it curls the bones near the tip
// first: a joint there turns as willingly as one at the root, and gets to go first.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

template <class Watch>
void ccd_iteration(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
