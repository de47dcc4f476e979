#include "tendril/humanoid/twist.hpp"

#include <algorithm>
#include <cmath>

#include "humanoid/anatomy.hpp"
#include "humanoid/input.hpp"
#include "humanoid/joint_turn.hpp"
#include "humanoid/names.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {

using namespace rig::detail;

namespace {

constexpr glm::dquat no_turn{1.0, 0.0, 0.0, 0.0};
/// Squared cosines of half a swing of 160 and of 175 degrees: between them the twist fades out.
constexpr double full = 0.0302, zero = 0.0019;
/// Radians; a smaller change is rounding.
constexpr double min_twist = 1e-9;

/// The nodes below `above` down to `node`; empty if `node` is not its descendant.
std::vector<std::size_t> path(const Skeleton& skeleton, std::size_t above, std::size_t node) {
    std::vector<std::size_t> nodes;
    while (node != above) {
        nodes.push_back(node);
        if (skeleton[node].parent < 0) return {};
        node = static_cast<std::size_t>(skeleton[node].parent);
    }
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
}

glm::dquat turned_along(const std::vector<std::size_t>& nodes,
                        std::span<const rig::Transform> pose) noexcept {
    glm::dquat turn = no_turn;
    for (const std::size_t node : nodes) turn = math::compose(turn, pose[node].rotation);
    return rig::normalised(turn);
}

/// The nearest mapped bone above a node.
std::optional<std::size_t> mapped_above(const Skeleton& skeleton, const BoneMap& map, std::size_t node) {
    for (std::int32_t above = skeleton[node].parent; above >= 0;
         above = skeleton[static_cast<std::size_t>(above)].parent)
        if (detail::bone_of(map, above)) return static_cast<std::size_t>(above);
    return std::nullopt;
}

}  // namespace

double twist_about(const glm::dvec3& axis, const glm::dquat& turn) noexcept {
    const double along = dot(glm::dvec3{turn.x, turn.y, turn.z}, axis);
    const double part = std::clamp((turn.w * turn.w + along * along - zero) / (full - zero), 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part) * detail::hinge_angle(axis, turn);
}

double TwistBone::part(const glm::dvec3& point) const noexcept {
    return std::clamp(dot(point, way) / dot(way, way), 0.0, 1.0);
}

std::vector<TwistBone> twist_bones(const Skeleton& skeleton, const BoneMap& given) {
    const BoneMap& map = detail::map_or_none(given, skeleton);
    std::vector<TwistBone> bones;
    const std::vector<rig::Transform> rest = rest_pose(skeleton);
    for (const Bone bone :
         {Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::RightUpperArm, Bone::RightLowerArm}) {
        const std::int32_t node = map[bone].node, end = map[*detail::limb_child(bone)].node;
        if (node < 0 || end < 0) continue;
        TwistBone found{bone, 0, static_cast<std::size_t>(node), static_cast<std::size_t>(end)};
        const auto above = mapped_above(skeleton, map, found.node);
        const std::vector<std::size_t> down = path(skeleton, found.node, found.end);
        if (!above || down.empty()) continue;
        found.above = *above;
        Placement at;
        for (const std::size_t each : down) at = at * placement(rest[each]);
        found.way = at.position;
        if (length(found.way) > 1e-9) bones.push_back(found);
    }
    return bones;
}

BoneTwist bone_twist(const TwistBone& bone, const glm::dquat& turn, const glm::dquat& end_turn) noexcept {
    const glm::dvec3 axis = times(bone.way, 1.0 / length(bone.way));
    const bool is_lower = bone.bone == Bone::LeftLowerArm || bone.bone == Bone::RightLowerArm;
    return {-twist_about(axis, turn), is_lower ? twist_about(axis, end_turn) : 0.0};
}

TwistNodes TwistNodes::find(const Skeleton& skeleton, const BoneMap& map) {
    TwistNodes found;
    const std::vector<rig::Transform> rest = rest_pose(skeleton);
    for (const TwistBone& bone : twist_bones(skeleton, map)) {
        const std::size_t arm = found.arms_.size(), first = found.nodes_.size();
        for (const std::int32_t each : skeleton.order()) {
            const auto node = static_cast<std::size_t>(each);
            if (node == bone.node || !skeleton.is_below(node, bone.node) ||
                skeleton.is_below(node, bone.end) || skeleton.is_below(bone.end, node) ||
                detail::bone_of(map, each) || !detail::is_twist_name(skeleton[node].name))
                continue;
            const std::vector<std::size_t> down = path(skeleton, bone.node, node);
            Placement at;
            for (const std::size_t step : down) at = at * placement(rest[step]);
            Helper helper{arm, node, bone.part(at.position), 0.0, false, no_turn};
            for (std::size_t i = first; i < found.nodes_.size(); ++i)
                if (skeleton.is_below(node, found.nodes_[i].node)) {
                    helper.hangs_on_twist = true;
                    helper.part_above = found.nodes_[i].part;
                }
            helper.above = turned_along({down.begin(), down.end() - 1}, rest);
            found.nodes_.push_back(helper);
        }
        if (found.nodes_.size() > first)
            found.arms_.push_back(
                {bone, path(skeleton, bone.above, bone.node), path(skeleton, bone.node, bone.end)});
    }
    return found;
}

std::vector<std::size_t> TwistNodes::along(Bone bone) const {
    std::vector<std::size_t> nodes;
    for (const Helper& each : nodes_)
        if (arms_[each.arm].bone.bone == bone) nodes.push_back(each.node);
    return nodes;
}

TwistNodes::ArmTurns TwistNodes::turns(std::span<const rig::Transform> pose) const noexcept {
    ArmTurns turns{};
    for (std::size_t i = 0; i < arms_.size(); ++i)
        turns[i] = {turned_along(arms_[i].to_bone, pose), turned_along(arms_[i].to_end, pose)};
    return turns;
}

void TwistNodes::follow(const ArmTurns& before, std::span<rig::Transform> pose) const noexcept {
    if (nodes_.empty()) return;
    const ArmTurns now = turns(pose);
    std::array<BoneTwist, 4> twists{};
    for (std::size_t i = 0; i < arms_.size(); ++i)
        twists[i] = bone_twist(arms_[i].bone, math::compose(conjugate(before[i].bone), now[i].bone),
                               math::compose(now[i].end, conjugate(before[i].end)));
    for (const Helper& each : nodes_) {
        const BoneTwist& twist = twists[each.arm];
        const double by = twist.at(each.part) - (each.hangs_on_twist ? twist.at(each.part_above) : 0.0);
        if (std::abs(by) < min_twist) continue;
        const glm::dvec3& way = arms_[each.arm].bone.way;
        const glm::dvec3 axis = rotated(conjugate(each.above), times(way, 1.0 / length(way)));
        glm::dquat& local = pose[each.node].rotation;
        local = rig::normalised(math::compose(rotation_about(axis, by), local));
    }
}

}  // namespace tendril::humanoid
