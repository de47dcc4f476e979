#include "ik/limits/least_squares.hpp"

#include <algorithm>

#include "ik/limits/pose.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {
namespace {

/// Adds the contribution of rotating about a unit axis.
void add_axis(Normal& normal, const glm::vec3& axis, const glm::vec3& arm, float scale, double by) noexcept {
    const glm::dvec3 about = wide(axis), column = cross(about, wide(arm));
    add_square(normal.moves, column, by);
    if (scale == 0.0f) return;
    const double s = static_cast<double>(scale);
    add_square(normal.rotations, about, by * s * s);
    const double weights[] = {by * s * about.x, by * s * about.y, by * s * about.z};
    for (std::size_t k = 0; k < 3; ++k) normal.both[k] = plus(normal.both[k], times(column, weights[k]));
}

/// Adds the contribution of all three axes.
void add_ball(Normal& normal, const glm::vec3& arm, float scale, double by) noexcept {
    const glm::dvec3 r = wide(arm);
    add_ball_joint(normal.moves, r, by);
    if (scale == 0.0f) return;
    const double s = by * static_cast<double>(scale), square = s * static_cast<double>(scale);
    normal.rotations.xx += square, normal.rotations.yy += square, normal.rotations.zz += square;
    normal.both[0] = plus(normal.both[0], {0.0, -s * r.z, s * r.y});  // columns e_k x r
    normal.both[1] = plus(normal.both[1], {s * r.z, 0.0, -s * r.x});
    normal.both[2] = plus(normal.both[2], {-s * r.y, s * r.x, 0.0});
}

/// Removes an axis from a joint's freedoms and from the matrix. Returns whether any of it was left.
bool remove_axis(JointFreedom& freedom, const glm::vec3& axis, float scale, Normal& normal) noexcept {
    const auto mobility = static_cast<double>(freedom.mobility);
    if (!freedom.ball) {
        if (freedom.count == 0) return false;
        add_axis(normal, freedom.axes[0], freedom.arm, scale, -mobility);
        freedom.count = 0;
        return true;
    }
    glm::vec3 rest = axis;
    for (int i = 0; i < freedom.count; ++i) {
        const glm::vec3& old = freedom.axes[static_cast<std::size_t>(i)];
        rest = minus(rest, times(old, dot(rest, old)));
    }
    const float size = length(rest);
    if (size < 1e-3f || freedom.count == 3) return false;
    rest = times(rest, 1.0f / size);
    add_axis(normal, rest, freedom.arm, scale, -mobility);
    freedom.axes[static_cast<std::size_t>(freedom.count++)] = rest;
    return true;
}

constexpr double min_inverse = 1e-9;  ///< squared singular values under this are rounding

/// Linear combination of the block's columns; and the dot product of each column with a vector.
glm::dvec3 combined(const Normal& normal, const glm::dvec3& by) noexcept {
    const auto& both = normal.both;
    return plus(plus(times(both[0], by.x), times(both[1], by.y)), times(both[2], by.z));
}
glm::dvec3 parts_of(const Normal& normal, const glm::dvec3& v) noexcept {
    return {dot(normal.both[0], v), dot(normal.both[1], v), dot(normal.both[2], v)};
}

TipDelta damped_step(const Normal& normal, const TipDelta& wanted, float damping) noexcept {
    const auto diagonal = static_cast<double>(damping);
    const Factors3 factors(normal.moves, diagonal);
    const glm::dvec3 move = wide(wanted.move);
    if (wanted.scale == 0.0f) return {narrow(factors.solve(move)), glm::vec3(0.0f), 0.0f};
    // Solves [moves both; both' rotations] [by.move; by.rotation] = wanted by eliminating by.move.
    Symmetric3 rest = normal.rotations;
    const glm::dvec3 x = parts_of(normal, factors.solve(normal.both[0])),
                     y = parts_of(normal, factors.solve(normal.both[1])),
                     z = parts_of(normal, factors.solve(normal.both[2]));
    rest.xx -= x.x, rest.yy -= y.y, rest.zz -= z.z, rest.xy -= x.y, rest.xz -= x.z, rest.yz -= y.z;
    const glm::dvec3 rotation =
        Factors3(rest, diagonal).solve(minus(wide(wanted.rotation), parts_of(normal, factors.solve(move))));
    return {narrow(factors.solve(minus(move, combined(normal, rotation)))), narrow(rotation), wanted.scale};
}

/// Damps only eigenvectors of J J' with small singular values, like the solver without limits. With an
/// orientation there are six rows, and all are damped.
TipDelta filtered_step(const Normal& normal, const TipDelta& wanted, float damping) noexcept {
    if (wanted.scale != 0.0f) return damped_step(normal, wanted, damping);
    const glm::dvec3 by = filtered_solution(normal.moves, wide(wanted.move), static_cast<double>(damping),
                                            tune::jacobian::small_singular, min_inverse);
    return {narrow(by), glm::vec3(0.0f), 0.0f};
}

/// The optimal step along the gradient, according to the linear model.
TipDelta steepest_step(const Normal& normal, const TipDelta& wanted) noexcept {
    const glm::dvec3 m = wide(wanted.move), r = wide(wanted.rotation);
    const glm::dvec3 move = plus(product(normal.moves, m), combined(normal, r)),
                     rotation = plus(parts_of(normal, m), product(normal.rotations, r));
    const double size = dot(move, move) + dot(rotation, rotation);
    const auto best = static_cast<float>(size > 0.0 ? (dot(move, m) + dot(rotation, r)) / size : 0.0);
    return {times(wanted.move, best), times(wanted.rotation, best), wanted.scale};
}

}  // namespace

