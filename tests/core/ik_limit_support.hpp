// An independent measurement of limits: in double, with matrices instead of quaternions, from the joints and
// rotations that a solve leaves.
#pragma once

#include <glm/mat3x3.hpp>

#include "ik_support.hpp"
#include "tendril/ik/limit.hpp"

namespace tendril::test {

inline constexpr double degree = 3.14159265358979323846 / 180.0;

inline float radians(double degrees) {
    return static_cast<float>(degrees * degree);
}
inline double degrees(double radians) {
    return radians / degree;
}

/// An arm with limits and a rest pose.
struct Arm {
    Lengths lengths;
    Joints rest;  ///< rest directions of the bones
    std::vector<ik::Limit> limits;

    float reach() const { return static_cast<float>(reach_of(lengths)); }
    Joints at_rest(glm::vec3 root = {0, 0, 0}) const {
        Joints joints{root};
        for (std::size_t i = 0; i < lengths.size(); ++i)
            joints.push_back(joints.back() + rest[i] * lengths[i]);
        return joints;
    }
    KeptSolver solver() const { return KeptSolver(lengths, rest); }
};

struct Frame {
    glm::dvec3 bone, axis, side;
};

inline Frame frame_of(const ik::Limit& limit, glm::vec3 rest) {
    Frame frame;
    frame.bone = glm::normalize(glm::dvec3(rest));
    const glm::dvec3 axis(limit.axis);
    frame.axis = glm::normalize(axis - frame.bone * glm::dot(axis, frame.bone));
    frame.side = glm::cross(frame.axis, frame.bone);
    return frame;
}

inline glm::dmat3 matrix_of(glm::quat q) {
    return glm::mat3_cast(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)));
}

inline double signed_angle(glm::dvec3 from, glm::dvec3 to, glm::dvec3 about) {
    return std::atan2(glm::dot(about, glm::cross(from, to)), glm::dot(from, to));
}

/// Amount by which an angle is outside a range, modulo a full turn.
inline double out_of_range(double angle, double min, double max) {
    if (angle >= min && angle <= max) return 0.0;
    const double turn = 360.0 * degree;
    const auto apart = [turn](double a, double b) { return std::abs(std::remainder(a - b, turn)); };
    return std::min(apart(angle, min), apart(angle, max));
}

/// Distance to a quarter of an ellipse, by searching its single minimum.
inline double to_ellipse(double a, double b, double x, double y) {
    x = std::abs(x), y = std::abs(y);
    if (a > 0.0 && b > 0.0 && (x / a) * (x / a) + (y / b) * (y / b) <= 1.0) return 0.0;
    const auto far = [&](double t) { return std::hypot(x - a * std::cos(t), y - b * std::sin(t)); };
    double best = std::min(a == 0.0 ? std::hypot(x, std::max(y - b, 0.0)) : 10.0,
                           b == 0.0 ? std::hypot(std::max(x - a, 0.0), y) : 10.0);
    int nearest = 0;
    for (int i = 0; i <= 64; ++i) {
        if (far(i * 90.0 * degree / 64) < far(nearest * 90.0 * degree / 64)) nearest = i;
    }
    double low = std::max(nearest - 1, 0) * 90.0 * degree / 64,
           high = std::min(nearest + 1, 64) * 90.0 * degree / 64;
    for (int i = 0; i < 60; ++i) {
        const double first = low + (high - low) / 3, second = high - (high - low) / 3;
        (far(first) < far(second) ? high : low) = far(first) < far(second) ? second : first;
    }
    return std::min(best, far(low));
}

