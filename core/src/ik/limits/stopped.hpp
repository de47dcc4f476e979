// Whether it is the limits that stop the tip. One rule for all methods. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// For a pose at which a method stalled. A descent within the limits goes on from there for a few steps, bent
/// out of singular poses, so that no limit is blamed for a method that gave up too early; where it ends, the
/// limits stop the tip if it has not arrived, and they take away a good part of the turns that ball joints
/// would make towards the target: without them the error would fall. The pose is left as it was, to the bit.
/// `there`: the error with which it counts as arrived, metres. O(n).
///
/// What this cannot see is a pose elsewhere within the limits from which the target is reached: a method that
/// descends into another is stopped there all the same.
bool limits_stop_tip(Problem& problem, float there) noexcept;

/// From which pose the joints' freedoms are taken: this one, or the one that the last step began from, which
/// is as good where that step gained next to nothing.
enum class Seen { Here, BeforeLastStep };

/// The last part of that, for a pose from which a descent has stalled already: whether the active limits take
/// away a good part of how fast the error falls as all joints turn, each in the way that is best for it.
bool is_stopped_by_limits(Problem& problem, Seen seen = Seen::Here) noexcept;

}  // namespace tendril::ik::detail
