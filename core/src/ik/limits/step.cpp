#include "ik/limits/step.hpp"

#include "ik/math.hpp"
#include "ik/methods/jacobian.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {
namespace {

constexpr double min_inverse = 1e-9;  ///< under this a squared singular value is rounding

/// A linear combination of the block's columns; and what each column has of a vector.
glm::dvec3 combined(const Normal& normal, const glm::dvec3& by) noexcept {
    const auto& both = normal.both;
    return plus(plus(times(both[0], by.x), times(both[1], by.y)), times(both[2], by.z));
}
glm::dvec3 parts_of(const Normal& normal, const glm::dvec3& v) noexcept {
    return {dot(normal.both[0], v), dot(normal.both[1], v), dot(normal.both[2], v)};
}

Wanted damped_step(const Normal& normal, const Wanted& wanted, float damping) noexcept {
    const auto diagonal = static_cast<double>(damping);
    const Factors3 factors(normal.moves, diagonal);
    const glm::dvec3 move = wide(wanted.move);
    if (wanted.scale == 0.0f) return {narrow(factors.solve(move)), glm::vec3(0.0f), 0.0f};
    // [moves both; both' rotations] [by.move; by.rotation] = wanted, with by.move eliminated.
    Symmetric3 rest = normal.rotations;
    const glm::dvec3 x = parts_of(normal, factors.solve(normal.both[0])),
                     y = parts_of(normal, factors.solve(normal.both[1])),
                     z = parts_of(normal, factors.solve(normal.both[2]));
    rest.xx -= x.x, rest.yy -= y.y, rest.zz -= z.z, rest.xy -= x.y, rest.xz -= x.z, rest.yz -= y.z;
    const glm::dvec3 rotation =
        Factors3(rest, diagonal).solve(minus(wide(wanted.rotation), parts_of(normal, factors.solve(move))));
    return {narrow(factors.solve(minus(move, combined(normal, rotation)))), narrow(rotation), wanted.scale};
}

/// Damped only along eigenvectors of J J' whose singular value is small, as the solver without limits has it;
/// with an orientation there are six rows, and all are damped.
Wanted filtered_step(const Normal& normal, const Wanted& wanted, float damping) noexcept {
    if (wanted.scale != 0.0f) return damped_step(normal, wanted, damping);
    const glm::dvec3 by = filtered_solution(normal.moves, wide(wanted.move), static_cast<double>(damping),
                                            tune::jacobian::small_singular, min_inverse);
    return {narrow(by), glm::vec3(0.0f), 0.0f};
}

/// The step along the gradient after which the error, were it linear, would be smallest.
Wanted steepest_step(const Normal& normal, const Wanted& wanted) noexcept {
    const glm::dvec3 m = wide(wanted.move), r = wide(wanted.rotation);
    const glm::dvec3 move = plus(product(normal.moves, m), combined(normal, r)),
                     rotation = plus(parts_of(normal, m), product(normal.rotations, r));
    const double size = dot(move, move) + dot(rotation, rotation);
    const auto best = static_cast<float>(size > 0.0 ? (dot(move, m) + dot(rotation, r)) / size : 0.0);
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
