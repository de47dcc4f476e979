// What goes into a solve. What comes out is in report.hpp.
//
// Every number is checked before anything moves. A number that is not finite, is over max_magnitude or out of
// its range, or a list of the wrong size, gives Status::InvalidInput and leaves the joints bit for bit as
// they were; nothing here throws.
#pragma once

#include <optional>
#include <span>

#include "tendril/ik/limit.hpp"
#include "tendril/ik/pole_turn.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// Which method honours which option: the table in method.hpp.
struct Options {
    /// Metres, 0 to max_magnitude; 1e-3 of the reach where left out.
    std::optional<float> tolerance{};
    /// 1 to 1 000 000.
    int max_iterations = 100;
    /// Goes on to max_iterations whatever was reached; for measuring, and for comparing solvers. (A target
    /// out of reach or too close needs no iterations, then either.)
    bool every_iteration = false;
    /// One for each bone, at the joint that it starts from; or none at all.
    std::span<const Limit> limits{};
    /// Pole target: the elbow or knee points at this, metres.
    std::optional<glm::vec3> pole{};
    PoleTurn pole_turn = PoleTurn::WholeChain;
    /// 0 to 1: before iterating, each joint is blended this far towards its rest direction from the one
    /// before.
    float snap_back = 0.0f;
    /// Unit quaternion: the rotation that the last bone has from its rest direction when all is done.
    std::optional<glm::quat> tip_orientation{};
    /// Part of the reach, 0 to 1: in this zone before full reach the chain eases off instead of snapping
    /// straight. With z its width in metres, a its start and x = (distance - a) / z of a target beyond a, the
    /// tip goes out to a + z x / sqrt(1 + x^2): smooth where the zone begins, and never quite full reach. The
    /// report is about the target itself: where the tip stays short of it by more than the tolerance, the
    /// status is Stretched and the residual what is missing.
    float soft_zone = 0.0f;
    /// Damping of the two damped solvers as part of the reach, over 0 to 10. Within limits less than 3e-5
    /// counts as that.
    float damping = 0.1f;
    /// Two-bone only: the part of the reach from which on the bones lengthen, over 0 to 1, and up to how many
    /// times their length, 1 to 100. With 1 they never do.
    float start_stretch_ratio = 1.0f;
    float max_stretch_scale = 1.0f;
    /// Two-bone only: the bend is turned by this about the line from root to tip, radians.
    float twist = 0.0f;
    /// 0 to 1: how far the chain goes from the pose that it was given (brought to its lengths, brought within
    /// its limits) to the one that was solved for. Bones are blended by their rotations and placed anew from
    /// the root, so that they keep their lengths. Without limits each bone turns in the world on the shortest
    /// way. Within limits each joint's angles are blended, as its limit counts them (the swing as a vector,
    /// and the twist; a free joint on the shortest way against the bone before it), so that every pose
    /// between is within its limits. The length of a stretched bone is blended too. Report and residuals are
    /// those of the solve itself, as with a weight of 1. Under 1 the rotations are always kept up.
    float weight = 1.0f;
    /// Within limits, where descent ends short of the target: from how many other poses to restart, 0 to
    /// 1000, as far as max_iterations allows. Left out: 8; but none while the target is dragged, that is
    /// where the chain stands as the last solve with this state left it and the target has moved by less than
    /// 0.05 of the reach since. Another start may end elsewhere, and the chain would jump: instead no joint
    /// then moves by more than 20 times (the target's step + the tolerance) in a solve. A number that is
    /// given holds in every solve, and chains may jump.
    ///
    /// Arms of 3 to 5 joints from rest (9 000; all kinds, hinges, hinges of one axis, human arms, cones), to
    /// where the tip of a random pose within the limits is; and what a target that is anywhere costs, of
    /// which the limits forbid half:
    ///     restarts            0      1      2      4      8      16     40
    ///     arrive, percent     93.3   98.4   99.2   99.9   99.99  100    100
    ///     residual, R         0.243  0.191  0.183  0.178  0.176  0.175  0.175
    ///     us a solve          22     28     35     64     95     169    243
    std::optional<int> restarts{};
    /// Whether the state's rotations follow the joints in every solve. Limits, a tip orientation and a weight
    /// under 1 need them, so they follow there in any case; elsewhere it costs some 15 ns a bone, which for
    /// FABRIK following a target is a fifth to a third of the solve. A rotation that was left behind catches
    /// up in the next solve that keeps them: by one minimal rotation, so its twist may differ.
    bool rotations = false;
    /// Where given, element i receives the residual after iteration i + 1, as far as it is long. Metres.
    /// The report's own is that of the nearest pose, so it may be less than the last of these.
    std::span<float> residuals{};
};

}  // namespace tendril::ik
