#include "tendril/humanoid/limits.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "humanoid/anatomy.hpp"
#include "humanoid/input.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;

float radians(double degrees) noexcept {
    return static_cast<float>(degrees * pi / 180.0);
}

/// Half-angles in degrees, by direction of the bone. `out` is to the bone's own side, `in` to the other.
struct Ball {
    double forward, back, out, in, twist;
};

class DefaultLimits {
  public:
    DefaultLimits(const Skeleton& skeleton, const BoneMap& map)
        : map_(map),
          facing_(facing(skeleton, map)),
          across_(cross(facing_.up, facing_.forward)),
          pose_(t_pose(skeleton, map)),
          rest_(skeleton.size()),
          t_(skeleton.size()) {
        place(skeleton, rest_pose(skeleton), rest_);
        place(skeleton, pose_, t_);
    }

    BodyLimits all() const {
        BodyLimits limits{};
        spine(limits, {Bone::Spine, Bone::Chest, Bone::UpperChest}, {75.0, 30.0, 40.0, 40.0, 45.0});
        spine(limits, {Bone::Neck, Bone::Head, Bone::Head}, {60.0, 70.0, 45.0, 45.0, 80.0});
        for (const bool left : {true, false}) limb(limits, left);
        return limits;
    }

  private:
    /// Divides the range of the whole column among its bones.
    void spine(BodyLimits& limits, const std::array<Bone, 3>& bones, const Ball& whole) const {
        double count = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
            if (i == 0 || bones[i] != bones[i - 1]) count += map_[bones[i]].node >= 0 ? 1.0 : 0.0;
        count = std::max(count, 1.0);
        for (const Bone bone : bones) {
            ik::Limit& limit = limits[static_cast<std::size_t>(bone)];
            limit.kind = bone == Bone::Neck ? ik::JointKind::Pivot : ik::JointKind::BallAndSocket;
            limit.axis = axis(across_);  // up is forward, left is to the character's right
            limit.up = radians(whole.forward / count), limit.down = radians(whole.back / count);
            limit.left = limit.right = radians(whole.out / count);
            limit.twist_max = radians(whole.twist / count), limit.twist_min = -limit.twist_max;
        }
    }
    /// True if the shoulder is too short for a collar bone. In rigs with such a stub, the whole arm turns
    /// about it.
    bool is_stub(Bone shoulder, Bone upper, Bone lower, Bone hand) const {
        constexpr double shortest = 0.1;  // arm lengths; a collar bone is 0.25
        for (const Bone each : {shoulder, upper, lower, hand})
            if (map_[each].node < 0) return false;
        const auto way = [&](Bone from, Bone to) {
            return length(minus(rest_[static_cast<std::size_t>(map_[to].node)].position,
                                rest_[static_cast<std::size_t>(map_[from].node)].position));
        };
        return way(shoulder, upper) < shortest * (way(upper, lower) + way(lower, hand));
    }
    void limb(BodyLimits& limits, bool left) const {
        const auto side = [left](Bone of_left) { return left ? of_left : mirrored(of_left); };
        const auto at = [&](Bone of_left) -> ik::Limit& {
            return limits[static_cast<std::size_t>(side(of_left))];
        };
        const glm::dvec3 out = left ? facing_.left : -facing_.left;
        const bool lies_left = dot(out, across_) > 0.0;  // a map may have the sides swapped
        // The arm goes up about this axis; about the perpendicular one, the body's up, the left arm goes
        // back.
        const glm::dvec3 raises = cross(out, facing_.up);
        at(Bone::LeftUpperArm) =
            ball(ik::JointKind::BallAndSocket, raises, {95.0, 100.0, 50.0, 135.0, 90.0}, lies_left);
        at(Bone::LeftShoulder) =
            is_stub(side(Bone::LeftShoulder), side(Bone::LeftUpperArm), side(Bone::LeftLowerArm),
                    side(Bone::LeftHand))
                ? at(Bone::LeftUpperArm)
                : ball(ik::JointKind::BallAndSocket, raises, {30.0, 10.0, 20.0, 25.0, 15.0}, lies_left);
        at(Bone::LeftLowerArm) = hinge(side(Bone::LeftLowerArm), cross(out, facing_.forward), 150.0);
        at(Bone::LeftHand) = ball(ik::JointKind::Gliding, raises, {70.0, 80.0, 20.0, 35.0, 85.0}, lies_left);
        // Legs go forward and toes up about this axis; about the perpendicular one, forward, they go left.
        const glm::dvec3 lifts = -across_;
        at(Bone::LeftUpperLeg) =
            ball(ik::JointKind::BallAndSocket, lifts, {120.0, 30.0, 45.0, 30.0, 45.0}, lies_left);
        at(Bone::LeftLowerLeg) = hinge(side(Bone::LeftLowerLeg), across_, 150.0);
        at(Bone::LeftFoot) = ball(ik::JointKind::Gliding, lifts, {30.0, 50.0, 25.0, 25.0, 25.0}, lies_left);
        at(Bone::LeftToes) = ik::Limit::hinge(axis(lifts), radians(-40.0), radians(70.0));
    }
    /// `range.out` is to the left for a left limb, to the right for a right one.
    static ik::Limit ball(ik::JointKind kind, const glm::dvec3& about, const Ball& range, bool left) {
        ik::Limit limit;
        limit.kind = kind;
        limit.axis = axis(about);
        limit.up = radians(range.forward), limit.down = radians(range.back);
        limit.left = radians(left ? range.out : range.in), limit.right = radians(left ? range.in : range.out);
        limit.twist_max = radians(range.twist), limit.twist_min = -limit.twist_max;
        return limit;
    }
    ik::Limit hinge(Bone bone, const glm::dvec3& usual, double most) const {
        return ik::Limit::hinge(axis(bend_at_rest(bone, usual).value_or(usual)), 0.0f, radians(most));
    }
    /// The axis of a lower limb's bend at rest, transported to the T-pose; nullopt if it is nearly straight,
    /// or slightly overstretched (bent against `usual`).
    std::optional<glm::dvec3> bend_at_rest(Bone bone, const glm::dvec3& usual) const {
        const Bone upper = static_cast<Bone>(static_cast<int>(bone) - 1);
        const auto end = detail::limb_child(bone);
        for (const Bone each : {upper, bone, *end})
            if (map_[each].node < 0) return std::nullopt;
        const auto node = [&](Bone each) { return static_cast<std::size_t>(map_[each].node); };
        const auto first = direction_of(minus(rest_[node(bone)].position, rest_[node(upper)].position), 1e-9);
        const auto second = direction_of(minus(rest_[node(*end)].position, rest_[node(bone)].position), 1e-9);
        if (!first || !second) return std::nullopt;
        const glm::dvec3 across = cross(*first, *second);
        const double sine = length(across), angle = arctangent(sine, dot(*first, *second));
        if (angle < 5.0 * pi / 180.0 || angle > 2.0) return std::nullopt;
        const glm::dquat to_t =
            math::compose(t_[node(upper)].rotation(), conjugate(rest_[node(upper)].rotation()));
        const glm::dvec3 found = rotated(to_t, times(across, 1.0 / sine));
        if (angle < 15.0 * pi / 180.0 && dot(found, usual) < 0.0) return std::nullopt;
        return found;
    }
    static glm::vec3 axis(const glm::dvec3& of) { return math::narrow(of); }

