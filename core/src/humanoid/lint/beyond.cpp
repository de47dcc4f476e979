// Joints turned beyond their limits.
#include <algorithm>

#include "humanoid/joint_turn.hpp"
#include "humanoid/lint/lint.hpp"
#include "ik/limits/joint.hpp"
#include "math/vector.hpp"
#include "tendril/elementary.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

/// Degrees by which decent clips exceed the default limits: most for captured heads mapped to the end of the
/// neck, least for knees. For elbows it is less than the 40 of an elbow that bends backwards.
double tolerance(Bone bone) noexcept {
    switch (bone) {
        case Bone::LeftLowerLeg:
        case Bone::RightLowerLeg:
            return 20.0;
        case Bone::LeftLowerArm:
        case Bone::RightLowerArm:
            return 34.0;
        case Bone::Head:
            return 65.0;
        default:
            return 45.0;
    }
}

struct Arm {
    Bone shoulder, upper, lower;
};
constexpr Arm arms[]{{Bone::LeftShoulder, Bone::LeftUpperArm, Bone::LeftLowerArm},
                     {Bone::RightShoulder, Bone::RightUpperArm, Bone::RightLowerArm}};

/// Radians by which an elbow exceeds the range of the arm. Rigs divide an arm's twist freely between collar
/// bone, upper arm and forearm, so only the sum matters: the elbow may bend to any side to which the upper
/// arm can twist it, seen from the chest.
double elbow_excess(const BodyJoints& joints, const Arm& arm, const std::vector<Placement>& placed) {
    const ik::Limit &shoulder = joints.limit(arm.upper), &elbow = joints.limit(arm.lower);
    const glm::dvec3 along = joints.direction(arm.upper);
    const glm::dquat upper = math::compose(joints.turn(arm.shoulder, placed), joints.turn(arm.upper, placed)),
                     lower = math::compose(upper, joints.turn(arm.lower, placed));
    const glm::dquat without_twist = minimal_rotation(along, rotated(upper, along));
    const glm::dvec3 seen = rotated(conjugate(without_twist), rotated(lower, along));
    const glm::dvec3 forward = direction_of(cross(math::wide(elbow.axis), along), 1e-9).value_or(along),
                     axis = cross(along, forward);
    const double bend = arctangent(length(cross(along, seen)), dot(along, seen)),
                 twist = arctangent(dot(seen, axis), dot(seen, forward));
    const double twisted = std::max({0.0, static_cast<double>(shoulder.twist_min) - twist,
                                     twist - static_cast<double>(shoulder.twist_max)});
    // The turn to the nearest allowed side; to straight, if twisted by over a right angle too far.
    const double aside = math::sine(bend) * math::sine(twisted);
    double backwards =
        twisted < 0.5 * pi ? arctangent(aside, std::sqrt(std::max(0.0, 1.0 - aside * aside))) : bend;
    // Some captures turn the forearm instead of the upper arm: up to 60 degrees, bent by 66, in
    // cmu_91_50.fbx.
    if (twisted < 60.0 / degrees && backwards < 65.0 / degrees) backwards = 0.0;
    return std::max(backwards, bend - static_cast<double>(elbow.max));
}

/// The smallest turn that brings a ball joint within its limit, radians, by compass search (T. Kolda, R.
/// Lewis, V. Torczon, SIAM Review 45(3), 2003). The separate excesses of cone and twist are too large if the
/// bone points nearly against its rest, since any twist there is a swing to another side.
double correction(const ik::Limit& limit, const glm::dvec3& along, const glm::dquat& turn) {
    const ik::detail::LimitedJoint joint = ik::detail::limited_joint(limit, math::narrow(along));
    const glm::quat wanted(static_cast<float>(turn.w), static_cast<float>(turn.x), static_cast<float>(turn.y),
                           static_cast<float>(turn.z));
    ik::JointAngles best = within(joint, angles_of(joint, wanted));
    const auto angle_from = [&](const ik::JointAngles& angles) {
        const glm::quat there = rotation_of(joint, angles);
        return 2.0 * half_angle_between({there.w, there.x, there.y, there.z}, turn);
    };
    double least = angle_from(best);
    constexpr float smallest = 1e-3f;  // radians
    for (float step = 0.5f; step > smallest; step *= 0.5f)
        for (bool goes_on = true; goes_on;) {
            goes_on = false;
            for (float ik::JointAngles::*angle :
                 {&ik::JointAngles::up, &ik::JointAngles::left, &ik::JointAngles::twist})
                for (const float by : {step, -step}) {
                    ik::JointAngles next = best;
                    next.*angle += by;
                    next = within(joint, next);
                    const double angle_left = angle_from(next);
                    if (angle_left < least - 1e-6) least = angle_left, best = next, goes_on = true;
                }
        }
    return least;
}

