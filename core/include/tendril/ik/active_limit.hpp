// Explains which active limit keeps a tip from its target: "elbow (hinge) stops at 145 degrees; the target
// needs 162".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "tendril/fields.hpp"
#include "tendril/ik/limit.hpp"

namespace tendril::ik {

/// One bound of a limit.
enum class Bound : std::uint8_t { Min, Max, Up, Down, Left, Right, TwistMin, TwistMax };
/// "twist_max"
const char* name(Bound bound) noexcept;

struct ActiveLimit {
    std::size_t joint = 0;  ///< index of the limited joint: the start of the limit's bone
    JointKind kind = JointKind::Free;
    Bound bound = Bound::Max;
    /// The angle at which the joint stops, radians, with the sign of the limit's field (down and right are
    /// positive). On the rim of a cone, between two half-angles, less than either.
    float limit = 0.0f;
    /// The angle that would reach the target if only this joint were free, radians; if none does, the angle
    /// that brings the tip nearest.
    float needed = 0.0f;
    bool enough = false;  ///< freeing this joint alone lets the tip reach the target

    bool operator==(const ActiveLimit&) const = default;
};

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::ActiveLimit>() noexcept;
