// Why a bone of a body flipped.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "app/labs/humanoid/ik/chains.hpp"
#include "app/labs/humanoid/past/flips.hpp"
#include "app/labs/kit/reach_flip.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using Cause = std::optional<std::string>;

/// A leg or an arm, from the hip or the shoulder joint on.
struct Limb {
    std::array<Bone, 3> bones;
    humanoid::Effector effector;
    const char *root, *middle;  ///< what a person calls its joints
};
constexpr std::array<Limb, 4> limbs{{{{Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand},
                                      humanoid::Effector::LeftHand,
                                      "left shoulder",
                                      "left elbow"},
                                     {{Bone::RightUpperArm, Bone::RightLowerArm, Bone::RightHand},
                                      humanoid::Effector::RightHand,
                                      "right shoulder",
                                      "right elbow"},
                                     {{Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot},
                                      humanoid::Effector::LeftFoot,
                                      "left hip",
                                      "left knee"},
                                     {{Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot},
                                      humanoid::Effector::RightFoot,
                                      "right hip",
                                      "right knee"}}};

/// What it reaches for, or, where it has no target, where it ends.
ReachPose reach_pose(const HumanoidMoment& moment, const Limb& limb) {
    ReachPose pose;
    for (const Bone bone : limb.bones) pose.joints.push_back(moment.shown.point(*moment.part.node_of(bone)));
    const auto& target = moment.part.ik.target(limb.effector);
    pose.target = target ? glm::vec3(target->position) : pose.joints.back();
    return pose;
}

Cause by_limb(const HumanoidMoment& was, const HumanoidMoment& is, const Limb& limb) {
    for (const Bone bone : limb.bones)
        if (!is.part.node_of(bone)) return std::nullopt;
    const ReachPose before = reach_pose(was, limb), after = reach_pose(is, limb);
    float reach = 0.0f;
    for (std::size_t i = 1; i < after.joints.size(); ++i)
        reach += glm::distance(after.joints[i - 1], after.joints[i]);
    if (is.part.ik.target(limb.effector) && went_through_root(before, after, reach))
        return std::string("the target went through the ") + limb.root;
    if (was_straight(before, after, reach)) return std::string("the ") + limb.middle + " was straight";
    return std::nullopt;
}

/// Of the bone, or of another one of its chain.
Cause by_limit(const HumanoidMoment& was, const HumanoidMoment& is, const std::vector<Bone>& chain) {
    if (!was.shown.body || !is.shown.body) return std::nullopt;
    for (const Bone bone : chain) {
        const auto i = static_cast<std::size_t>(bone);
        const bool before = was.shown.body->at_limit[i], after = is.shown.body->at_limit[i];
        if (before == after) continue;
        return std::string(humanoid::name(bone)) + (after ? " reached its limit" : " came free of its limit");
    }
    return std::nullopt;
}

}  // namespace

std::string flip_cause(const HumanoidMoment& was, const HumanoidMoment& is, Bone bone) {
    for (const BodyChain& chain : body_chains(*is.part.map)) {
        const auto node = is.part.node_of(bone);
        const bool inside = std::ranges::any_of(chain.bones, [&](Bone each) {
            return each == bone || (each == chain.end && each != Bone::Hips && node &&
                                    is.part.skeleton().is_below(*node, *is.part.node_of(each)));
        });
        if (!inside) continue;
        for (const Limb& limb : limbs)
            if (limb.bones.back() == chain.end)
                if (const Cause cause = by_limb(was, is, limb)) return *cause;
        if (const Cause cause = by_limit(was, is, chain.bones)) return *cause;
    }
    return "cause not known";
}

}  // namespace tendril::app
