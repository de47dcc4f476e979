#include "ik/limited_step.hpp"

#include <algorithm>

#include "ik/limited_matrix.hpp"
#include "ik/limited_pose.hpp"
#include "ik/symmetric3.hpp"
#include "ik/wide.hpp"

namespace tendril::ik::detail {
namespace {

/// The change of rotation, in the world's axes of the swing's own frame, for a change `d` of the vector `v`
/// of a rotation: the left Jacobian of the exponential map.
glm::vec3 turned_by(const glm::vec3& v, const glm::vec3& d) noexcept {
    const float squared = dot(v, v);
    const glm::vec3 vd = cross(v, d);
    if (squared < 1e-6f) return plus(d, times(vd, 0.5f));
    const float angle = std::sqrt(squared);
    const float first = (1.0f - std::cos(angle)) / squared;
    const float second = (1.0f - std::sin(angle) / angle) / squared;
    return plus(plus(d, times(vd, first)), times(cross(v, vd), second));
}

/// How each angle of a joint turns its bone: three axes in the world, zero for what the joint has not.
std::array<glm::vec3, 3> axes_of(const Problem& problem, std::size_t bone,
                                 const JointAngles& angles) noexcept {
    const LimitedJoint& joint = problem.room.limited.limits[bone];
    const glm::quat parent = parent_of(problem.room.rotations, bone);
    if (joint.free()) {
        return {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)};
    }
    if (joint.hinge()) return {rotated(parent, joint.axis), glm::vec3(0.0f), glm::vec3(0.0f)};
    const glm::vec3 swing = plus(times(joint.axis, angles.up), times(joint.side, angles.left));
    return {rotated(parent, turned_by(swing, joint.axis)), rotated(parent, turned_by(swing, joint.side)),
            bone_direction(problem, problem.room.rotations[bone], bone)};
}

void prepare(Problem& problem) noexcept {
    LimitedRoom& room = problem.room.limited;
    const glm::vec3 tip = problem.joints.back();
    const float unit_length = 1.0f / problem.room.reach;  // so that no size of chain overflows
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const glm::quat parent = parent_of(problem.room.rotations, i);
        room.angles[i] = angles_of(room.limits[i], compose(conjugate(parent), problem.room.rotations[i]));
        room.axes[i] = axes_of(problem, i, room.angles[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            room.columns[i][k] = cross(room.axes[i][k], times(minus(tip, problem.joints[i]), unit_length));
        }
    }
}

/// What is asked, in reaches: the tip's way to go, and with an orientation the turn to go, scaled as error_of
/// has it.
struct Wanted {
    glm::vec3 move{0.0f}, turn{0.0f};
    float scale = 0.0f;  ///< reaches a radian; 0 without an orientation
};

Wanted wanted_of(const Problem& problem) noexcept {
    Wanted wanted;
    const float unit_length = 1.0f / problem.room.reach;
    wanted.move = times(minus(problem.target, problem.joints.back()), unit_length);
    // A target far out of reach says no more than its direction.
    if (const float far = length(wanted.move); far > 1.0f) wanted.move = times(wanted.move, 1.0f / far);
    if (problem.options.tip_orientation) {
        wanted.turn = times(orientation_error(problem, problem.room.rotations), unit_length);
        wanted.scale = 0.25f;
    }
    return wanted;
}

float along(const Wanted& wanted, const glm::vec3& column, const glm::vec3& axis) noexcept {
    return dot(column, wanted.move) + wanted.scale * dot(axis, wanted.turn);
}

JointAngles change_of(const LimitedRoom& room, std::size_t i, const Wanted& by) noexcept {
    return {along(by, room.columns[i][0], room.axes[i][0]), along(by, room.columns[i][1], room.axes[i][1]),
            along(by, room.columns[i][2], room.axes[i][2])};
}

Wanted damped(const Problem& problem, const Wanted& wanted, float damping) noexcept {
    const LimitedRoom& room = problem.room.limited;
    Matrix3 moves = diagonal(damping), turns = diagonal(damping), both = diagonal(0.0f);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            add_product(moves, room.columns[i][k], room.columns[i][k]);
            if (wanted.scale == 0.0f) continue;
            const glm::vec3 turn = times(room.axes[i][k], wanted.scale);
            add_product(turns, turn, turn);
            add_product(both, room.columns[i][k], turn);
        }
    }
    Wanted by = wanted;
    if (wanted.scale == 0.0f) {
        by.move = times(inverse(moves), wanted.move);
        return by;
    }
    // [moves both; both' turns] [by.move; by.turn] = [wanted.move; wanted.turn], the first eliminated.
    const Matrix3 inverted = inverse(moves);
    const Matrix3 carried_over = product(transposed(both), inverted);
    by.turn = times(inverse(difference(turns, product(carried_over, both))),
                    minus(wanted.turn, times(carried_over, wanted.move)));
    by.move = times(inverted, minus(wanted.move, times(both, by.turn)));
    return by;
}

/// Damped only along eigenvectors of J J' whose singular value is small, as the solver without limits has it;
/// with an orientation there are six rows, and all are damped.
Wanted filtered(const Problem& problem, const Wanted& wanted, float damping) noexcept {
    if (wanted.scale != 0.0f) return damped(problem, wanted, damping);
    constexpr double small_singular = 0.4;
    Symmetric3 jj;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        for (const glm::vec3& column : problem.room.limited.columns[i]) {
            const double x = column.x, y = column.y, z = column.z;
            jj.xx += x * x, jj.yy += y * y, jj.zz += z * z;
            jj.xy += x * y, jj.xz += x * z, jj.yz += y * z;
        }
    }
    const Eigen3 e = eigen(jj);
    const glm::dvec3 move{wanted.move.x, wanted.move.y, wanted.move.z};
    glm::dvec3 by{0.0};
    for (std::size_t k = 0; k < 3; ++k) {
        const double squared = std::max(e.values[k], 0.0);
        const double small = std::max(1.0 - squared / (small_singular * small_singular), 0.0);
        const double divisor = squared + std::max(static_cast<double>(damping) * small, 1e-9);
        by = plus(by, times(e.vectors[k], dot(e.vectors[k], move) / divisor));
    }
    return {narrow(by), glm::vec3(0.0f), 0.0f};
}

