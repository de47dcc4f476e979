// A limit with more range than it has, and which of its bounds angles exceed: what an explanation tries and
// tells. Not installed.
#pragma once

#include "ik/limits/joint.hpp"
#include "tendril/ik/active_limit.hpp"

namespace tendril::ik::detail {

/// All the freedom that a joint can have on the side on which it stands at its limit. Both sides at once
/// would let it turn the other way round to the same place.
Limit opened(Limit limit, const JointAngles& angles) noexcept;
/// For a joint without any freedom, the other side.
Limit mirrored(Limit limit) noexcept;
/// Whether it has none: no range of its hinge's angle, or of its twist.
bool has_no_range(const Limit& limit) noexcept;

/// Range for these angles: all of it for `part` = 1, none beyond the limit's own for 0.
Limit widened(Limit limit, const JointAngles& angles, float part) noexcept;

/// Which bound the angles exceed (of a cone's the one that they exceed most), and by how much: bound, limit
/// and needed.
ActiveLimit exceeded_bound(const LimitedJoint& joint, const JointAngles& angles) noexcept;

}  // namespace tendril::ik::detail