/// Excess over the limit for a rotation matrix, radians.
inline double over_limit(const ik::Limit& limit, glm::vec3 rest, const glm::dmat3& turn) {
    if (limit.kind == ik::JointKind::Free) return 0.0;
    const Frame frame = frame_of(limit, rest);
    if (limit.kind == ik::JointKind::Hinge) {
        const glm::dvec3 axis = turn * frame.axis, bone = turn * frame.bone;
        const double tilt = std::atan2(glm::length(glm::cross(frame.axis, axis)), glm::dot(frame.axis, axis));
        const glm::dvec3 flat = bone - frame.axis * glm::dot(bone, frame.axis);
        const double angle = signed_angle(frame.bone, flat, frame.axis);
        return std::max(tilt, out_of_range(angle, limit.min, limit.max));
    }
    const glm::dvec3 bone = turn * frame.bone, normal = glm::cross(frame.bone, bone);
    const double sine = glm::length(normal), swing = std::atan2(sine, glm::dot(frame.bone, bone));
    const glm::dvec3 about = sine > 1e-9 ? normal / sine : frame.axis;
    const double up = swing * glm::dot(about, frame.axis), left = swing * glm::dot(about, frame.side);
    const double twist = signed_angle(turned(frame.axis, about, swing), turn * frame.axis, bone);
    const double cone =
        to_ellipse(up >= 0 ? limit.up : limit.down, left >= 0 ? limit.left : limit.right, up, left);
    return std::max(cone, out_of_range(twist, limit.twist_min, limit.twist_max));
}

inline glm::dmat3 local_turn(std::span<const glm::quat> rotations, std::size_t bone) {
    const glm::dmat3 own = matrix_of(rotations[bone]);
    return bone == 0 ? own : glm::transpose(matrix_of(rotations[bone - 1])) * own;
}

/// No joint is more than 0.1 degrees over its limit, and the rotations match the joints.
inline ::testing::AssertionResult WithinLimits(const Arm& arm, std::span<const glm::vec3> joints,
                                               std::span<const glm::quat> rotations) {
    for (std::size_t i = 0; i < arm.lengths.size(); ++i) {
        const double over = degrees(over_limit(arm.limits[i], arm.rest[i], local_turn(rotations, i)));
        if (!(over <= 0.1))
            return ::testing::AssertionFailure() << "joint " << i << " (" << ik::name(arm.limits[i].kind)
                                                 << ") is over by " << over << " degrees";
        const double length = arm.lengths[i];
        const glm::dvec3 from(joints[i]), bone = glm::dvec3(joints[i + 1]) - from;
        const glm::dvec3 said = matrix_of(rotations[i]) * glm::normalize(glm::dvec3(arm.rest[i])) * length;
        // The resolution of float directions at that distance.
        const double rounding = 1e-6 * (glm::length(from) + static_cast<double>(arm.reach()));
        if (!(glm::length(bone - said) <= 1e-3 * length + rounding))
            return ::testing::AssertionFailure() << "bone " << i << " does not lie as its rotation says";
    }
    return ::testing::AssertionSuccess();
}

// ---- Arms

inline glm::vec3 some_axis(Random& random, glm::vec3 bone) {
    for (;;) {
        const glm::vec3 axis = some_direction(random);
        if (std::abs(glm::dot(axis, bone)) < 0.9f) return axis;
    }
}

inline ik::Limit some_cone(Random& random, glm::vec3 axis) {
    ik::Limit limit{.kind = ik::JointKind::BallAndSocket, .axis = axis};
    limit.up = radians(150) * part(random), limit.down = radians(150) * part(random);
    limit.left = radians(150) * part(random), limit.right = radians(150) * part(random);
    limit.twist_min = -radians(90) * part(random), limit.twist_max = radians(90) * part(random);
    return limit;
}

/// A hinge with a minimum down to -`below` and a maximum up to `above`, radians.
inline ik::Limit some_hinge(Random& random, glm::vec3 bone, float below, float above) {
    const glm::vec3 axis = some_axis(random, bone);
    const float min_angle = -below * part(random);
    return ik::Limit::hinge(axis, min_angle, above * part(random));
}

inline ik::Limit some_limit(Random& random, ik::JointKind kind, glm::vec3 bone) {
    ik::Limit limit = ik::Limit::of(kind);
    limit.axis = some_axis(random, bone);
    return limit;
}

