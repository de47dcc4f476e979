// Widened limits, and the bounds that some angles exceed: used to explain a limit. Not installed.
#pragma once

#include "ik/limits/joint.hpp"
#include "tendril/ik/active_limit.hpp"

namespace tendril::ik::detail {

/// Opens the side on which the joint is at its limit. Opening both sides would let it turn the other way
/// round to the same pose.
Limit opened(Limit limit, const JointAngles& angles) noexcept;
/// The other side, for a joint without any range.
Limit mirrored(Limit limit) noexcept;
/// True if its hinge angle, or its twist, has no range.
bool has_no_range(const Limit& limit) noexcept;

/// Widens the limit towards these angles: fully for `part` = 1, not at all for 0.
Limit widened(Limit limit, const JointAngles& angles, float part) noexcept;

/// Finds the bound that the angles exceed most. Fills in bound, limit and needed.
ActiveLimit exceeded_bound(const LimitedJoint& joint, const JointAngles& angles) noexcept;

}  // namespace tendril::ik::detail
