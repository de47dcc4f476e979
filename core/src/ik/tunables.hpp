// Every constant of core/ik that was chosen rather than derived: its measurements, and the effect of other
// values. Not installed.
//
// Constants that only allow for float rounding (1e-6 of the reach and the like) stay where they are used; so
// do the step counts of closed forms (Newton's iterations on an arc or an ellipse).
//
// Unless another source is named, the figures are from tests/bench/ik_heuristics.cpp; run it again after
// changing a number here. It does 2 000 solves per row: chains of 4 to 10 bones, from random poses and from
// straight and folded ones collinear with the target; arms of 3 to 5 joints within limits (all kinds, hinges,
// hinges of one axis, cones), from rest, with targets that a pose within the limits reaches, targets anywhere
// and targets straight ahead; trees of 2 to 4 limbs. "Arrive" means to 1e-3 of the reach within 500, 200 and
// 200 iterations.
#pragma once

#include <cstddef>

#include "ik/solve/convergence.hpp"

namespace tendril::ik::detail::tune {

namespace chain {

/// A chain without limits has stalled after this many iterations in which its residual neither fell nor
/// changed by more than this fraction of the reach. 5 or 20 instead of 10: bitwise the same; of 5 000 chains
/// with bones of very unequal lengths, one fewer arrives by CCD with 20.
inline constexpr int stall_window = 10;
inline constexpr float stall_moves = 1e-5f;

/// Perturbations before a stall is accepted. With none, of 20 000 hostile chains (folded, straight, bones of
/// zero length; 100 iterations), 72 instead of 1 stall with DLS, 168 instead of 15 with CCD, 278 instead of
/// 25 with the transpose, and FABRIK leaves 606 instead of 576 short.
inline constexpr int max_perturbations = 4;

/// Accelerated FABRIK is perturbed after this many successive iterations that each left more than this
/// fraction of the residual. Usually one or two iterations remove all of it, unless the chain lies folded
/// nearly on a line. Without it 4.2 instead of 3.5 iterations from a straight pose and 4.1 instead of 3.7
/// from a folded one; the same chains arrive.
inline constexpr int slow_window = 2;
inline constexpr float slow_part = 0.8f;

/// Approximate angle by which a perturbation turns the first bone one way and the last the other; radians.
/// Scattered directions instead of an arc: FABRIK 2.8 instead of 3.4 iterations from a line, DLS 5.9 instead
/// of 5.4, CCD 98.7 instead of 98.9 percent; but an arc can bend towards a pole.
inline constexpr float bend_angle = 0.2f;

/// With fewer bones the accelerated step costs more than the passes, so every other iteration skips it.
/// Measured with 3 to 7 bones from random poses: targets at 0.05 to 0.9 of the reach then take 5 to 15 % less
/// time, targets further out 10 to 30 % more, at two iterations instead of one. Without skipping, 4 bones
/// take 1.3 instead of 1.8 iterations.
inline constexpr std::size_t few_bones = 8;
/// Spans evaluated per family of shapes (regula falsi). 1 or 3: 0.04 to 0.24 more iterations, or 0.02 to 0.13
/// fewer; the same chains arrive.
inline constexpr int tries = 2;
/// Values of t^2: at the first, the bones of a bent chain point sideways; at the second, even the faintest
/// bend has become that strong.
inline constexpr float strong_bend = 1e6f, max_bend = 1e10f;

}  // namespace chain

namespace jacobian {

/// Fraction of the reach to which the error is clamped (after Buss 2004), because J predicts the tip's move
/// only nearby. Unclamped, DLS takes 7.7 instead of 6.4 iterations with 10 bones, 5.0 instead of 4.8 with 4.
inline constexpr double max_error = 0.5;
/// Maximum rotation, radians per iteration, for the same reason. Unlimited: 6.0 instead of 5.4 iterations
/// from a straight pose, otherwise the same.
inline constexpr double max_rotation = 1.0;
/// Fraction of the reach: singular values below this are damped by the SVD method (jacobian.cpp).
inline constexpr double small_singular = 0.4;

}  // namespace jacobian

namespace limits {

/// A pose is singular if no joint's rotation J' e exceeds this fraction of |e|, in reaches per radian. A
/// method that stalls on its way to a line ends about this close to it. A fifth or five times as much: the
/// same arms arrive by FABRIK; by DLS 0.5 percentage points fewer, or 2.7 more, of those with hinges of one
/// axis.
inline constexpr float singular = 5e-3f;
/// Bending a singular pose: minimum fraction of the angle, for a joint before a short bone; and the
/// difference, as a fraction of the reach, below which the errors of two ways of bending are a tie. A chain
/// is bent once per solve, the best of four ways. Without bending, no arm that starts straight with the
/// target ahead arrives by DLS (49 percent of all kinds do with it; the others are out of the limits' reach),
/// and 4 instead of 49 by CCD; FABRIK's restarts compensate, but there are none while a target is dragged.
/// With the first way only, DLS brings 39 instead of 47 percent of those arms there. Up to three more bends,
/// each joint its own way, changed 2 of 60 000 results and took up to twice the iterations for hinges of one
/// axis.
inline constexpr float min_part = 0.1f, tie_error = 1e-4f;

/// Methods without restarts. 10 or 40 instead of 20: of targets anywhere, DLS reaches up to 0.7 percentage
/// points fewer, or up to 0.3 more, in a third less time or up to twice the iterations.
inline constexpr StallRule stall{.window = 20, .relative = 1e-3f};
/// Least squares. A window of 1 takes a third of the time for targets out of the limits' reach, but the tip
/// ends at 0.181 instead of 0.164 of the reach from them; 4 takes half as many iterations again for 0.163.
/// Relative 1e-3: a tenth more iterations, 1e-2: a tenth fewer; the same arms arrive to 0.1 percent.
inline constexpr StallRule step_stall{.window = 2, .relative = 3e-3f};
/// Fraction of the reach: a step that promises a smaller gain is not taken, since rounding would swallow it.
inline constexpr float min_gain = 2e-7f;
/// FABRIK's passes continue while a pair leaves less than this fraction of the error. With only one pair the
/// same arms arrive, a quarter of an iteration to one iteration sooner.
inline constexpr float max_reach_ratio = 0.5f;
/// Damping of least squares, in reach squared (Levenberg 1944, Marquardt 1963), and its factors per step.
inline constexpr float first_damping = 1e-3f, min_damping = 1e-6f, max_damping = 100.0f;
inline constexpr float damping_falls = 0.3f, damping_grows = 5.0f;
/// Restarts from other poses; see the table at Options::restarts.
inline constexpr int default_restarts = 8;
/// A target that moved less than this fraction of the reach since the last solve is dragged. Then no joint
/// moves by more than `follow` times the target's step.
inline constexpr float dragged = 0.05f, follow = 20.0f;

/// Radians, and a fraction of the reach: tolerances for a tip orientation and for a straightened chain.
inline constexpr float orientation_tolerance = 1e-3f, straight_tolerance = 1e-4f;
/// Metres per radian, as a fraction of the reach: the weight of a tip orientation against the tip's position.
inline constexpr float orientation_arm = 0.25f;

/// Limits are to blame if they remove at least this fraction of the descent.
inline constexpr float min_limit_share = 0.01f;
/// Descent steps before a limit is blamed. Without them, of 730 straight arms whose target ahead is
/// reachable, 338 more that FABRIK (2011) leaves on the line would blame a limit; of the others' 40 000
/// verdicts they change 60.
inline constexpr int limit_test_steps = 40;

}  // namespace limits

/// Solver::explain. It takes at most 1 + 2 max_candidates + halvings further solves: the 17 of solver.hpp.
namespace explain {

inline constexpr int iterations = 60;
inline constexpr std::size_t max_candidates = 4;  ///< joints to free
inline constexpr int halvings = 8;                ///< bisections of the best joint's range: to 0.4 % of it
inline constexpr float fine = 1e-4f;              ///< fraction of the reach: a smaller error counts as
                                                  ///< arrived
inline constexpr float min_gain_part = 1e-3f;     ///< of the remaining distance: a smaller gain is ignored

}  // namespace explain

/// tests/core/ik_pole_test.cpp checks the guarantee of these: targets that move by 0.1 mm never move a joint
/// of a 1 m chain by more than 5 mm.
namespace pole {

/// Maximum move of a joint to face its pole: `free_part` of the reach in each solve, plus `follow` times the
/// distance that target, pole and joints have moved since the last one.
inline constexpr double free_part = 5e-4, follow = 20.0;
/// A change larger than this fraction of the reach is a jump, after which nothing is limited.
inline constexpr double jump = 0.02;
/// PoleTurn::EachJoint: maximum sweeps, and the angle in radians below which they have converged.
inline constexpr int max_sweeps = 64;
inline constexpr double at_rest = 1e-3;
/// Fraction of the reach: a chain with no joint further off the line than this is placed on an arc.
inline constexpr double straight = 0.01;
/// Fraction of the reach: a tip this near the root is at it, so a chain in a plane has no side and no line.
inline constexpr double closed_tip = 0.01;

}  // namespace pole

namespace tree {

/// The first iteration with a Newton step: reaching alone finds the rough shape and moves the joints least.
/// Starting at the first iteration takes 1.9 instead of 3.2 iterations, at the fifth 4.2.
inline constexpr int newton_from = 3;
inline constexpr double first_damping = 1e-3, min_damping = 1e-9, max_damping = 1e3;
inline constexpr double damping_falls = 0.25, damping_grows = 8.0;
/// Iterations without convergence before a stall. 2 or 8: the same trees arrive; if their effectors conflict,
/// 0.6 iterations sooner or 0.9 later.
inline constexpr int stall_window = 4;
/// Perturbations before a stall is accepted, and their size as a fraction of a bone's length. With none, 93.8
/// instead of 99.1 percent of trees with straight limbs and targets ahead arrive.
inline constexpr int max_perturbations = 1;
inline constexpr float bend = 0.3f;
/// Minimum weight of an effector, as a fraction of the heaviest.
inline constexpr double min_weight = 1e-4;

}  // namespace tree

/// solve_many, which also uses the constants of `chain`. Figures from tests/bench/ik_many.cpp. Within limits
/// they are for 18 000 chains of 3, 10 and 30 bones (cones, hinges, both), from rest: with the values below,
/// 70 are left to the scalar solver and the others take 4.56 steps.
namespace batch {

/// The first iterations of a block. Nearly all chains need no more: one if each has the accelerated step, two
/// if every other has. 4 instead of 2: a tenth more time for chains of 3 bones.
inline constexpr int first_burst = 1, first_burst_few_bones = 2;
/// Iterations of the remaining chains between two checks for finished ones. 1 to 4: the same to 3 %.
inline constexpr int next_burst = 2;
/// Active chains leave a block that has fewer of them than this fraction.
inline constexpr double block_part = 0.5;

/// Active chains within limits leave a register that has fewer of them than this fraction. 3/8 takes a
/// twentieth more time, 1/2 a tenth.
inline constexpr double register_part = 0.25;
/// Steps between two checks. 1 or 3: the same to 3 %.
inline constexpr int steps = 2;
/// Steps until the scalar solver takes over. With 15 it takes 118 chains, with 60 it takes 65.
inline constexpr int max_steps = 30;
/// Damping of least squares, in reach squared. With a first damping of 2e-3 or 2e-1: 4.9 or 5.2 steps. With a
/// fall of 0.1 or a growth of 2.5: 4.66 or 4.62 steps.
inline constexpr float first_damping = 2e-2f, min_damping = 1e-8f, max_damping = 1.0f;
inline constexpr float damping_falls = 0.3f, damping_grows = 5.0f;
/// Maximum move of the tip in a step, as a fraction of the reach: the first and the maximum distance, and its
/// factors after a good or bad step. Always 1: 86 chains are left and 4.69 steps; from 0.3 on: 113 and 5.2.
inline constexpr float first_move = 1.0f, max_move = 1.0f, move_grows = 2.0f, move_falls = 0.4f;
/// Active-set passes per step. 1: 150 chains are left; 3: 70.
inline constexpr int passes = 2;
/// A chain is left to the scalar solver after `max_slow_steps` successive steps that each removed less than
/// `min_decrease` of the error. 5: 102; 20: 53, but a chain that cannot arrive then uses up all steps.
inline constexpr float min_decrease = 0.1f;
inline constexpr int max_slow_steps = 8;

}  // namespace batch

}  // namespace tendril::ik::detail::tune
