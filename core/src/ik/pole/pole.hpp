// The pole: a point that the elbow or knee of a chain faces. Not installed.
//
// A chain's bend is the sum of the joints' offsets from the line through root and tip, each weighted by the
// lengths of the adjacent bones; so it points to the side on which the chain has its area.
// PoleTurn::WholeChain turns all middle joints by one angle about that line until the bend points to the
// pole's side. Root and tip do not change, bit for bit.
//
// PoleTurn::EachJoint turns one joint after the other, from the root on, about the line through its two
// neighbours, to the point of its circle nearest to the pole. Every turn brings the joints as a whole nearer
// to the pole, so sweeps over the chain converge. There are up to 64 sweeps if nothing limits the turns, and
// one per solve otherwise (see below).
//
// No jumps. Turning only at the end would jump, for three reasons, each with its own remedy:
//
//  1. The iterations ignore the pole. Solve after solve they follow the target out of the chain's bending
//     plane, until the chain is a corkscrew: its offsets cancel out and their sum flips. So the chain is
//     first transported: rotated rigidly about the root, by the minimal rotation that brings the tip onto the
//     line to the target, and about that line to its pole. The iterations then only change the distance, and
//     a planar chain stays planar.
//  2. For a shape whose offsets cancel out, such as an S, no rule can define a side that changes smoothly:
//     with three bones or more such a rule would be a section of the Hopf bundle, which has none.
//  3. Near the pole's line, a small step of the target is a large turn about it. With the pole 0.05 R beside
//     the line, R ahead, and the target at 0.05 R, a step of 0.0001 R already requires 20 mm per metre.
//
// For 2 and 3, a solver remembers how the last solve with a pole left the chain, and limits the turn by what
// has changed since (the allowance). The chain may then lag behind its pole; it catches up even if nothing
// moves any more. After a jump of target, pole or pose, or without an earlier solve, nothing is limited.
//
// Remaining limitation: if the bones of a flat chain fold onto one line while the target moves on, there is
// no smooth continuation (for example three bones a, b, c at a distance of a + b - c), with or without a
// pole. Chains that start straight are bent to an arc and do not get there; EachJoint, which flattens a
// chain, can lead one of three bones into it.
//
// If the pole is on the line or the chain is straight, there is no side: the chain stays as transported.
//
// In a plane the pole is a side, left or right of any line, and the same code mirrors what it would turn: the
// angle about a line in the plane is 0 or half a turn, and nothing limits it.
//
// Cost: O(n) before the iterations and O(n) after.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Before the first iteration, with the bones at their lengths: computes the allowance of this solve, then
/// transports the chain as described above. Without a pole, only clears the memory.
template <class Watch>
void transport_to_pole(Problem& problem, Watch watch) noexcept;

/// Places a nearly straight chain on an arc towards its pole that spans about the target's distance; returns
/// true if it did. From only a hint of a bend, the iterations would fold the bones near the tip back onto the
/// others, and a folded chain soon lies on a line again.
template <class Watch>
bool bend_to_pole(Problem& problem, Watch watch) noexcept;

/// The direction in which a chain on a line is bent: perpendicular to the line, towards the pole if it is off
/// the line.
glm::vec3 side_of(const Problem& problem, const glm::vec3& line) noexcept;

/// In a plane (plane.hpp), in its coordinates: the direction of the chosen side of a line, and the side of
/// the line from root to tip that the chain is on; Free if it is straight or its ends meet.
glm::dvec3 planar_side(const Problem& problem, const glm::dvec3& line) noexcept;
Side planar_side(const Problem& problem) noexcept;

/// After the last iteration: turns the middle joints to the pole and remembers the pose. The tip stays.
template <class Watch>
void face_pole(Problem& problem, Watch watch) noexcept;

/// Maximum distance that a joint may move to face the pole, metres: a fixed part of the reach plus a multiple
/// of the distance that target, pole and joints have moved (relative to the root) since the last solve;
/// infinity if they jumped, or if the last solve had no pole or another PoleTurn.
double pole_allowance(const Problem& problem) noexcept;

/// Stores the pose, for methods that face the pole themselves. Without a pole, clears the memory.
void remember_pose(Problem& problem) noexcept;

}  // namespace tendril::ik::detail
