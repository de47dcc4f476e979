#include "app/labs/humanoid/past/flips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"
#include "app/labs/kit/flips.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using humanoid::Placement;
using ik::InputMove;

double turn_of(const std::vector<Placement>& was, const std::vector<Placement>& is, std::size_t node) {
    return turn_between(was[node].rotation(), is[node].rotation());
}

/// The bones that turned far enough, from the hips outwards.
std::vector<BodyFlip> turned_bones(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers) {
    const humanoid::Skeleton& skeleton = is.part.skeleton();
    const std::vector<bool> swings = swinging_nodes(is.part, solvers);
    const double enough = glm::radians(static_cast<double>(is.part.flips.degrees));
    std::vector<BodyFlip> turned;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto node = is.part.node_of(static_cast<Bone>(i));
        if (!node || swings[*node]) continue;
        const double radians = turn_of(was.shown.placed, is.shown.placed, *node);
        if (radians > enough) turned.push_back({static_cast<Bone>(i), *node, radians, {}});
    }
    std::ranges::stable_sort(turned, [&](const BodyFlip& a, const BodyFlip& b) {
        return a.node != b.node && skeleton.is_below(b.node, a.node);
    });
    return turned;
}

/// True if the node belongs to that arm.
bool in_arm(const HumanoidPart& part, std::size_t node, std::size_t hand) {
    constexpr Bone arms[2][2]{{Bone::LeftShoulder, Bone::LeftUpperArm},
                              {Bone::RightShoulder, Bone::RightUpperArm}};
    return std::ranges::any_of(arms[hand], [&](Bone top) {
        const auto at = part.node_of(top);
        return at && part.skeleton().is_below(node, *at);
    });
}

/// The inputs that may have turned a bone between two moments, relative to its position in the clip.
std::vector<InputMove> inputs_of(const HumanoidMoment& was, const HumanoidMoment& is, std::size_t node) {
    const IkSettings &before = was.part.ik, &after = is.part.ik;
    const auto seen = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return ik::move_between(from - was.clip()[node].position, to - is.clip()[node].position);
    };
    InputMove clip, blend;
    for (auto at = static_cast<std::int32_t>(node); at >= 0;
         at = is.part.skeleton()[static_cast<std::size_t>(at)].parent)
        clip.turn = std::max(clip.turn, turn_of(was.clip(), is.clip(), static_cast<std::size_t>(at)));
    if (was.shown.hands && is.shown.hands)
        for (std::size_t hand = 0; hand < 2; ++hand)
            if (in_arm(is.part, node, hand))
                blend.share = std::max(blend.share, std::abs(is.shown.hands->hands[hand].weight -
                                                             was.shown.hands->hands[hand].weight));
    std::vector<InputMove> all{clip, blend};
    if (was.shown.look && is.shown.look) {
        all.push_back(seen(before.look_at.options.target, after.look_at.options.target));
        all.back().share = std::abs(is.shown.look->weight - was.shown.look->weight);
    }
    for (const humanoid::Effector each : all_effectors) {
        const auto &from = before.target(each), &to = after.target(each);
        if (!from || !to) continue;
        all.push_back(seen(from->position, to->position));
        if (from->rotation && to->rotation) all.back().turn = turn_between(*from->rotation, *to->rotation);
    }
    if (before.hold && after.hold) {
        const humanoid::ObjectPose from = before.hold->asked(was.shown.hips),
                                   to = after.hold->asked(is.shown.hips);
        all.push_back(seen(from.position, to.position));
        all.back().turn = turn_between(from.rotation, to.rotation);
    }
    return all;
}

// Why a bone of a body flipped.

using Cause = std::optional<std::string>;

/// A leg or an arm, from the hip or the shoulder joint on.
struct Limb {
    std::array<Bone, 3> bones;
    humanoid::Effector effector;
    const char *root, *middle;  ///< names of its joints for the user
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

/// The limb's target, or its end if it has none.
ik::ReachPose reach_pose(const HumanoidMoment& moment, const Limb& limb) {
    ik::ReachPose pose;
    for (const Bone bone : limb.bones) pose.joints.push_back(moment.shown.point(*moment.part.node_of(bone)));
    const auto& target = moment.part.ik.target(limb.effector);
    pose.target = target ? glm::vec3(target->position) : pose.joints.back();
    return pose;
}

Cause by_limb(const HumanoidMoment& was, const HumanoidMoment& is, const Limb& limb) {
    for (const Bone bone : limb.bones)
        if (!is.part.node_of(bone)) return std::nullopt;
    const ik::ReachPose before = reach_pose(was, limb), after = reach_pose(is, limb);
    if (is.part.ik.target(limb.effector) && ik::went_through_root(before, after))
        return std::string("the target went through the ") + limb.root;
    if (ik::was_straight(before, after)) return std::string("the ") + limb.middle + " was straight";
    return std::nullopt;
}

/// By a limit of the bone, or of another in its chain.
Cause by_limit(const HumanoidMoment& was, const HumanoidMoment& is, const std::vector<Bone>& chain) {
    if (!was.shown.body || !is.shown.body) return std::nullopt;
    for (const Bone bone : chain) {
        const auto i = static_cast<std::size_t>(bone);
        const bool before = was.shown.body->at_limit[i], after = is.shown.body->at_limit[i];
        if (before == after) continue;
        return std::string(humanoid::name(bone)) + (after ? " reached its limit" : " left its limit");
    }
    return std::nullopt;
}

/// From solve reports and poses, or "cause not known".
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

}  // namespace

std::vector<BodyFlip> body_flips(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers) {
    constexpr double together = 1e-3;  // radians
    if (fading(was.part.ik_state.release) > 0.0 || fading(is.part.ik_state.release) > 0.0) return {};
    const humanoid::Skeleton& skeleton = is.part.skeleton();
    std::vector<BodyFlip> flipped = turned_bones(was, is, solvers);
    std::vector<std::size_t> driven;  // the nodes below them move with them
    std::erase_if(flipped, [&](const BodyFlip& bone) {
        const bool along =
            std::ranges::any_of(driven, [&](std::size_t each) { return skeleton.is_below(bone.node, each); });
        const auto explains = [&](const InputMove& input) {
            return ik::explains(input, bone.radians, is.part.loaded->height(), is.part.flips);
        };
        if (!along && std::ranges::none_of(inputs_of(was, is, bone.node), explains)) return false;
        driven.push_back(bone.node);
        return true;
    });
    // For each limb, by its top node: the bone that turned furthest.
    std::vector<std::pair<std::size_t, BodyFlip>> furthest;
    for (const BodyFlip& bone : flipped) {
        const auto limb = std::ranges::find_if(
            furthest, [&](const auto& each) { return skeleton.is_below(bone.node, each.first); });
        if (limb == furthest.end())
            furthest.emplace_back(bone.node, bone);
        else if (bone.radians > limb->second.radians + together)
            limb->second = bone;
    }
    std::vector<BodyFlip> flips;
    for (const auto& [top, bone] : furthest) {
        flips.push_back(bone);
        flips.back().cause = flip_cause(was, is, bone.bone);
    }
    return flips;
}

}  // namespace tendril::app
