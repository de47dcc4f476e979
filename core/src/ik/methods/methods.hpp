// The methods without limits: one function per iteration, compiled for Unwatched and Watched. Each file
// begins with its method's source, what it computes and its cost; all are O(n). Not installed.
#pragma once

#include <optional>

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

// fabrik.cpp

/// Forward reaching (from the tip), then backward reaching (from the root).
template <class Watch>
void fabrik_iteration(Problem& problem, Watch watch) noexcept;
/// fabrik_iteration, plus a step that fits the span from root to tip.
template <class Watch>
void accelerated_fabrik_iteration(Problem& problem, Watch watch) noexcept;

// accelerate.cpp

/// The step that fits the span, after a pair of passes that left the tip `residual` from the target. Moves
/// nothing unless it reduces the residual.
template <class Watch>
void accelerate(Problem& problem, float residual, Watch watch) noexcept;

// ccd.cpp

template <class Watch>
void ccd_iteration(Problem& problem, Watch watch) noexcept;
/// CCD's rotation of one joint: the minimal one about `at` that brings the tip onto the line to the target.
/// Identity if the tip or the target is too close to `at` to define a line.
glm::quat rotation_towards(const Problem& problem, const glm::vec3& at, const glm::vec3& tip,
                           const glm::vec3& target) noexcept;

// jacobian.cpp

template <class Watch>
void jacobian_transpose_iteration(Problem& problem, Watch watch) noexcept;
/// `damping`: the options' damping, a fraction of the reach.
template <class Watch>
void dls_iteration(Problem& problem, float damping, Watch watch) noexcept;
template <class Watch>
void svd_dls_iteration(Problem& problem, float damping, Watch watch) noexcept;

// two_bone.cpp; the closed form itself is in tendril/ik/two_bone.hpp

/// The pole of the closed form: the options' pole, or in a plane one on the chosen side.
std::optional<glm::vec3> pole_of_limb(const Problem& problem) noexcept;
/// Takes two bones; otherwise InvalidInput. Faces the pole itself, no faster than pole.hpp allows, and
/// remembers the pose as face_pole does. Does not call iteration_done: the loop does.
template <class Watch>
Report two_bone_solve(Problem& problem, Watch watch) noexcept;

}  // namespace tendril::ik::detail
