#include "ik/limits/step.hpp"

#include "ik/math.hpp"
#include "math/symmetric3.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tendril::math;

Matrix3 damped(Matrix3 matrix, float damping) noexcept {
    for (std::size_t k = 0; k < 3; ++k) matrix.at[k][k] += static_cast<double>(damping);
    return matrix;
}

Wanted damped_step(const Normal& normal, const Wanted& wanted, float damping) noexcept {
    const Matrix3 inverted = inverse(damped(normal.moves, damping));
    Wanted by = wanted;
    by.move = times(inverted, wanted.move);
    if (wanted.scale == 0.0f) return by;
    // [moves both; both' turns] [by.move; by.turn] = [wanted.move; wanted.turn], the first eliminated.
    const Matrix3 eliminated = product(transposed(normal.both), inverted);
    by.rotation =
        times(inverse(difference(damped(normal.rotations, damping), product(eliminated, normal.both))),
              minus(wanted.rotation, times(eliminated, wanted.move)));
    by.move = times(inverted, minus(wanted.move, times(normal.both, by.rotation)));
    return by;
}

/// Damped only along eigenvectors of J J' whose singular value is small, as the solver without limits has it;
/// with an orientation there are six rows, and all are damped.
Wanted filtered_step(const Normal& normal, const Wanted& wanted, float damping) noexcept {
    if (wanted.scale != 0.0f) return damped_step(normal, wanted, damping);
    constexpr double small_singular = 0.4;
    const auto& m = normal.moves.at;
    Symmetric3 jj;
    jj.xx = m[0][0], jj.yy = m[1][1], jj.zz = m[2][2];
    jj.xy = m[0][1], jj.xz = m[0][2], jj.yz = m[1][2];
    const Eigen3 e = eigen(jj);
    const glm::dvec3 move = wide(wanted.move);
    glm::dvec3 by{0.0};
    for (std::size_t k = 0; k < 3; ++k) {
        const double squared = std::max(e.values[k], 0.0);
        const double small = std::max(1.0 - squared / (small_singular * small_singular), 0.0);
        const double divisor = squared + std::max(static_cast<double>(damping) * small, 1e-9);
        by = plus(by, times(e.vectors[k], dot(e.vectors[k], move) / divisor));
    }
    return {narrow(by), glm::vec3(0.0f), 0.0f};
}

/// The step along the gradient after which the error, were it linear, would be smallest.
Wanted steepest_step(const Normal& normal, const Wanted& wanted) noexcept {
    const glm::vec3 move = plus(times(normal.moves, wanted.move), times(normal.both, wanted.rotation)),
                    rotation = plus(times(transposed(normal.both), wanted.move),
                                    times(normal.rotations, wanted.rotation));
    const float size = dot(move, move) + dot(rotation, rotation);
    const float best = size > 0.0f ? (dot(move, wanted.move) + dot(rotation, wanted.rotation)) / size : 0.0f;
    return {times(wanted.move, best), times(wanted.rotation, best), wanted.scale};
}

}  // namespace

Wanted projected_step(Problem& problem, Descent descent, float damping, const Wanted& wanted,
                      Normal& normal) noexcept {
    Wanted by = wanted;
    for (int pass = 0; pass < 4; ++pass) {
        by = descent == Descent::Transpose  ? steepest_step(normal, wanted)
             : descent == Descent::Filtered ? filtered_step(normal, wanted, damping)
                                            : damped_step(normal, wanted, damping);
        if (!activate(problem, by, normal)) break;
    }
    return by;
}

void rotate_joints(Problem& problem, const Wanted& by) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    float maximum = 1.0f;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::vec3 rotation = rotation_by(scratch.freedoms[i], by);
        maximum = std::max(maximum, dot(rotation, rotation));
    }
    const float half = 0.5f / std::sqrt(maximum);
    scratch.trial.joints[0] = problem.root();
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::quat parent = parent_of(scratch.pose.rotations, i);
        const glm::vec3 v = rotated(conjugate(parent), times(rotation_by(scratch.freedoms[i], by), half));
        scratch.trial.local[i] = unit(compose({1.0f, v.x, v.y, v.z}, scratch.pose.local[i]));
        clamp(scratch.limits[i], scratch.trial.local[i]);
        place_bone(problem, scratch.trial, i);
    }
}

void limited_step(Problem& problem, Descent descent, float damping) noexcept {
    const Wanted wanted = wanted_of(problem);
    Normal normal = linearize(problem, wanted);
    rotate_joints(problem, projected_step(problem, descent, damping, wanted, normal));
}

}  // namespace tendril::ik::detail