enum class ArmKind { Mixed, Hinges, OneAxis, Human, Cones };
inline constexpr std::array arm_kinds{ArmKind::Mixed, ArmKind::Hinges, ArmKind::OneAxis, ArmKind::Human,
                                      ArmKind::Cones};
inline const char* name(ArmKind kind) {
    constexpr const char* names[] = {"all kinds", "hinges", "hinges of one axis", "human", "cones"};
    return names[static_cast<std::size_t>(kind)];
}

/// Joint by index: shoulder, elbow, wrist, and two joints of a finger.
inline ik::Limit human_joint(std::size_t index) {
    constexpr ik::JointKind kinds[] = {ik::JointKind::BallAndSocket, ik::JointKind::Hinge,
                                       ik::JointKind::Gliding, ik::JointKind::Hinge, ik::JointKind::Hinge};
    return ik::Limit::of(kinds[index % 5]);
}

inline Arm some_arm(Random& random, ArmKind kind, std::size_t bones) {
    Arm arm;
    const bool straight = kind == ArmKind::Human || random.chance(2);
    const glm::vec3 hinge = some_axis(random, {1, 0, 0});
    for (std::size_t i = 0; i < bones; ++i) {
        arm.lengths.push_back(between(random, 0.3f, 1.0f));
        glm::vec3 bone = straight ? glm::vec3(1, 0, 0) : some_direction(random);
        if (kind == ArmKind::OneAxis && std::abs(glm::dot(bone, hinge)) > 0.9f) bone = {1, 0, 0};
        arm.rest.push_back(bone);
        ik::Limit limit;
        switch (kind) {
            case ArmKind::Mixed:
                limit = some_limit(random, static_cast<ik::JointKind>(1 + random.below(6)), bone);
                break;
            case ArmKind::Hinges:
                limit = some_hinge(random, bone, radians(90), radians(145));
                break;
            case ArmKind::OneAxis:
                limit = ik::Limit::hinge(hinge, 0.0f, radians(145));
                break;
            case ArmKind::Human:
                limit = human_joint(i);
                break;
            case ArmKind::Cones:
                limit = some_cone(random, some_axis(random, bone));
                break;
        }
        arm.limits.push_back(limit);
    }
    return arm;
}

inline Arm some_arm(Random& random, std::size_t bones) {
    return some_arm(random, arm_kinds[random.below(arm_kinds.size())], bones);
}

/// The tip of a random pose within the limits, built from angles by matrices in double.
inline glm::vec3 some_tip(const Arm& arm, Random& random) {
    glm::dmat3 all(1.0);
    glm::dvec3 tip(0.0);
    for (std::size_t i = 0; i < arm.lengths.size(); ++i) {
        const ik::Limit& limit = arm.limits[i];
        const Frame frame = frame_of(limit, arm.rest[i]);
        const auto rotation = [](glm::dvec3 axis, double angle) {
            return glm::mat3_cast(glm::angleAxis(angle, axis));
        };
        if (limit.kind == ik::JointKind::Hinge) {
            all = all * rotation(frame.axis, between(random, limit.min, limit.max));
        } else {
            double up = 0.0, left = 0.0;
            do {
                up = between(random, -limit.down, limit.up), left = between(random, -limit.right, limit.left);
            } while (to_ellipse(up >= 0 ? limit.up : limit.down, left >= 0 ? limit.left : limit.right, up,
                                left) > 0);
            const double swing = std::hypot(up, left);
            if (swing > 1e-9) all = all * rotation((frame.axis * up + frame.side * left) / swing, swing);
            all = all * rotation(frame.bone, between(random, limit.twist_min, limit.twist_max));
        }
        tip += all * frame.bone * static_cast<double>(arm.lengths[i]);
    }
    return glm::vec3(tip);
}

}  // namespace tendril::test
