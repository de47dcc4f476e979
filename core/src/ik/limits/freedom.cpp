#include "ik/limits/freedom.hpp"

#include "ik/limits/pose.hpp"
#include "ik/tunables.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

/// What turning about a unit axis adds.
void add_axis(Normal& normal, const glm::vec3& axis, const glm::vec3& arm, float scale, double by) noexcept {
    const glm::dvec3 about = wide(axis), column = cross(about, wide(arm));
    add_square(normal.moves, column, by);
    if (scale == 0.0f) return;
    const double s = static_cast<double>(scale);
    add_square(normal.rotations, about, by * s * s);
    const double weights[] = {by * s * about.x, by * s * about.y, by * s * about.z};
    for (std::size_t k = 0; k < 3; ++k) normal.both[k] = plus(normal.both[k], times(column, weights[k]));
}

/// The same for all three axes.
void add_ball(Normal& normal, const glm::vec3& arm, float scale) noexcept {
    const glm::dvec3 r = wide(arm);
    add_ball_joint(normal.moves, r);
    if (scale == 0.0f) return;
    const double s = static_cast<double>(scale);
    normal.rotations.xx += s * s, normal.rotations.yy += s * s, normal.rotations.zz += s * s;
    normal.both[0] = plus(normal.both[0], {0.0, -s * r.z, s * r.y});  // columns e_k x r
    normal.both[1] = plus(normal.both[1], {s * r.z, 0.0, -s * r.x});
    normal.both[2] = plus(normal.both[2], {-s * r.y, s * r.x, 0.0});
}

/// Takes an axis from what the joint may do, and from the matrix; whether there was any of it.
bool forbid(JointFreedom& freedom, const glm::vec3& axis, float scale, Normal& normal) noexcept {
    if (!freedom.ball) {
        if (freedom.count == 0) return false;
        add_axis(normal, freedom.axes[0], freedom.arm, scale, -1.0);
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
    add_axis(normal, rest, freedom.arm, scale, -1.0);
    freedom.axes[static_cast<std::size_t>(freedom.count++)] = rest;
    return true;
}

}  // namespace

Wanted wanted_of(const Problem& problem) noexcept {
    Wanted wanted;
    const LimitedPose& pose = problem.scratch.limited.pose;
    const float unit_length = 1.0f / problem.scratch.reach;
    wanted.move = times(minus(problem.target, pose.joints[problem.bones()]), unit_length);
    // A target far out of reach says no more than its direction.
    if (const float far = length(wanted.move); far > 1.0f) wanted.move = times(wanted.move, 1.0f / far);
    if (problem.options.tip_orientation) {
        wanted.rotation = times(orientation_error(problem, pose), unit_length);
        wanted.scale = tune::limits::orientation_arm;
    }
    return wanted;
}

Normal linearize(Problem& problem, const Wanted& wanted) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    const LimitedPose& pose = scratch.pose;
    const glm::vec3 tip = pose.joints[problem.bones()];
    const float unit_length = 1.0f / problem.scratch.reach;
    Normal normal;
    scratch.at_bounds = 0;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const LimitedJoint& joint = scratch.limits[i];
        JointFreedom& freedom = scratch.freedoms[i];
        freedom.arm = times(minus(tip, pose.joints[i]), unit_length);
        freedom.ball = !joint.hinge();
        freedom.count = 0;
        const glm::quat parent = parent_of(pose.rotations, i);
        if (joint.hinge()) {
            freedom.axes[0] = rotated(parent, joint.axis);
            freedom.count = 1;
            add_axis(normal, freedom.axes[0], freedom.arm, wanted.scale, 1.0);
        } else {
            add_ball(normal, freedom.arm, wanted.scale);
        }
        if (is_inside(joint, pose.local[i])) continue;
        freedom.bounds = bounds_of(joint, pose.local[i]);
        int open = 0;  // bounds on one side only
        for (int k = 0; k < freedom.bounds.count; ++k) {
            Bounds::Bound bound = freedom.bounds.at[k];
            bound.outward = rotated(parent, bound.outward);
            if (bound.both)
                forbid(freedom, bound.outward, wanted.scale, normal);
            else
                freedom.bounds.at[open++] = bound;
        }
        freedom.bounds.count = open;
        if (open > 0) scratch.bounded[scratch.at_bounds++] = i;
    }
    return normal;
}

glm::vec3 rotation_by(const JointFreedom& freedom, const Wanted& by) noexcept {
    if (freedom.ball && freedom.count == 3) return glm::vec3(0.0f);
    const glm::vec3 whole = plus(cross(freedom.arm, by.move), times(by.rotation, by.scale));
    glm::vec3 some{0.0f};
    for (int i = 0; i < freedom.count; ++i) {
        const glm::vec3& axis = freedom.axes[static_cast<std::size_t>(i)];
        some = plus(some, times(axis, dot(axis, whole)));
    }
    return freedom.ball ? minus(whole, some) : some;
}

bool activate(Problem& problem, const Wanted& by, Normal& normal) noexcept {
    LimitedScratch& scratch = problem.scratch.limited;
    bool any = false;
    for (std::size_t n = 0; n < scratch.at_bounds; ++n) {
        JointFreedom& freedom = scratch.freedoms[scratch.bounded[n]];
        for (int k = 0; k < freedom.bounds.count; ++k) {
            const glm::vec3 rotation = rotation_by(freedom, by), outward = freedom.bounds.at[k].outward;
            const float push = dot(rotation, outward);
            if (push <= 0.0f || push * push <= 1e-8f * dot(rotation, rotation)) continue;
            any = forbid(freedom, outward, by.scale, normal) || any;
        }
    }
    return any;
}

}  // namespace tendril::ik::detail
