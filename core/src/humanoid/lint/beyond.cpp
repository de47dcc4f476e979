// Joints turned beyond their limits.
#include <algorithm>

#include "humanoid/lint/lint.hpp"
#include "math/vector.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

using namespace rig::detail;

/// Degrees by which decent clips exceed the default limits: captured heads that are mapped to the end of the
/// neck, forearms turned instead of the upper arm. Knees exceed them the least.
double tolerance(Bone bone) noexcept {
    switch (bone) {
        case Bone::LeftLowerLeg:
        case Bone::RightLowerLeg:
            return 20.0;
        case Bone::Head:
        case Bone::LeftLowerArm:
        case Bone::RightLowerArm:
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

/// Radians by which an elbow is beyond what an arm can do. Rigs divide an arm's twist between collar bone,
/// upper arm and forearm as they like, so only the sum of them counts: the elbow may bend to any side to
/// which the upper arm can twist it, seen from the chest.
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
    // Twisted by a right angle too far it bends backwards.
    const double backwards = bend * std::min(1.0, twisted / (0.5 * pi));
    return std::max(backwards, bend - static_cast<double>(elbow.max));
}

/// Beyond the default limits.
double excess_of(const BodyJoints& joints, Bone bone, const std::vector<Placement>& placed) {
    for (const Arm& arm : arms)
        if (bone == arm.lower && joints.parent(bone) == arm.upper) return elbow_excess(joints, arm, placed);
    return static_cast<double>(joints.excess(bone, placed));
}

/// Since when a joint is beyond its limit, and the worst frame.
struct Stay {
    bool is_beyond = false;
    std::size_t first = 0, worst = 0;
    double most = 0.0;  // degrees
};

/// Default limits must be exceeded for longer than this: a hinge's angle jumps when it is turned about
/// another axis.
constexpr double shortest = 0.1;  // seconds

void tell(Check& check, Bone bone, const Stay& stay, std::size_t last) {
    const double seconds = static_cast<double>(last - stay.first) / check.report.rate;
    if (!check.settings.limits && seconds < shortest) return;
    check.add(Fault::Limit, check.map[bone].node, stay.worst, stay.first, last, stay.most, "deg",
              "is turned " + shown(stay.most) + " degrees beyond its limit");
}

}  // namespace

void check_limits(Check& check) {
    if (!check.map.is_usable()) return;
    const BodyLimits* const given = check.settings.limits;
    const Expected<BodyJoints> joints = BodyJoints::make(
        check.skeleton, check.map, given ? *given : default_limits(check.skeleton, check.map));
    if (!joints) return;
    std::array<Stay, bone_count> stays{};
    std::vector<rig::Transform> pose(check.skeleton.size());
    std::vector<Placement> placed(check.skeleton.size());
    for (std::size_t frame = 0; frame < check.report.frames; ++frame) {
        sample(check.clip, check.skeleton, check.time_of(frame), pose);
        place(check.skeleton, pose, placed);
        for (std::size_t i = 0; i < bone_count; ++i) {
            const auto bone = static_cast<Bone>(i);
            const double excess = degrees * (given ? static_cast<double>(joints->excess(bone, placed))
                                                   : excess_of(*joints, bone, placed));
            Stay& stay = stays[i];
            const bool is_beyond = excess > (given ? check.settings.beyond : tolerance(bone));
            if (stay.is_beyond && !is_beyond) tell(check, bone, stay, frame - 1);
            if (is_beyond && (!stay.is_beyond || excess > stay.most)) {
                if (!stay.is_beyond) stay.first = frame;
                stay.worst = frame;
                stay.most = excess;
            }
            stay.is_beyond = is_beyond;
        }
    }
    for (std::size_t i = 0; i < bone_count; ++i)
        if (stays[i].is_beyond) tell(check, static_cast<Bone>(i), stays[i], check.report.frames - 1);
}

}  // namespace tendril::humanoid::lint_detail
