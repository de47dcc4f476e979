// Method::TwoBone; the closed form itself is in tendril/ik/two_bone.hpp. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Only for two bones, InvalidInput for others. Faces the pole by itself, no faster than pole.hpp allows, and
/// remembers the pose as face_pole does. Calls no iteration_done: that is the loop's.
template <class Watch>
Report two_bone_solve(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