    const BoneMap& map_;
    Facing facing_;
    glm::dvec3 across_;  // to the character's left, whatever the map calls left
    std::vector<rig::Transform> pose_;
    std::vector<Placement> rest_, t_;
};

/// Angles observed in clips.
struct ObservedAngles {
    std::vector<ik::JointAngles> angles{};
    float twist_min = 0.0f, twist_max = 0.0f;
    float up = 0.0f, down = 0.0f, left = 0.0f, right = 0.0f;

    void add(const ik::JointAngles& each) {
        if (angles.empty()) twist_min = twist_max = each.twist;
        angles.push_back(each);
        twist_min = std::min(twist_min, each.twist), twist_max = std::max(twist_max, each.twist);
        up = std::max(up, each.up), down = std::max(down, -each.up);
        left = std::max(left, each.left), right = std::max(right, -each.left);
    }
    bool moved() const {
        return std::any_of(angles.begin(), angles.end(), [&](const ik::JointAngles& each) {
            const ik::JointAngles& first = angles.front();
            return std::abs(each.up - first.up) > 1e-4f || std::abs(each.left - first.left) > 1e-4f ||
                   std::abs(each.twist - first.twist) > 1e-4f;
        });
    }
    /// Adds the margin and enlarges the half-angles until their ellipses contain every observed angle.
    void widen(float margin) {
        up += margin, down += margin, left += margin, right += margin;
        float most = 1.0f;
        for (const ik::JointAngles& each : angles) {
            const float x = each.up / (each.up >= 0.0f ? up : down),
                        y = each.left / (each.left >= 0.0f ? left : right);
            most = std::max(most, std::sqrt(x * x + y * y));
        }
        for (float* half : {&up, &down, &left, &right})
            *half = std::min(*half * most, static_cast<float>(pi));
        twist_min = std::max(twist_min - margin, -static_cast<float>(pi));
        twist_max = std::min(twist_max + margin, static_cast<float>(pi));
    }
    ik::Limit limit(ik::Limit like) const {
        if (like.kind == ik::JointKind::Hinge) {
            const float most = static_cast<float>(pi);
            float low = angles.front().up, high = low;
            for (const ik::JointAngles& each : angles)
                low = std::min(low, each.up), high = std::max(high, each.up);
            like.min = std::max(low - radians(1.0), -most), like.max = std::min(high + radians(1.0), most);
            return like;
        }
        like.up = up, like.down = down, like.left = left, like.right = right;
        like.twist_min = twist_min, like.twist_max = twist_max;
        return like;
    }
};

}  // namespace

