// How the tip of a chain within limits moves as its angles change: the Jacobian over the angles that the
// limits leave a joint, one for a hinge, two of swing and one of twist otherwise; in units of the reach, so
// that no size of chain overflows. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// What is asked, in reaches: the tip's way to go, and with an orientation the turn to go, scaled as error_of
/// has it.
struct Wanted {
    glm::vec3 move{0.0f}, turn{0.0f};
    float scale = 0.0f;  ///< reaches a radian; 0 without an orientation
};

/// Fills room.limited.angles, axes and columns from the pose of the problem.
void linearize(Problem& problem) noexcept;

Wanted wanted_of(const Problem& problem) noexcept;

/// By how much each angle of a joint changes if all follow `by`: J' by.
JointAngles change_of(const LimitedRoom& room, std::size_t i, const Wanted& by) noexcept;

/// Takes away the columns along which that change would push a joint out of its limit; whether there was any.
bool hold_back(Problem& problem, const Wanted& by) noexcept;

}  // namespace tendril::ik::detail
