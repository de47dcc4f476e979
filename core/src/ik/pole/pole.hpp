// The pole: the bend of a chain faces a point. Not installed.
//
// Where a chain bends to: the sum of the joints' offsets from the line through root and tip, each weighted by
// the lengths of the bones beside it; so the side on which the chain has its area. PoleTurn::WholeChain turns
// all middle joints by one angle about that line until this sum points to the pole's side. Root and tip stay
// to the bit.
//
// PoleTurn::EachJoint turns one joint after the other, from the root on, about the line through its two
// neighbours, to the point of its circle that is nearest to the pole. Every turn brings the joints nearer to
// the pole, taken together; so sweeps over the chain come to rest. There are as many as it takes, 64 at most,
// where nothing limits the turns, and one a solve where something does (below).
//
// No jumps. A turn at the end alone does jump, for three reasons, and there is an answer to each:
//
//  1. Iterations know of no pole. They follow the target out of the plane in which the chain bends, solve for
//     solve, until the chain is a corkscrew; its offsets cancel out and their sum turns at once. So the chain
//     is first transported: rotated as one stiff piece about the root, by the minimal rotation that brings
//     the tip onto the line to the target, and about that line to its pole. The iterations then only change
//     the distance, and what lies in a plane stays in it.
//  2. From a shape whose offsets cancel out, as an S has it, no rule can find a side that changes smoothly:
//     with three bones or more such a rule would be a section of Hopf's bundle, and that has none.
//  3. Near the pole's line a small step of the target is a large turn about it. With the pole 0.05 R beside
//     the line, R ahead, and the target at 0.05 R, a step of 0.0001 R already asks for 20 mm per metre.
//
// For 2 and 3 a solver remembers how the last solve with a pole left the chain, and limits the turn by what
// has changed since (allowance). The chain may then face its pole a little late; it catches up, also when
// nothing moves any more. After a jump of target, pole or pose, or without a solve before, nothing is
// limited.
//
// What remains: a flat chain whose bones come to lie folded upon one line while the target moves on has no
// smooth way to go (three bones a, b, c at a distance of a + b - c, say), with or without a pole. Chains that
// start straight are bent to an arc and do not get there; EachJoint, which flattens a chain, can lead one of
// three bones into it.
//
// A pole on the line, or a chain that is straight, shows no side: the chain is left as it is transported.
//
// Cost: O(n) before the iterations and O(n) after.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// Before the first iteration, once the bones have their lengths: limits the turns of this solve, then
/// transports the chain as said above. Without a pole it only forgets what was remembered.
template <class Watch>
void transport_to_pole(Problem& problem, Watch watch) noexcept;

/// A chain that is all but straight, placed on an arc towards its pole that spans about as far as the target
/// is; true if it was. From a mere hint of a bend the iterations would fold the bones near the tip back upon
/// the others, and a folded chain is on a line again before long.
template <class Watch>
bool bend_to_pole(Problem& problem, Watch watch) noexcept;

/// To which side of the line that it lies on a chain is bent: at right angles to it, towards the pole if it
/// shows a side.
glm::vec3 side_of(const Problem& problem, const glm::vec3& line) noexcept;

/// After the last iteration: turns the middle joints to the pole and remembers the pose. The tip stays.
template <class Watch>
void face_pole(Problem& problem, Watch watch) noexcept;

/// How far a joint may be moved, metres, to face the pole: this part of the reach in any case, and so many
/// times what target, pole and joints have moved (all from the root) since the last solve; infinitely far
/// where one of them jumped, or where the last solve had no pole or another PoleTurn.
double pole_allowance(const Problem& problem) noexcept;

/// For methods that face the pole by themselves. Without a pole it forgets.
void remember_pose(Problem& problem) noexcept;

}  // namespace tendril::ik::detail
