// The solvers that follow the Jacobian J, the matrix of how far each small turn of a joint moves the tip.
// Ball joints: three columns a joint, axis x (tip - joint) for the three axes of the world. Not installed.
//
//     jacobian transpose   turns = a J' e              W. A. Wolovich, H. Elliott, "A computational technique
//                                                      for inverse kinematics", 23rd IEEE Conference on
//                                                      Decision and Control, 1984
//     damped least squares turns = J' (J J' + l^2 I)^-1 e   C. W. Wampler 1986; Y. Nakamura, H. Hanafusa 1986
//     SVD                  turns = J' U diag(1 / (s^2 + l_s^2)) U' e   A. A. Maciejewski, C. A. Klein,
//                                                      "Numerical filtering for the operation of robotic
//                                                      manipulators through kinematically singular
//                                                      configurations", Journal of Robotic Systems 5(6), 1988
//
// e is what the tip lacks to the target, s^2 and the columns of U eigenvalues and eigenvectors of J J'. All
// three only need J J', which is 3x3 however many joints there are: J is never built, and an iteration is
// O(n). Whatever they find at the tip, joint i turns by r x f, with r from the joint to the tip and f a
// vector that is the same for all joints. Turns are applied as exponentials, from root to tip.
//
// The transpose has the step that would be best if the tip moved as J says (S. R. Buss, "Introduction to
// inverse kinematics with Jacobian transpose, pseudoinverse and damped least squares methods", 2004):
// a = e . JJ'e / |JJ'e|^2. It takes hundreds of iterations near full reach.
//
// How the others are damped. l^2 = damping^2 * reach * |e|: damping * reach at most, and it fades as the tip
// comes near. So it is a Levenberg-Marquardt method whose damping is a power of the residual, and converges
// fast to the end, also where J is singular (J. Fan, Y. Yuan, "On the quadratic convergence of the
// Levenberg-Marquardt method without nonsingularity assumption", Computing 74, 2005; T. Sugihara,
// "Solvability- unconcerned inverse kinematics by the Levenberg-Marquardt method", IEEE Transactions on
// Robotics 27(5), 2011). With a constant l the last part of the way near full reach takes 10 times as long.
//
// With one l for all singular values the SVD would give the same turns as plain damping. It is there to damp
// only the directions in which the tip can hardly be moved, and leave the good ones alone: l_s^2 = l^2
// (1 - (s / reach)^2 / 0.16) for s < 0.4 reach, and nothing from there on (the law of S. Chiaverini,
// B. Siciliano, O. Egeland, "Review of the damped least-squares inverse kinematics with experiments on an
// industrial robot manipulator", IEEE Transactions on Control Systems Technology 2(2), 1994).
//
// What keeps them sane far from the target, where the tip does not move as J says: e is cut to half the reach
// (after Buss 2004), and all turns are scaled by one number so that none exceeds 1 radian.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

template <class Watch>
void jacobian_transpose_iteration(Problem& problem, Watch watch) noexcept;
/// `damping`: that of the options, as part of the reach.
template <class Watch>
void dls_iteration(Problem& problem, float damping, Watch watch) noexcept;
template <class Watch>
void svd_dls_iteration(Problem& problem, float damping, Watch watch) noexcept;

}  // namespace tendril::ik::detail
