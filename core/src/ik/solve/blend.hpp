// Options::weight: blends from the given pose to the solved one. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Before the solve: enforces the lengths or limits of the given pose and saves it.
template <class Watch>
void save_given(Problem& problem, Watch watch) noexcept;

/// After the solve: blends the pose as options.weight says, and updates the pole's memory to match.
template <class Watch>
void blend(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
