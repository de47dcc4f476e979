// The methods without limits: one function an iteration, compiled for Unwatched and Watched. Each file begins
// with its method's source, what it computes and its cost; all are O(n). Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

// fabrik.cpp

/// Forward reaching (from the tip), then backward reaching (from the root).
template <class Watch>
void fabrik_iteration(Problem& problem, Watch watch) noexcept;
/// The same, and a step that fits the span from root to tip.
template <class Watch>
void accelerated_fabrik_iteration(Problem& problem, Watch watch) noexcept;

// accelerate.cpp

/// That step, after a pair of passes that left the tip `residual` from the target. Moves nothing unless that
/// gets less.
template <class Watch>
void accelerate(Problem& problem, float residual, Watch watch) noexcept;

// ccd.cpp

template <class Watch>
void ccd_iteration(Problem& problem, Watch watch) noexcept;
/// CCD's rotation of one joint: the minimal one about `at` that brings the tip onto the line to the target.
/// None where the tip or the target is so near to `at` that there is no line.
glm::quat rotation_towards(const Problem& problem, const glm::vec3& at, const glm::vec3& tip) noexcept;

// jacobian.cpp

template <class Watch>
void jacobian_transpose_iteration(Problem& problem, Watch watch) noexcept;
/// `damping`: that of the options, as part of the reach.
template <class Watch>
void dls_iteration(Problem& problem, float damping, Watch watch) noexcept;
template <class Watch>
void svd_dls_iteration(Problem& problem, float damping, Watch watch) noexcept;

// two_bone.cpp; the closed form itself is in tendril/ik/two_bone.hpp

/// Only for two bones, InvalidInput for others. Faces the pole by itself, no faster than pole.hpp allows, and
/// remembers the pose as face_pole does. Calls no iteration_done: that is the loop's.
template <class Watch>
Report two_bone_solve(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
