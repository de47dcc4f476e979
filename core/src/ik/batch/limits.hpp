// The limits of a batch, prepared for registers: clamping needs no angles. Not installed.
//
// Half-angles are from -pi/2 to pi/2, where the sine is monotonic, so a hinge or a twist is clamped by
// comparing sines of half-angles.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tendril/ik/limit.hpp"

namespace tendril::ik::detail {

/// A range of angles, as the sines of half of min and max.
struct HalfRange {
    float min = -1.0f, max = 1.0f;
    bool whole = true;  ///< full circle: never clamped
};

struct BatchLimit {
    enum class Kind { Free, Hinge, Cone } kind = Kind::Free;
    glm::vec3 bone{1, 0, 0}, axis{0, 0, 1}, side{0, 1, 0};  ///< as in LimitedJoint
    HalfRange range;                                        ///< range of the hinge's angle or of the twist
    float up = 0, down = 0, left = 0, right = 0;            ///< 1 / half-angle^2
};

/// The limits of a batch, shared by all its chains.
struct BatchLimits {
    std::vector<Limit> limits;               ///< as given, for the scalar solver
    std::vector<glm::vec3> rest_directions;  ///< one per bone
    std::vector<BatchLimit> prepared;        ///< empty if the register clamp does not support some limit
};

/// The limits must be valid.
BatchLimits batch_limits(std::span<const Limit> limits, std::span<const glm::vec3> rest_directions);

}  // namespace tendril::ik::detail
