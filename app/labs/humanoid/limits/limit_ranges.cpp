#include "app/labs/humanoid/limits/limit_ranges.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

namespace tendril::app {
namespace {

using humanoid::BodyLimits;
using humanoid::Bone;

const ik::Limit& of(const BodyLimits& limits, Bone bone) {
    return limits[static_cast<std::size_t>(bone)];
}

}  // namespace

LimitRanges::LimitRanges(SharedCharacter loaded, std::shared_ptr<const humanoid::BoneMap> map)
    : loaded_(std::move(loaded)),
      map_(std::move(map)),
      adult_(humanoid::default_limits(loaded_->skeleton(), *map_)) {
    if (auto joints = humanoid::BodyJoints::make(loaded_->skeleton(), *map_, adult_))
        joints_ = std::move(joints).value();
}

const ik::Limit* LimitRanges::adult(Bone bone) const {
    const bool limited = joints_ && (*map_)[bone].node >= 0 && of(adult_, bone).kind != ik::JointKind::Free;
    return limited ? &of(adult_, bone) : nullptr;
}

const BodyLimits& LimitRanges::learned() const {
    if (!learned_) learned_ = humanoid::learned_limits(loaded_->skeleton(), *map_, loaded_->clips(), adult_);
    return *learned_;
}

const ik::Limit* LimitRanges::clips(Bone bone) const {
    const bool turned = adult(bone) != nullptr && !(of(learned(), bone) == of(adult_, bone));
    return turned ? &of(learned(), bone) : nullptr;
}

BodyLimits LimitRanges::in_force(const IkSettings& ik) const {
    BodyLimits limits = humanoid::no_limits();
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const LimitsFrom from = ik.limits_of(static_cast<Bone>(i));
        if (from != LimitsFrom::None) limits[i] = from == LimitsFrom::Motion ? learned()[i] : adult_[i];
    }
    return limits;
}

ik::JointAngles LimitRanges::angles(Bone bone, const ShownPose& shown) const {
    return joints_->measure(bone, shown.placed);
}

LimitShape LimitRanges::shape(Bone bone, const ik::Limit& limit, const ShownPose& shown) const {
    glm::dquat parent(1.0, 0.0, 0.0, 0.0);
    if (const auto above = joints_->parent(bone)) {
        const auto node = static_cast<std::size_t>((*map_)[*above].node);
        parent = shown.placed[node].rotation() * glm::conjugate(joints_->rest_rotation(*above));
    }
    return {limit, glm::vec3(joints_->direction(bone)), glm::quat(parent)};
}

std::optional<JointNow> joint_now(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown,
                                  Bone bone) {
    if (solvers.body(part) == nullptr) return std::nullopt;
    const LimitRanges& ranges = solvers.limits(part);
    JointNow now{.adult = ranges.adult(bone), .clips = ranges.clips(bone)};
    if (now.adult == nullptr) return std::nullopt;
    now.from = part.ik.limits_of(bone);
    if (now.from != LimitsFrom::None)
        now.in_force = now.from == LimitsFrom::Motion && now.clips != nullptr ? now.clips : now.adult;
    now.angles = ranges.angles(bone, shown);
    if (now.in_force != nullptr) now.excess = excess_of(*now.in_force, now.angles);
    now.held = shown.body && shown.body->at_limit[static_cast<std::size_t>(bone)];
    return now;
}

float excess_of(const ik::Limit& limit, ik::JointAngles angles) {
    if (limit.kind == ik::JointKind::Hinge) angles.left = angles.twist = 0.0f;
    return ik::excess(limit, angles);
}

bool SelectedJoints::has(Bone bone) const {
    return std::find(all.begin(), all.end(), bone) != all.end();
}

SelectedJoints selected_joints(const HumanoidPart& part, Solvers& solvers) {
    SelectedJoints joints;
    if (part.selection.empty() || solvers.body(part) == nullptr) return joints;
    const LimitRanges& ranges = solvers.limits(part);
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        const auto node = part.node_of(bone);
        if (!node || !part.selection.has(*node) || ranges.adult(bone) == nullptr) continue;
        joints.all.push_back(bone);
        if (part.selection.active() == *node) joints.shown = bone;
    }
    if (!joints.shown && !joints.all.empty()) joints.shown = joints.all.back();
    return joints;
}

}  // namespace tendril::app
