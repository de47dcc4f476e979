// Options::weight: part of the way from the given pose to the one that was solved for. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Before the solve: brings the given joints to their lengths, or brings them within their limits, and keeps
/// them.
template <class Watch>
void save_given(Problem& problem, Watch watch) noexcept;

/// After the solve: the pose becomes the one that options.weight asks for, and is what the pole's memory
/// holds.
template <class Watch>
void blend(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
