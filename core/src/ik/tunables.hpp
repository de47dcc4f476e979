// Every number of core/ik that was chosen rather than derived, with what it was chosen on and what is lost
// without it. Not installed.
//
// What only allows for the rounding of floats (1e-6 of the reach and the like) is none of these and stays
// where it is used; so do the steps of a closed form (Newton's iterations on an arc or an ellipse).
//
// Where no other source is named, the figures are from tests/bench/ik_heuristics.cpp, which prints them anew
// after a number here was changed: 2 000 solves a row; chains of 4 to 10 bones, from random poses and from
// straight and folded ones on a line with the target; arms of 3 to 5 joints within limits (all kinds, hinges,
// hinges of one axis, cones), from rest, with targets that a pose within the limits reaches, targets anywhere
// and targets straight ahead; trees of 2 to 4 limbs. "Arrive" is to 1e-3 of the reach within 500, 200 and 200
// iterations.
#pragma once

#include <cstddef>

#include "ik/solve/convergence.hpp"

namespace tendril::ik::detail::tune {

namespace chain {

/// A chain without limits stalls after so many iterations in which its residual neither fell nor changed by
/// so much of the reach. 5 or 20 instead of 10: not a bit changes; of 5 000 chains with bones of very unequal
/// lengths, 1 arrives less by CCD with 20.
inline constexpr int stall_window = 10;
inline constexpr float stall_moves = 1e-5f;

/// Perturbations before a stall is believed. With none, of 20 000 hostile chains (folded, straight, bones of
/// no length; 100 iterations), 72 instead of 1 stall with DLS, 168 instead of 15 with CCD, 278 instead of 25
/// with the transpose, and FABRIK leaves 606 instead of 576 short.
inline constexpr int max_perturbations = 4;

/// Accelerated FABRIK is perturbed after so many iterations that each left more than this part, for it takes
/// all of the residual away in one or two unless it lies folded nearly on a line. Without it 4.2 instead of
/// 3.5 iterations from a straight pose and 4.1 instead of 3.7 from a folded one; the same chains arrive.
inline constexpr int slow_window = 2;
inline constexpr float slow_part = 0.8f;

/// By how much a perturbation turns the first bone one way and the last the other, about; radians. Scattered
/// instead of an arc: FABRIK 2.8 instead of 3.4 iterations from a line, DLS 5.9 instead of 5.4, CCD 98.7
/// instead of 98.9 percent; but an arc can go towards a pole.
inline constexpr float bend_angle = 0.2f;

/// Under so many bones the accelerated step costs more than the passes, so every other iteration does
/// without. Measured with 3 to 7 bones from random poses: targets at 0.05 to 0.9 of the reach take 5 to 15 %
/// less time so, those further out 10 to 30 % more, at two iterations instead of one. Without it 4 bones take
/// 1.3 instead of 1.8 iterations.
inline constexpr std::size_t few_bones = 8;
/// Spans worked out for one family of shapes (regula falsi). 1 or 3: 0.04 to 0.24 more iterations, or 0.02 to
/// 0.13 fewer, and no chain more or less arrives.
inline constexpr int tries = 2;
/// Of t^2: where the bones of a chain that was bent point sideways; and where the last trace of a bend has
/// become one.
inline constexpr float strong_bend = 1e6f, max_bend = 1e10f;

}  // namespace chain

namespace jacobian {

/// Of the reach: the error is cut to this (after Buss 2004), for further out the tip does not move as J says.
/// Without: DLS takes 7.7 instead of 6.4 iterations with 10 bones, 5.0 instead of 4.8 with 4.
inline constexpr double max_error = 0.5;
/// Radians, for the same reason. Without: 6.0 instead of 5.4 from a straight pose, otherwise the same.
inline constexpr double max_rotation = 1.0;
/// Of the reach: from this singular value down the SVD is damped (jacobian.cpp).
inline constexpr double small_singular = 0.4;

}  // namespace jacobian

namespace limits {

/// Of |e|, in reaches a radian: what counts as a singular pose. A method that stalls on its way to a line
/// comes no nearer to it than about this. A fifth or five times of it: the same arms arrive by FABRIK; by
/// DLS 0.5 percentage points fewer, or 2.7 more, of those with hinges of one axis.
inline constexpr float singular = 5e-3f;
/// Of the angle by which a singular pose is bent, for a joint before a short bone; errors of two ways of
/// bending that count as alike, of the reach. It is bent once in a solve, the best of four ways. Without that
/// no arm that starts straight with the target ahead arrives by DLS (49 percent of all kinds do with it, the
/// rest being out of the limits' reach), and 4 instead of 49 by CCD; FABRIK's restarts make up for it, but
/// there are none while a target is dragged. With the first way alone DLS brings 39 instead of 47 percent of
/// those arms there. Up to three more bends, each joint its own way, changed 2 of 60 000 ends and took up to
/// twice the iterations where hinges have one axis.
inline constexpr float min_part = 0.1f, alike = 1e-4f;

/// The methods that have no second try. 10 or 40 instead of 20: of targets anywhere DLS brings up to 0.7
/// percentage points fewer there, or up to 0.3 more, in a third less time or up to twice the iterations.
inline constexpr StallRule stall{.window = 20, .relative = 1e-3f};
/// Least squares. A window of 1: a third of the time for targets out of the limits' reach, but the tip stays
/// 0.181 instead of 0.164 of the reach off; of 4: half as many iterations again for 0.163. Relative 1e-3: a
/// tenth more iterations, 1e-2: a tenth fewer; the same arms arrive to 0.1 percent.
inline constexpr StallRule step_stall{.window = 2, .relative = 3e-3f};
/// Of the reach: a step that promises less is lost in the rounding of the error, and not taken.
inline constexpr float min_gain = 2e-7f;
/// FABRIK's passes go on as long as a pair leaves less than this part. With one pair alone the same arms
/// arrive, a quarter of an iteration to one iteration sooner.
inline constexpr float reaching_pays = 0.5f;
/// Of least squares, in reach squared (Levenberg 1944, Marquardt 1963); by how much it falls and grows.
inline constexpr float first_damping = 1e-3f, min_damping = 1e-6f, max_damping = 100.0f;
inline constexpr float damping_falls = 0.3f, damping_grows = 5.0f;
/// Other poses to start from; Options::restarts has the table that it was chosen by.
inline constexpr int default_restarts = 8;
/// Of the reach: a target that moved less since the last solve is dragged. No joint then moves by more than
/// so many times the target's step.
inline constexpr float dragged = 0.05f, follow = 20.0f;

/// Radians, and of the reach: a tip orientation, and a straightened chain, that counts as there.
inline constexpr float orientation_tolerance = 1e-3f, straight_tolerance = 1e-4f;
/// Metres a radian, of the reach: how much a tip orientation counts beside the tip's place.
inline constexpr float orientation_arm = 0.25f;

/// Limits are to blame where they take away this part of the descent.
inline constexpr float blamed_part = 0.01f;
/// Steps before that is asked. Of 730 straight arms whose target ahead they can reach, 338 more that plain
/// FABRIK leaves on the line would blame a limit without them; of the others' 40 000 verdicts they change 60.
inline constexpr int blame_steps = 40;

}  // namespace limits

/// Solver::explain. It takes at most 1 + 2 max_candidates + halvings further solves, the 17 of solver.hpp.
namespace explain {

inline constexpr int iterations = 60;
inline constexpr std::size_t max_candidates = 4;  ///< joints that are freed
inline constexpr int halvings = 8;          ///< of the range that the best of them needs: to 0.4 % of it
inline constexpr float fine = 1e-4f;        ///< of the reach: what counts as there
inline constexpr float noticeable = 1e-3f;  ///< of the distance that was left: what counts as nearer

}  // namespace explain

/// tests/core/ik_pole_test.cpp and ik_pole_sweep_test.cpp hold what these are for: targets that move by 0.1
/// mm never move a joint of a 1 m chain by more than 5 mm.
namespace pole {

/// What a joint may move to face its pole: this part of the reach in each solve, and so many times what
/// target, pole and joints have moved since the last one.
inline constexpr double free_part = 5e-4, follow = 20.0;
/// Of the reach: what changed by more has jumped, and nothing is limited then.
inline constexpr double jump = 0.02;
/// Of PoleTurn::EachJoint: sweeps at most, and radians under which they have come to rest.
inline constexpr int max_sweeps = 64;
inline constexpr double at_rest = 1e-3;
/// Of the reach: a chain with no joint further off the line than this is placed on an arc.
inline constexpr double straight = 0.01;

}  // namespace pole

namespace tree {

/// The first iteration with a Newton step: reaching alone gets the gross shape right and moves the joints
/// least. From the first iteration on: 1.9 instead of 3.2 iterations; from the fifth: 4.2.
inline constexpr int newton_from = 3;
inline constexpr double first_damping = 1e-3, min_damping = 1e-9, max_damping = 1e3;
inline constexpr double damping_falls = 0.25, damping_grows = 8.0;
/// Iterations without convergence that make a stall. 2 or 8: the same trees arrive, where their effectors are
/// in conflict 0.6 iterations sooner or 0.9 later.
inline constexpr int stall_window = 4;
/// Perturbations before a stall is believed, by so much of a bone's length. With none, 93.8 instead of
/// 99.1 percent of trees with straight limbs and their targets ahead arrive.
inline constexpr int max_perturbations = 1;
inline constexpr float bend = 0.3f;
/// Of the heaviest: a lighter effector counts as this heavy.
inline constexpr double min_weight = 1e-4;

}  // namespace tree

/// solve_many, which besides takes the numbers of `chain`; figures of tests/bench/ik_many.cpp. Within limits
/// they are of 18 000 chains of 3, 10 and 30 bones (cones, hinges, both), from rest: as it is, 70 are left to
/// the scalar solver and the others take 4.56 steps.
namespace batch {

/// The first iterations of a block; nearly all chains need no more where the accelerated step has its turn in
/// each, and two where it has not. 4 instead of 2: a tenth more time for chains of 3 bones.
inline constexpr int first_burst = 1, first_burst_few_bones = 2;
/// Iterations of those that are left, between two looks at who is done. 1 to 4: the same to 3 %.
inline constexpr int next_burst = 2;
/// Below this part of a block the active chains leave it.
inline constexpr double block_part = 0.5;

/// Below this part of a register the chains within limits leave it. 3/8: a twentieth more time; 1/2: a tenth.
inline constexpr double register_part = 0.25;
/// Steps between two looks. 1 or 3: the same to 3 %.
inline constexpr int steps = 2;
/// Steps until the scalar solver takes over. 15: it takes 118; 60: 65.
inline constexpr int max_steps = 30;
/// Of least squares, in reach squared. First 2e-3 or 2e-1: 4.9 or 5.2 steps. Falls by 0.1, grows by 2.5: 4.66
/// or 4.62 steps.
inline constexpr float first_damping = 2e-2f, min_damping = 1e-8f, max_damping = 1.0f;
inline constexpr float damping_falls = 0.3f, damping_grows = 5.0f;
/// How far a step is to bring the tip nearer: of the reach at first, then longer and shorter. Always 1: 86
/// are left and 4.69 steps; from 0.3 on: 113 and 5.2.
inline constexpr float first_move = 1.0f, max_move = 1.0f, move_grows = 2.0f, move_falls = 0.4f;
/// Passes in which a step finds what limits stop. 1: 150 are left; 3: 70.
inline constexpr int passes = 2;
/// A chain is left after so many steps that each took away less than this part. 5: 102; 20: 53, but a chain
/// that cannot arrive then takes all of its steps.
inline constexpr float little = 0.1f;
inline constexpr int patience = 8;

}  // namespace batch

}  // namespace tendril::ik::detail::tune
