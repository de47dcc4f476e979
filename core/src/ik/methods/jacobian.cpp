// Solvers that use the Jacobian J, the matrix of the tip's motion per small rotation of each joint. Ball
// joints: three columns per joint, axis x (tip - joint) for the three world axes.
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
// e is the vector from tip to target; s^2 and the columns of U are eigenvalues and eigenvectors of J J'. All
// three methods only need J J', which is 3x3 for any number of joints: J is never built, and an iteration is
// O(n). Joint i then turns by r x f, with r from the joint to the tip and f a vector that is the same for all
// joints. Rotations are applied as exponentials, from root to tip.
//
// The transpose takes the step that is optimal if the tip moves as J predicts (S. R. Buss, "Introduction to
// inverse kinematics with Jacobian transpose, pseudoinverse and damped least squares methods", 2004): a = e .
// JJ'e / |JJ'e|^2. It takes hundreds of iterations near full reach.
//
// Damping of the others: l^2 = damping^2 * reach * |e|. So l is at most damping * reach, and fades as the tip
// approaches. That makes it a Levenberg-Marquardt method whose damping is a power of the residual, which
// converges fast to the end, even where J is singular (J. Fan, Y. Yuan, "On the quadratic convergence of the
// Levenberg-Marquardt method without nonsingularity assumption", Computing 74, 2005; T. Sugihara,
// "Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method", IEEE Transactions on
// Robotics 27(5), 2011). With a constant l the last part of the way near full reach takes 10 times as long.
//
// With one l for all singular values the SVD would give the same rotations as plain damping. Its purpose is
// to damp only the directions in which the tip can hardly move: l_s^2 = l^2 (1 - (s / reach)^2 / 0.16) for s
// < 0.4 reach, and 0 from there on (after S. Chiaverini, B. Siciliano, O. Egeland, "Review of the damped
// least-squares inverse kinematics with experiments on an industrial robot manipulator", IEEE Transactions on
// Control Systems Technology 2(2), 1994).
//
// Far from the target the tip does not move as J predicts. So e is clamped to half the reach (after Buss
// 2004), and all rotations are scaled by one factor so that none exceeds 1 radian.
#include "ik/methods/methods.hpp"

#include <algorithm>
#include <cfloat>

#include "ik/math.hpp"
#include "ik/methods/rotations.hpp"
#include "ik/tunables.hpp"
#include "math/symmetric3.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::jacobian;

constexpr double min_damping = 1e-12;  ///< fraction of the trace of J J', to keep it invertible

/// The linear system, in units of the reach, so that no size of chain overflows.
struct Linear {
    Symmetric3 jj;     ///< J J', the sum of |r|^2 I - r r' over the joints
    glm::dvec3 error;  ///< vector from tip to target, clamped
    double damping;    ///< l^2
};

Linear linear(const Problem& problem, double unit, double l) noexcept {
    Symmetric3 m;
    const glm::dvec3 tip = wide(problem.joints.back());
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::dvec3 r = times(minus(tip, wide(problem.joints[i])), unit);
        add_ball_joint(m, r);
    }
    glm::dvec3 error = times(minus(wide(problem.target), tip), unit);
    const double size = length(error);
    if (size > max_error) error = times(error, max_error / size);
    return {m, error, std::max(l * l * std::min(size, 1.0), min_damping * trace(m))};
}

glm::dvec3 transpose(const Linear& at) noexcept {
    const glm::dvec3 moved = product(at.jj, at.error);
    const double squared = dot(moved, moved);
    return squared > 0.0 ? times(at.error, dot(at.error, moved) / squared) : glm::dvec3(0.0);
}

glm::dvec3 damped(const Linear& at) noexcept {
    return at.jj.xx + at.damping > 0.0 ? Factors3(at.jj, at.damping).solve(at.error) : glm::dvec3(0.0);
}

glm::dvec3 filtered(const Linear& at) noexcept {
    return filtered_solution(at.jj, at.error, at.damping, small_singular, 0.0);
}

/// The rotation about `vector` by its length in radians, at most max_rotation. Uses series instead of sine
/// and cosine: exact to float precision at such angles, and the same with every C library.
glm::quat exponential(const glm::dvec3& vector) noexcept {
    const double h = 0.25 * dot(vector, vector);  // square of half the angle
    const double sine = 0.5 * (1.0 - h / 6.0 * (1.0 - h / 20.0 * (1.0 - h / 42.0 * (1.0 - h / 72.0))));
    const double cosine = 1.0 - h / 2.0 * (1.0 - h / 12.0 * (1.0 - h / 30.0 * (1.0 - h / 56.0)));
    const glm::vec3 axis = narrow(times(vector, sine));
    return unit_quaternion(static_cast<float>(cosine), axis.x, axis.y, axis.z);
}

/// Sets the rotation of joint i to r x force, scaled to max_rotation.
void find_rotations(Problem& problem, const glm::dvec3& force, double unit) noexcept {
    const glm::dvec3 tip = wide(problem.joints.back());
    const auto rotation_at = [&](std::size_t i) {
        return cross(times(minus(tip, wide(problem.joints[i])), unit), force);
    };
    double largest = 0.0;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::dvec3 t = rotation_at(i);
        largest = std::max(largest, dot(t, t));
    }
    largest = std::sqrt(largest);
    const double scale = largest > max_rotation ? max_rotation / largest : 1.0;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        problem.scratch.rotations[i] = exponential(times(rotation_at(i), scale));
    }
}

template <class Watch, class Method>
void iteration(Problem& problem, Method method, float damping, Watch watch) noexcept {
    if (!(problem.scratch.reach > FLT_MIN)) return;
    const double unit = 1.0 / static_cast<double>(problem.scratch.reach);
    const glm::dvec3 force = method(linear(problem, unit, static_cast<double>(damping)));
    if (!(dot(force, force) > 0.0)) return;
    find_rotations(problem, force, unit);
    if constexpr (Watch::watching) {
        std::copy(problem.joints.begin(), problem.joints.end(), problem.scratch.old.begin());
    }
    apply_rotations(problem);
    if constexpr (Watch::watching) {
        for (std::size_t i = 1; i < problem.joints.size(); ++i) {
            watch.moved(problem.iteration, Phase::Gradient, i, i - 1, problem.scratch.old[i],
                        problem.joints[i]);
        }
        watch.next_step();
    }
}

}  // namespace

template <class Watch>
void jacobian_transpose_iteration(Problem& problem, Watch watch) noexcept {
    iteration(problem, transpose, 0.0f, watch);
}
template <class Watch>
void dls_iteration(Problem& problem, float damping, Watch watch) noexcept {
    iteration(problem, damped, damping, watch);
}
template <class Watch>
void svd_dls_iteration(Problem& problem, float damping, Watch watch) noexcept {
    iteration(problem, filtered, damping, watch);
}

template void jacobian_transpose_iteration(Problem&, Unwatched) noexcept;
template void jacobian_transpose_iteration(Problem&, Watched) noexcept;
template void dls_iteration(Problem&, float, Unwatched) noexcept;
template void dls_iteration(Problem&, float, Watched) noexcept;
template void svd_dls_iteration(Problem&, float, Unwatched) noexcept;
template void svd_dls_iteration(Problem&, float, Watched) noexcept;

}  // namespace tendril::ik::detail
