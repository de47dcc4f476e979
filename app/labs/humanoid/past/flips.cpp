#include "app/labs/humanoid/past/flips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"
#include "app/labs/kit/flips.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using humanoid::Placement;

struct Turned {
    Bone bone = Bone::Hips;
    std::size_t node = 0;
    double radians = 0.0;
};

double turn_of(const std::vector<Placement>& was, const std::vector<Placement>& is, std::size_t node) {
    return turn_between(was[node].rotation(), is[node].rotation());
}

/// The bones that turned far enough, from the hips outwards.
std::vector<Turned> turned_bones(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers) {
    const humanoid::Skeleton& skeleton = is.part.skeleton();
    const std::vector<bool> swings = swinging_nodes(is.part, solvers);
    const double enough = glm::radians(static_cast<double>(is.part.flips.degrees));
    std::vector<Turned> turned;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto node = is.part.node_of(static_cast<Bone>(i));
        if (!node || swings[*node]) continue;
        const double radians = turn_of(was.shown.placed, is.shown.placed, *node);
        if (radians > enough) turned.push_back({static_cast<Bone>(i), *node, radians});
    }
    std::ranges::stable_sort(turned, [&](const Turned& a, const Turned& b) {
        return a.node != b.node && skeleton.is_below(b.node, a.node);
    });
    return turned;
}

/// What may have turned a bone between the two moments.
class Drivers {
  public:
    Drivers(const HumanoidMoment& was, const HumanoidMoment& is) : was_(was), is_(is) {}

    /// Whether any driver moved far enough to explain the bone's turn.
    bool far(const Turned& bone) const {
        const double enough = static_cast<double>(is_.part.flips.angle_share) * bone.radians;
        return clip_turned(bone.node, enough) || hand_blended(bone.node) || looks_elsewhere(bone, enough) ||
               target_moved(bone, enough) || object_moved(bone, enough);
    }

  private:
    double share() const { return static_cast<double>(is_.part.flips.reach_share); }

    /// Whether the clip turned the node or an ancestor.
    bool clip_turned(std::size_t node, double enough) const {
        const humanoid::Skeleton& skeleton = is_.part.skeleton();
        for (auto at = static_cast<std::int32_t>(node); at >= 0;
             at = skeleton[static_cast<std::size_t>(at)].parent)
            if (turn_of(was_.clip(), is_.clip(), static_cast<std::size_t>(at)) >= std::max(enough, 1e-9))
                return true;
        return false;
    }

    /// Whether hand IK changed its weight, and the node belongs to that arm.
    bool hand_blended(std::size_t node) const {
        if (!was_.shown.hands || !is_.shown.hands) return false;
        constexpr Bone arms[2][2]{{Bone::LeftShoulder, Bone::LeftUpperArm},
                                  {Bone::RightShoulder, Bone::RightUpperArm}};
        for (std::size_t hand = 0; hand < 2; ++hand) {
            const double change =
                std::abs(is_.shown.hands->hands[hand].weight - was_.shown.hands->hands[hand].weight);
            if (change < std::max(share(), 1e-9)) continue;
            for (const Bone top : arms[hand])
                if (const auto at = is_.part.node_of(top); at && is_.part.skeleton().is_below(node, *at))
                    return true;
        }
        return false;
    }

    bool looks_elsewhere(const Turned& bone, double enough) const {
        if (!was_.shown.look || !is_.shown.look) return false;
        if (std::abs(is_.shown.look->weight - was_.shown.look->weight) >= std::max(share(), 1e-9))
            return true;
        return moved(bone.node, was_.part.ik.look_at.options.target, is_.part.ik.look_at.options.target,
                     enough);
    }

    bool target_moved(const Turned& bone, double enough) const {
        return std::ranges::any_of(all_effectors, [&](humanoid::Effector each) {
            const auto &from = was_.part.ik.target(each), &to = is_.part.ik.target(each);
            if (!from || !to) return false;
            if (from->rotation && to->rotation &&
                turn_between(*from->rotation, *to->rotation) >= std::max(enough, 1e-9))
                return true;
            return moved(bone.node, from->position, to->position, enough);
        });
    }

    /// Whether the held object was asked to be elsewhere, or turned otherwise.
    bool object_moved(const Turned& bone, double enough) const {
        const std::optional<HoldSetting>&was = was_.part.ik.hold, &is = is_.part.ik.hold;
        if (!was || !is) return false;
        const humanoid::ObjectPose from = was->asked(was_.shown.hips), to = is->asked(is_.shown.hips);
        return turn_between(from.rotation, to.rotation) >= std::max(enough, 1e-9) ||
               moved(bone.node, from.position, to.position, enough);
    }

    /// As seen from where the clip puts the node.
    bool moved(std::size_t node, const glm::dvec3& from, const glm::dvec3& to, double enough) const {
        const glm::dvec3 a = from - was_.clip()[node].position, b = to - is_.clip()[node].position;
        const double distance = glm::distance(a, b),
                     angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
        return distance > 0.0 && angle >= enough && distance >= share() * is_.part.loaded->height();
    }

    const HumanoidMoment &was_, &is_;
};

}  // namespace

std::vector<BodyFlip> body_flips(const HumanoidMoment& was, const HumanoidMoment& is, Solvers& solvers) {
    constexpr double together = 1e-3;  // radians
    if (fading(was.part.ik_state.release) > 0.0 || fading(is.part.ik_state.release) > 0.0) return {};
    const humanoid::Skeleton& skeleton = is.part.skeleton();
    std::vector<Turned> flipped = turned_bones(was, is, solvers);
    const Drivers drivers(was, is);
    std::vector<std::size_t> driven;  // nodes, whose descendants move with them
    std::erase_if(flipped, [&](const Turned& bone) {
        const bool along =
            std::ranges::any_of(driven, [&](std::size_t each) { return skeleton.is_below(bone.node, each); });
        if (!along && !drivers.far(bone)) return false;
        driven.push_back(bone.node);
        return true;
    });
    struct Limb {
        std::size_t top = 0;
        Turned furthest;
    };
    std::vector<Limb> limbs;
    for (const Turned& bone : flipped) {
        const auto limb = std::ranges::find_if(
            limbs, [&](const Limb& each) { return skeleton.is_below(bone.node, each.top); });
        if (limb == limbs.end())
            limbs.push_back({bone.node, bone});
        else if (bone.radians > limb->furthest.radians + together)
            limb->furthest = bone;
    }
    std::vector<BodyFlip> flips;
    for (const Limb& each : limbs) flips.push_back({each.furthest.bone, each.furthest.radians});
    return flips;
}

// Why a bone of a body flipped.

namespace {

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

/// A limit of the bone, or of another one in its chain.
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
