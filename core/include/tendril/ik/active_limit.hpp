// The active limit that keeps a tip from its target, explained: "elbow (hinge) stops at 145 degrees; the
// target needs 162".
#pragma once

#include <cstddef>
#include <cstdint>

#include "tendril/ik/limit.hpp"

namespace tendril::ik {

/// Which of a limit's numbers.
enum class Bound : std::uint8_t { Min, Max, Up, Down, Left, Right, TwistMin, TwistMax };
/// "twist_max"
const char* name(Bound bound) noexcept;

struct ActiveLimit {
    std::size_t joint = 0;  ///< the bone's first joint, as limits are counted
    JointKind kind = JointKind::Free;
    Bound bound = Bound::Max;
    /// Radians: where the joint stops, as the limit's field counts it (down and right are positive). On the
    /// rim of a cone between two half-angles it is less than either.
    float limit = 0.0f;
    /// Radians: the angle that the target needs, if this joint alone were free; where that is not enough, the
    /// angle that brings the tip nearest.
    float needed = 0.0f;
    bool enough = false;  ///< whether freeing this joint alone lets the tip reach the target

    bool operator==(const ActiveLimit&) const = default;
};

}  // namespace tendril::ik
