#include "app/labs/humanoid/past/flips.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/humanoid/character/figure.hpp"
#include "app/labs/humanoid/ik/release.hpp"
#include "app/labs/kit/reach_flip.hpp"

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

/// From the hips out.
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

/// What may have turned a bone, between the two moments.
class Drivers {
  public:
    Drivers(const HumanoidMoment& was, const HumanoidMoment& is) : was_(was), is_(is) {}

    /// Whether one of them moved so far that it is no wonder that the bone turned.
    bool far(const Turned& bone) const {
        const double enough = static_cast<double>(is_.part.flips.angle_share) * bone.radians;
        return clip_turned(bone.node, enough) || hand_blended(bone.node) || looks_elsewhere(bone, enough) ||
               target_moved(bone, enough);
    }

  private:
    double share() const { return static_cast<double>(is_.part.flips.reach_share); }

    /// It, or a node that it hangs on.
    bool clip_turned(std::size_t node, double enough) const {
        const humanoid::Skeleton& skeleton = is_.part.skeleton();
        for (auto at = static_cast<std::int32_t>(node); at >= 0;
             at = skeleton[static_cast<std::size_t>(at)].parent)
            if (turn_of(was_.clip(), is_.clip(), static_cast<std::size_t>(at)) >= std::max(enough, 1e-9))
                return true;
        return false;
    }

    /// By another weight than before; the bone is one of that arm.
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
        return moved(bone.node, was_.part.ik.look_at.target, is_.part.ik.look_at.target, enough);
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

    /// As seen from where the clip has the node.
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
    std::vector<std::size_t> driven;  // nodes: what hangs on them goes along
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

}  // namespace tendril::app