BodyLimits no_limits() noexcept {
    return {};
}

BodyLimits default_limits(const Skeleton& skeleton, const BoneMap& map) {
    return DefaultLimits(skeleton, detail::map_or_none(map, skeleton)).all();
}

BodyLimits learned_limits(const Skeleton& skeleton, const BoneMap& map, std::span<const Clip> clips,
                          const BodyLimits& like) {
    BodyLimits limits = like;
    const Expected<BodyJoints> joints = BodyJoints::make(skeleton, map, like);
    if (!joints) return limits;
    std::array<ObservedAngles, bone_count> seen{};
    std::vector<rig::Transform> pose(skeleton.size());
    std::vector<Placement> placements(skeleton.size());
    for (const Clip& clip : clips) {
        const auto frames = static_cast<std::size_t>(std::min(clip.duration * 60.0, 1e5)) + 1;
        for (std::size_t frame = 0; frame < frames; ++frame) {
            sample(clip, skeleton, static_cast<double>(frame) / 60.0, pose);
            place(skeleton, pose, placements);
            for (std::size_t i = 0; i < bone_count; ++i)
                if (map.bones[i].node >= 0) seen[i].add(joints->measure(static_cast<Bone>(i), placements));
        }
    }
    for (std::size_t i = 0; i < bone_count; ++i) {
        if (like[i].kind == ik::JointKind::Free || seen[i].angles.empty() || !seen[i].moved()) continue;
        seen[i].widen(radians(1.0));
        limits[i] = seen[i].limit(like[i]);
    }
    return limits;
}

Expected<BodyJoints> BodyJoints::make(const Skeleton& skeleton, const BoneMap& map,
                                      const BodyLimits& limits) {
    if (const Result bad = detail::check_map("BodyJoints", map, skeleton); !bad) return bad;
    BodyJoints result;
    const Facing at = facing(skeleton, map);
    std::vector<Placement> placements(skeleton.size());
    place(skeleton, t_pose(skeleton, map), placements);
    for (std::size_t i = 0; i < bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        Joint& joint = result.joints_[i];
        joint.node = map.bones[i].node;
        joint.limit = limits[i];
        joint.direction = detail::t_direction(bone, at);
        if (const char* fault = ik::fault(joint.limit, math::narrow(joint.direction)))
            return Result(ErrorCode::InvalidArgument, std::string(name(bone)) + ": " + fault);
        if (joint.node < 0) continue;
        joint.rest = placements[static_cast<std::size_t>(joint.node)].rotation();
        for (std::int32_t above = skeleton[static_cast<std::size_t>(joint.node)].parent;
             above >= 0 && joint.parent < 0; above = skeleton[static_cast<std::size_t>(above)].parent)
            if (const auto found = detail::bone_of(map, above)) joint.parent = static_cast<int>(*found);
    }
    return result;
}

glm::dquat BodyJoints::from_t_pose(const Joint& joint, std::span<const Placement> placements) const noexcept {
    return math::compose(placements[static_cast<std::size_t>(joint.node)].rotation(), conjugate(joint.rest));
}

glm::dquat BodyJoints::turn(Bone bone, std::span<const Placement> placements) const noexcept {
    const Joint& own = joint(bone);
    if (own.node < 0) return {1.0, 0.0, 0.0, 0.0};
    const glm::dquat whole = from_t_pose(own, placements);
    if (own.parent < 0) return whole;
    return math::compose(conjugate(from_t_pose(joints_[static_cast<std::size_t>(own.parent)], placements)),
                         whole);
}

ik::JointAngles BodyJoints::measure(Bone bone, std::span<const Placement> placements) const noexcept {
    const Joint& own = joint(bone);
    if (own.node < 0) return {};
    const glm::dquat by = turn(bone, placements);
    return ik::measure(own.limit, math::narrow(own.direction),
                       glm::quat(static_cast<float>(by.w), static_cast<float>(by.x), static_cast<float>(by.y),
                                 static_cast<float>(by.z)));
}

float BodyJoints::excess(Bone bone, std::span<const Placement> placements) const noexcept {
    const Joint& own = joint(bone);
    if (own.node < 0 || own.limit.kind == ik::JointKind::Free) return 0.0f;
    ik::JointAngles angles = measure(bone, placements);
    if (own.limit.kind == ik::JointKind::Hinge) angles.left = angles.twist = 0.0f;
    return ik::excess(own.limit, angles);
}

std::optional<Bone> BodyJoints::parent(Bone bone) const noexcept {
    const Joint& own = joint(bone);
    if (own.node < 0 || own.parent < 0) return std::nullopt;
    return static_cast<Bone>(own.parent);
}

}  // namespace tendril::humanoid