TipDelta requested_delta(const Problem& problem) noexcept {
    TipDelta wanted;
    const LimitedPose& pose = problem.scratch.limited.pose;
    const float unit_length = 1.0f / problem.scratch.reach;
    wanted.move = times(minus(problem.target, pose.joints[problem.bones()]), unit_length);
    // Only the direction of a target far out of reach matters.
    if (const float far = length(wanted.move); far > 1.0f) wanted.move = times(wanted.move, 1.0f / far);
    if (const std::optional<glm::vec3> error = orientation_error(problem, pose)) {
        wanted.rotation = times(*error, unit_length);
        wanted.scale = tune::limits::orientation_arm;
    }
    return wanted;
}

Normal release_limits(LimitedScratch& scratch) noexcept {
    for (std::size_t n = 0; n < scratch.at_bounds; ++n) {
        JointFreedom& freedom = scratch.freedoms[scratch.bounded[n]];
        freedom.count = freedom.own;
    }
    return scratch.normal;
}

Normal linearize(Problem& problem, const TipDelta& wanted) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    const LimitedPose& pose = scratch.pose;
    const float unit_length = 1.0f / problem.scratch.reach;
    if (scratch.linearized) return release_limits(scratch);
    Normal normal;
    scratch.at_bounds = 0;
    std::size_t end = 0;  // end of the bones that the joint turns
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const LimitedJoint& joint = scratch.limits[i];
        JointFreedom& freedom = scratch.freedoms[i];
        if (i == end) end = end_of(scratch, i, problem.bones());
        freedom.arm = times(minus(pose.joints[end], pose.joints[i]), unit_length);
        freedom.turns_tip = end == problem.bones();
        const float scale = freedom.turns_tip ? wanted.scale : 0.0f;
        freedom.ball = !joint.hinge();
        freedom.count = 0;
        freedom.mobility = joint.mobility;
        const auto mobility = static_cast<double>(joint.mobility);
        const glm::quat parent = parent_of(scratch, pose.rotations, i);
        if (joint.hinge()) {
            freedom.axes[0] = rotated(parent, joint.axis);
            freedom.count = 1;
            add_axis(normal, freedom.axes[0], freedom.arm, scale, mobility);
        } else {
            add_ball(normal, freedom.arm, scale, mobility);
        }
        if (is_inside(joint, pose.local[i])) continue;
        freedom.bounds = bounds_of(joint, pose.local[i]);
        int open = 0;  // one-sided bounds
        for (int k = 0; k < freedom.bounds.count; ++k) {
            Bounds::Bound bound = freedom.bounds.at[k];
            bound.outward = rotated(parent, bound.outward);
            if (bound.both)
                remove_axis(freedom, bound.outward, scale, normal);
            else
                freedom.bounds.at[open++] = bound;
        }
        freedom.bounds.count = open;
        freedom.own = freedom.count;
        if (open > 0) scratch.bounded[scratch.at_bounds++] = i;
    }
    scratch.linearized = true;
    scratch.normal = normal;
    return normal;
}

