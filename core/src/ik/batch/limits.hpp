// The limits of a batch, made ready for registers: what a clamp needs of them without an angle being
// measured. Not installed.
//
// Half angles run from -pi/2 to pi/2, where the sine grows: so a hinge or a twist is clamped by comparing the
// sines of half angles.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "tendril/ik/limit.hpp"

namespace tendril::ik::detail {

/// From the sine of half of min to that of half of max.
struct HalfRange {
    float min = -1.0f, max = 1.0f;
    bool whole = true;  ///< all around: never clamped
};

struct BatchLimit {
    enum class Kind { Free, Hinge, Cone } kind = Kind::Free;
    glm::vec3 bone{1, 0, 0}, axis{0, 0, 1}, side{0, 1, 0};  ///< as LimitedJoint has them
    HalfRange range;                                        ///< of the hinge's angle, or of the twist
    float up = 0, down = 0, left = 0, right = 0;            ///< 1 / half-angle^2
};

/// What a limited batch keeps; the same for all of its chains.
struct BatchLimits {
    std::vector<Limit> limits;               ///< as they were given, for the scalar solver
    std::vector<glm::vec3> rest_directions;  ///< one a bone
    std::vector<BatchLimit> ready;  ///< empty where some limit is beyond what a register's clamp can do
};

/// The limits must be without fault.
BatchLimits batch_limits(std::span<const Limit> limits, std::span<const glm::vec3> rest_directions);

}  // namespace tendril::ik::detail