/// The smallest turn that brings a hinge within its limit, radians, including sideways bends and twists.
double hinge_correction(const ik::Limit& limit, const glm::dquat& turn) {
    const glm::dvec3 axis = math::wide(limit.axis);
    const double within = std::clamp(detail::hinge_angle(axis, turn), static_cast<double>(limit.min),
                                     static_cast<double>(limit.max));
    return 2.0 * half_angle_between(rotation_about(axis, within), turn);
}

/// Radians by which a joint exceeds its limit; for a ball joint over `most`, the smallest turn back.
double excess_of(const BodyJoints& joints, Bone bone, const std::vector<Placement>& placed, bool by_default,
                 double most) {
    for (const Arm& arm : arms)
        if (by_default && bone == arm.lower && joints.parent(bone) == arm.upper)
            return elbow_excess(joints, arm, placed);
    const ik::Limit& limit = joints.limit(bone);
    const bool is_hinge = limit.kind == ik::JointKind::Hinge;
    if (is_hinge && by_default) return hinge_correction(limit, joints.turn(bone, placed));
    const auto excess = static_cast<double>(joints.excess(bone, placed));
    return excess <= most || is_hinge ? excess
                                      : correction(limit, joints.direction(bone), joints.turn(bone, placed));
}

/// The first and the worst frame of a joint's excursion beyond its limit.
struct Excursion {
    bool is_beyond = false;
    std::size_t first = 0, worst = 0;
    double most = 0.0;  // degrees
};

/// Default limits must be exceeded for longer than this: a hinge's angle jumps when the hinge is turned about
/// another axis.
constexpr double shortest = 0.1;  // seconds

void add_finding(Check& check, Bone bone, const Excursion& stay, std::size_t last, double tolerated) {
    const double seconds = static_cast<double>(last - stay.first) / check.report.rate;
    if (!check.settings.limits && seconds < shortest) return;
    check.add(Fault::Limit, check.map[bone].node, stay.worst, stay.first, last, stay.most, "deg",
              "is turned " + shown(stay.most) + " degrees beyond its limit; " + shown(tolerated) +
                  " are tolerated");
}

}  // namespace

void check_limits(Check& check) {
    if (!check.map.is_usable()) return;
    const BodyLimits* const given = check.settings.limits;
    const Expected<BodyJoints> joints = BodyJoints::make(
        check.skeleton, check.map, given ? *given : default_limits(check.skeleton, check.map));
    if (!joints) return;
    const auto tolerated = [&](Bone bone) { return given ? check.settings.beyond : tolerance(bone); };
    std::array<Excursion, bone_count> stays{};
    std::vector<rig::Transform> pose(check.skeleton.size());
    std::vector<Placement> placed(check.skeleton.size());
    for (std::size_t frame = 0; frame < check.report.frames; ++frame) {
        sample(check.clip, check.skeleton, check.time_of(frame), pose);
        place(check.skeleton, pose, placed);
        for (std::size_t i = 0; i < bone_count; ++i) {
            const auto bone = static_cast<Bone>(i);
            const double most = tolerated(bone);
            const double excess = degrees * excess_of(*joints, bone, placed, !given, most / degrees);
            Excursion& stay = stays[i];
            const bool is_beyond = excess > most;
            if (stay.is_beyond && !is_beyond) add_finding(check, bone, stay, frame - 1, most);
            if (is_beyond && (!stay.is_beyond || excess > stay.most)) {
                if (!stay.is_beyond) stay.first = frame;
                stay.worst = frame;
                stay.most = excess;
            }
            stay.is_beyond = is_beyond;
        }
    }
    for (std::size_t i = 0; i < bone_count; ++i)
        if (const auto bone = static_cast<Bone>(i); stays[i].is_beyond)
            add_finding(check, bone, stays[i], check.report.frames - 1, tolerated(bone));
}

}  // namespace tendril::humanoid::lint_detail