bool activate(Problem& problem, const TipDelta& by, Normal& normal) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    bool any = false;
    for (std::size_t n = 0; n < scratch.at_bounds; ++n) {
        JointFreedom& freedom = scratch.freedoms[scratch.bounded[n]];
        for (int k = 0; k < freedom.bounds.count; ++k) {
            const glm::vec3 rotation = rotation_by(freedom, by), outward = freedom.bounds.at[k].outward;
            const float push = dot(rotation, outward);
            if (push <= 0.0f || push * push <= 1e-8f * dot(rotation, rotation)) continue;
            any = remove_axis(freedom, outward, freedom.turns_tip ? by.scale : 0.0f, normal) || any;
        }
    }
    return any;
}

TipDelta projected_step(Problem& problem, Descent descent, float damping, const TipDelta& wanted,
                        Normal& normal) noexcept {
    TipDelta by = wanted;
    for (int pass = 0; pass < 4; ++pass) {
        by = descent == Descent::Transpose  ? steepest_step(normal, wanted)
             : descent == Descent::Filtered ? filtered_step(normal, wanted, damping)
                                            : damped_step(normal, wanted, damping);
        if (!activate(problem, by, normal)) break;
    }
    return by;
}

float predicted_gain(const Normal& normal, const TipDelta& wanted, const TipDelta& by) noexcept {
    const glm::dvec3 m = wide(by.move), r = wide(by.rotation);
    const glm::dvec3 move = minus(wide(wanted.move), plus(product(normal.moves, m), combined(normal, r)));
    const glm::dvec3 rotation =
        minus(wide(wanted.rotation), plus(parts_of(normal, m), product(normal.rotations, r)));
    const double before = std::sqrt(dot(wide(wanted.move), wide(wanted.move)) +
                                    dot(wide(wanted.rotation), wide(wanted.rotation)));
    return static_cast<float>(before - std::sqrt(dot(move, move) + dot(rotation, rotation)));
}

void rotate_joints(Problem& problem, const TipDelta& by) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    float maximum = 1.0f;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        JointFreedom& freedom = scratch.freedoms[i];
        freedom.rotation = rotation_by(freedom, by);
        maximum = std::max(maximum, dot(freedom.rotation, freedom.rotation));
    }
    const float half = 0.5f / std::sqrt(maximum);
    scratch.trial.joints[0] = problem.root();
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::quat parent = parent_of(scratch, scratch.pose.rotations, i);
        const glm::vec3 v = rotated(conjugate(parent), times(scratch.freedoms[i].rotation, half));
        scratch.trial.local[i] = unit(compose({1.0f, v.x, v.y, v.z}, scratch.pose.local[i]));
        clamp(scratch.limits[i], scratch.trial.local[i]);
        place_bone(problem, scratch.trial, i);
    }
}

void limited_step(Problem& problem, Descent descent, float damping) noexcept {
    const TipDelta wanted = requested_delta(problem);
    Normal normal = linearize(problem, wanted);
    rotate_joints(problem, projected_step(problem, descent, damping, wanted, normal));
}

}  // namespace tendril::ik::detail