/// The step along the gradient after which the error, were it linear, would be least.
Wanted steepest(const Problem& problem, const Wanted& wanted) noexcept {
    const LimitedRoom& room = problem.room.limited;
    glm::vec3 move{0.0f}, turn{0.0f};
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointAngles change = change_of(room, i, wanted);
        const float parts[] = {change.up, change.left, change.twist};
        for (std::size_t k = 0; k < 3; ++k) {
            move = plus(move, times(room.columns[i][k], parts[k]));
            turn = plus(turn, times(room.axes[i][k], parts[k] * wanted.scale));
        }
    }
    const float size = dot(move, move) + dot(turn, turn);
    const float best = size > 0.0f ? (dot(move, wanted.move) + dot(turn, wanted.turn)) / size : 0.0f;
    return {times(wanted.move, best), times(wanted.turn, best), wanted.scale};
}

bool pushes(float angle, float by, float min, float max) noexcept {
    if (max - min >= 2.0f * pi - at_bound) return false;
    return (angle >= max - at_bound && by > 0.0f) || (angle <= min + at_bound && by < 0.0f);
}

void drop(LimitedRoom& room, std::size_t i, std::size_t k) noexcept {
    room.columns[i][k] = room.axes[i][k] = glm::vec3(0.0f);
}

/// Only the part of the two swings along the unit vector (up, left) is left.
void slide(std::array<glm::vec3, 3>& vectors, float up, float left) noexcept {
    const glm::vec3 tangent = plus(times(vectors[0], up), times(vectors[1], left));
    vectors[0] = times(tangent, up);
    vectors[1] = times(tangent, left);
}

bool hold_swing(LimitedRoom& room, std::size_t i, const JointAngles& change) noexcept {
    const LimitedJoint& joint = room.limits[i];
    const JointAngles& angles = room.angles[i];
    const float a = angles.up >= 0.0f ? joint.up : joint.down,
                b = angles.left >= 0.0f ? joint.left : joint.right;
    const float up = angles.up * b * b, left = angles.left * a * a;  // outward
    const float size = std::sqrt(up * up + left * left);
    if (!on_rim(joint, angles) || size < 1e-12f || change.up * up + change.left * left <= 1e-6f * size) {
        return false;
    }
    slide(room.columns[i], -left / size, up / size);
    slide(room.axes[i], -left / size, up / size);
    return true;
}

/// Takes away what would push a joint out of its limit; whether there was any.
bool hold_back(Problem& problem, const Wanted& by) noexcept {
    LimitedRoom& room = problem.room.limited;
    bool any = false;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const LimitedJoint& joint = room.limits[i];
        if (joint.free()) continue;
        const JointAngles change = change_of(room, i, by);
        if (joint.hinge()) {
            if (!pushes(room.angles[i].up, change.up, joint.min, joint.max)) continue;
            drop(room, i, 0);
            any = true;
            continue;
        }
        if (pushes(room.angles[i].twist, change.twist, joint.twist_min, joint.twist_max)) {
            drop(room, i, 2);
            any = true;
        }
        any = hold_swing(room, i, change) || any;
    }
    return any;
}

/// No angle changes by more than this at once; further the columns say nothing.
float bounded(const Problem& problem, const Wanted& by) noexcept {
    float most = 1.0f;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointAngles change = change_of(problem.room.limited, i, by);
        most = std::max({most, std::abs(change.up), std::abs(change.left), std::abs(change.twist)});
    }
    return 1.0f / most;
}

void take(Problem& problem, const Wanted& by) noexcept {
    LimitedRoom& room = problem.room.limited;
    const float scale = bounded(problem, by);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointAngles change = change_of(room, i, by);
        const glm::quat parent = parent_of(room.trial.rotations, i);
        const glm::quat old =
            compose(conjugate(parent_of(problem.room.rotations, i)), problem.room.rotations[i]);
        JointAngles angles = room.angles[i];
        angles.up += scale * change.up;
        angles.left += scale * change.left;
        angles.twist += scale * change.twist;
        glm::quat turn = old;
        if (room.limits[i].free()) {
            const glm::vec3 about = times(glm::vec3{change.up, change.left, change.twist}, 0.5f * scale);
            const glm::vec3 own = rotated(conjugate(parent_of(problem.room.rotations, i)), about);
            turn = compose(unit_quaternion(1.0f, own.x, own.y, own.z), old);
        } else {
            turn = turn_of(room.limits[i], within(room.limits[i], angles));
        }
        room.trial.rotations[i] = unit(compose(parent, turn));
    }
    lay(problem, room.trial);
}

}  // namespace

void limited_step(Problem& problem, Descent descent, float damping) noexcept {
    prepare(problem);
    const Wanted wanted = wanted_of(problem);
    Wanted by = wanted;
    for (int pass = 0; pass < 4; ++pass) {
        by = descent == Descent::Transpose  ? steepest(problem, wanted)
             : descent == Descent::Filtered ? filtered(problem, wanted, damping)
                                            : damped(problem, wanted, damping);
        if (!hold_back(problem, by)) break;
    }
    take(problem, by);
}

}  // namespace tendril::ik::detail
