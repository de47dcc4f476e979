// Input of a solve. Its output is in report.hpp.
//
// Every number is checked before anything moves. A number that is not finite, is over max_magnitude or out of
// range, or a list of the wrong size, gives Status::InvalidInput and leaves the joints bit for bit as they
// were. Nothing here throws.
#pragma once

#include <optional>
#include <span>

#include "tendril/ik/limit.hpp"
#include "tendril/ik/plane.hpp"
#include "tendril/ik/pole_turn.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/quat.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// The rows of fields<Options>() say which methods honour an option: see honours() in method.hpp.
struct Options {
    /// Metres, 0 to max_magnitude; by default 1e-3 of the reach.
    std::optional<float> tolerance{};
    /// 1 to 1 000 000.
    int max_iterations = 100;
    /// Runs all max_iterations even after converging; for measuring and for comparing solvers. (A target out
    /// of reach or too close still takes no iterations.)
    bool every_iteration = false;
    /// One per bone, at the joint where the bone starts; or empty.
    std::span<const Limit> limits{};
    /// Keeps the chain in a plane, see plane.hpp. A plane has limits of its own: with `limits` as well the
    /// input is invalid. `pole` chooses the side, a tip orientation gives the direction of the last bone;
    /// pole_turn and twist have no effect, and the rest pose is straight along the base direction.
    std::optional<Plane> plane{};
    /// Pole target, metres: the point that the elbow or knee faces.
    std::optional<glm::vec3> pole{};
    PoleTurn pole_turn = PoleTurn::WholeChain;
    /// 0 to 1: before iterating, blends each bone this far towards its rest direction.
    float snap_back = 0.0f;
    /// Unit quaternion: the final rotation of the last bone from its rest direction.
    std::optional<glm::quat> tip_orientation{};
    /// Fraction of the reach, 0 to 1: within this zone before full reach the chain eases off instead of
    /// snapping straight. With z its width in metres, a its start and x = (distance - a) / z for a target
    /// beyond a, the tip extends to a + z x / sqrt(1 + x^2): smooth at the start of the zone, and never quite
    /// full reach. The report refers to the target itself: if the tip stays short of it by more than the
    /// tolerance, the status is Stretched and the residual is the remaining distance.
    float soft_zone = 0.0f;
    /// Damping of the two damped solvers as a fraction of the reach, over 0 to 10. Within limits the minimum
    /// is 3e-5.
    float damping = 0.1f;
    /// Two-bone only: the fraction of the reach from which the bones lengthen, over 0 to 1, and their maximum
    /// scale, 1 to 100. With a maximum of 1 they never lengthen.
    float start_stretch_ratio = 1.0f;
    float max_stretch_scale = 1.0f;
    /// Two-bone only: rotates the bend about the line from root to tip, radians.
    float twist = 0.0f;
    /// 0 to 1: blends from the given pose (after enforcing lengths or limits) to the solved one. Bones are
    /// blended by their rotations and placed again from the root, so they keep their lengths. Without limits
    /// each bone takes the shortest rotation in the world. Within limits the joint angles are blended in the
    /// axes of each limit (the swing as a vector, and the twist; a free joint takes the shortest rotation
    /// relative to its parent bone), so every intermediate pose is within the limits. The length of a
    /// stretched bone is blended too. Report and residuals refer to the solve itself, as with a weight of 1.
    /// With a weight under 1 the rotations are always kept up to date.
    float weight = 1.0f;
    /// Within limits, if descent ends short of the target: how many other poses to restart from, 0 to 1000,
    /// as far as max_iterations allows. By default 8, but none while the target is dragged, that is, if the
    /// chain is as the last solve with this state left it and the target has moved by less than 0.05 of the
    /// reach since. A restart may converge to a distant pose, and the chain would jump. While dragging, no
    /// joint moves by more than 20 times (the target's step + the tolerance) per solve. An explicit number
    /// applies to every solve, and the chain may jump.
    ///
    /// Measured on 9 000 arms of 3 to 5 joints from rest (all kinds, hinges, hinges of one axis, human arms,
    /// cones), with targets at the tip of a random pose within the limits; and the cost for targets anywhere,
    /// half of which the limits make unreachable:
    ///     restarts            0      1      2      4      8      16     40
    ///     arrive, percent     93.3   98.4   99.2   99.9   99.99  100    100
    ///     residual, R         0.243  0.191  0.183  0.178  0.176  0.175  0.175
    ///     µs per solve        22     28     35     64     95     169    243
    std::optional<int> restarts{};
    /// Keeps the state's rotations up to date in every solve. Limits, a tip orientation and a weight under 1
    /// always do. Otherwise it costs about 15 ns per bone, which is a fifth to a third of a FABRIK solve that
    /// follows a target. Outdated rotations catch up in the next solve that updates them, by one minimal
    /// rotation, so their twist may differ.
    bool rotations = false;
    /// If given, element i receives the residual after iteration i + 1, up to its size. Metres. The report
    /// has the residual of the best pose, so it may be less than the last of these.
    std::span<float> residuals{};
};

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Options>() noexcept;
