// In which ways the joints of a pose may turn, and how its tip moves as they do. Not installed.
//
// Each joint is a ball joint that turns about any axis in the world, less the axes that its limit forbids:
// a hinge keeps one, a joint at a bound loses the one that leads out of the limit if the chain pushes that
// way (an active limit). So no angles are needed, and a joint well inside its limit costs what a ball joint
// costs. Lengths are in reaches, so that no size of chain overflows.
#pragma once

#include "ik/limits/workspace.hpp"
#include "ik/solve/problem.hpp"
#include "math/symmetric3.hpp"

namespace tendril::ik::detail {

/// What is asked, in reaches: the tip's way to go, and with an orientation the rotation to go, scaled as
/// error_of has it.
struct Wanted {
    glm::vec3 move{0.0f}, rotation{0.0f};
    float scale = 0.0f;  ///< reaches a radian; 0 without an orientation
};
Wanted wanted_of(const Problem& problem) noexcept;

/// J J' of the tip's three coordinates and, where an orientation is asked for, its three rotations. `both`:
/// the columns of the block that ties them.
struct Normal {
    math::Symmetric3 moves, rotations;
    std::array<glm::dvec3, 3> both{};
};

/// Fills scratch.freedoms from the pose, and the numbers of those at a bound; no limit is active yet.
Normal linearize(Problem& problem, const Wanted& wanted) noexcept;

/// How a joint turns if all follow `by`, about an axis in the world, radians: J' by.
glm::vec3 rotation_by(const JointFreedom& freedom, const Wanted& by) noexcept;

/// Makes the bounds active that the turns by `by` push against, and takes them out of the matrix; whether
/// there were any.
bool activate(Problem& problem, const Wanted& by, Normal& normal) noexcept;

}  // namespace tendril::ik::detail
