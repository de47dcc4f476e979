// Decides if the limits stop the tip, by one rule for all methods. Not installed.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// True if the limits stop the tip at a pose where a method stalled. Continues a descent within the limits
/// for a few steps, bending out of singular poses, so that no limit is blamed for a method that gave up too
/// early. The limits stop the tip if it still has not arrived and they remove a good part of the rotations
/// that ball joints would make towards the target. Restores the pose, bit for bit. `converged`: maximum error
/// of a tip that has arrived, metres. O(n).
///
/// This cannot detect a distant pose within the limits that reaches the target: a descent into another
/// minimum is still reported as stopped.
bool limits_stop_tip(Problem& problem, float converged) noexcept;

/// The pose from which the joints' freedoms are taken: the current one, or the one before the last step,
/// which is as good if that step gained almost nothing.
enum class PoseUsed { Current, BeforeLastStep };

/// The last part of limits_stop_tip, for a pose at which a descent has already stalled: true if the active
/// limits remove a good part of the steepest descent.
bool is_stopped_by_limits(Problem& problem, PoseUsed pose_used = PoseUsed::Current) noexcept;

}  // namespace tendril::ik::detail
