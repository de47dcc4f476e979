#include "app/io/character/stick_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <utility>
#include <vector>

#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using glm::vec3;
using humanoid::Bone;
using humanoid::Placement;

constexpr float lowered = 0.7f;  // radians; how far the bind pose's arms are below the T-pose

/// A cross-section: between two joints, or at one of them, and offset from it.
struct FigureSection {
    Bone from, to;  ///< joints of the left side
    float along;    ///< 0: at `from`; 1: at `to`
    vec3 beside;    ///< metres on a figure of 1.8 m; x: away from the middle
    float width, depth;
};

constexpr vec3 flat_z{0, 0, 1}, flat_y{0, 1, 0}, flat_x{1, 0, 0};

// The trunk: one chain up the middle, and its attachments.
constexpr FigureSection trunk[]{{Bone::Hips, Bone::Hips, 0, {0, 0.035f, -0.002f}, 0.138f, 0.096f},
                                {Bone::Hips, Bone::Hips, 0, {0, 0.085f, 0.002f}, 0.128f, 0.089f},
                                {Bone::Spine, Bone::Chest, 0.5f, {0, 0, 0.004f}, 0.124f, 0.086f},
                                {Bone::Chest, Bone::Chest, 0, {0, 0.03f, 0.004f}, 0.134f, 0.094f},
                                {Bone::UpperChest, Bone::UpperChest, 0, {0, -0.04f, 0}, 0.150f, 0.105f},
                                {Bone::UpperChest, Bone::UpperChest, 0, {0, 0.005f, 0}, 0.152f, 0.105f}};
constexpr FigureSection neck[]{{Bone::UpperChest, Bone::Neck, 0.75f, {0, 0, -0.012f}, 0.062f, 0.062f},
                               {Bone::Neck, Bone::Head, 0.25f, {0, 0, -0.006f}, 0.053f, 0.053f},
                               {Bone::Head, Bone::Head, 0, {0, 0.03f, 0.004f}, 0.051f, 0.051f}};
constexpr FigureSection skull[]{{Bone::Head, Bone::Head, 0, {0, 0.102f, -0.014f}, 0.097f, 0.079f},
                                {Bone::Head, Bone::Head, 0, {0, 0.104f, 0.002f}, 0.096f, 0.078f}};
constexpr FigureSection jaw[]{{Bone::Head, Bone::Head, 0, {0, 0.082f, 0.028f}, 0.072f, 0.062f},
                              {Bone::Head, Bone::Head, 0, {0, 0.040f, 0.044f}, 0.052f, 0.046f},
                              {Bone::Head, Bone::Head, 0, {0, 0.014f, 0.058f}, 0.034f, 0.034f}};
// Each of these is mirrored to the other side.
constexpr FigureSection girdle[]{
    {Bone::UpperChest, Bone::UpperChest, 0, {0, 0.095f, -0.010f}, 0.082f, 0.070f},
    {Bone::UpperChest, Bone::UpperChest, 0, {0.09f, 0.105f, -0.010f}, 0.070f, 0.066f},
    {Bone::LeftUpperArm, Bone::LeftUpperArm, 0, {-0.03f, -0.004f, -0.002f}, 0.055f, 0.054f}};
constexpr FigureSection slope[]{{Bone::Neck, Bone::Neck, 0, {0, 0.025f, -0.014f}, 0.046f, 0.042f},
                                {Bone::Neck, Bone::Neck, 0, {0.12f, -0.033f, -0.010f}, 0.038f, 0.038f}};
constexpr FigureSection breast[]{
    {Bone::UpperChest, Bone::UpperChest, 0, {0.045f, 0.035f, 0.058f}, 0.062f, 0.044f},
    {Bone::UpperChest, Bone::UpperChest, 0, {0.095f, 0.055f, 0.044f}, 0.050f, 0.038f}};
constexpr FigureSection blade[]{
    {Bone::UpperChest, Bone::UpperChest, 0, {0.070f, 0.045f, -0.060f}, 0.060f, 0.042f},
    {Bone::UpperChest, Bone::UpperChest, 0, {0.085f, -0.05f, -0.042f}, 0.055f, 0.045f}};
constexpr FigureSection pelvis[]{
    {Bone::LeftUpperLeg, Bone::LeftUpperLeg, 0, {-0.070f, 0.035f, -0.004f}, 0.096f, 0.088f},
    {Bone::LeftUpperLeg, Bone::LeftUpperLeg, 0, {-0.020f, 0.030f, -0.004f}, 0.083f, 0.083f}};
constexpr FigureSection seat[]{
    {Bone::LeftUpperLeg, Bone::LeftUpperLeg, 0, {-0.036f, 0.030f, -0.046f}, 0.072f, 0.066f},
    {Bone::LeftUpperLeg, Bone::LeftUpperLeg, 0, {-0.028f, -0.012f, -0.042f}, 0.071f, 0.066f}};
constexpr FigureSection leg[]{
    {Bone::LeftUpperLeg, Bone::LeftLowerLeg, 0.0f, {-0.010f, 0, 0}, 0.080f, 0.084f},
    {Bone::LeftUpperLeg, Bone::LeftLowerLeg, 0.2f, {-0.004f, 0, 0.004f}, 0.080f, 0.086f},
    {Bone::LeftUpperLeg, Bone::LeftLowerLeg, 0.5f, {-0.002f, 0, 0.006f}, 0.069f, 0.075f},
    {Bone::LeftUpperLeg, Bone::LeftLowerLeg, 0.8f, {0, 0, 0.003f}, 0.056f, 0.061f},
    {Bone::LeftUpperLeg, Bone::LeftLowerLeg, 1.0f, {0, 0, 0.003f}, 0.050f, 0.055f},
    {Bone::LeftLowerLeg, Bone::LeftFoot, 0.12f, {0, 0, -0.004f}, 0.048f, 0.052f},
    {Bone::LeftLowerLeg, Bone::LeftFoot, 0.32f, {0, 0, -0.014f}, 0.052f, 0.057f},
    {Bone::LeftLowerLeg, Bone::LeftFoot, 0.55f, {0, 0, -0.012f}, 0.044f, 0.049f},
    {Bone::LeftLowerLeg, Bone::LeftFoot, 0.80f, {0, 0, -0.007f}, 0.034f, 0.039f},
    {Bone::LeftLowerLeg, Bone::LeftFoot, 1.0f, {0, 0, -0.006f}, 0.034f, 0.038f}};
constexpr FigureSection foot[]{
    {Bone::LeftFoot, Bone::LeftFoot, 0, {0, -0.052f, -0.020f}, 0.036f, 0.046f},
    {Bone::LeftFoot, Bone::LeftFoot, 0, {0, -0.044f, 0.030f}, 0.038f, 0.047f},
    {Bone::LeftFoot, Bone::LeftToes, 0.6f, {0.002f, -0.006f, 0}, 0.043f, 0.042f},
    {Bone::LeftToes, Bone::LeftToes, 0, {0.003f, -0.002f, 0}, 0.048f, 0.031f},
    {Bone::LeftToes, Bone::LeftToes, 0, {0.002f, -0.008f, 0.045f}, 0.042f, 0.025f},
    {Bone::LeftToes, Bone::LeftToes, 0, {-0.002f, -0.010f, 0.068f}, 0.033f, 0.021f}};
constexpr FigureSection arm[]{
    {Bone::LeftUpperArm, Bone::LeftLowerArm, 0.0f, {0, -0.004f, 0}, 0.053f, 0.054f},
    {Bone::LeftUpperArm, Bone::LeftLowerArm, 0.25f, {0, -0.004f, 0}, 0.048f, 0.051f},
    {Bone::LeftUpperArm, Bone::LeftLowerArm, 0.55f, {0, 0, 0.002f}, 0.043f, 0.046f},
    {Bone::LeftUpperArm, Bone::LeftLowerArm, 0.85f, {0, 0, 0}, 0.037f, 0.037f},
    {Bone::LeftUpperArm, Bone::LeftLowerArm, 1.0f, {0, 0, 0}, 0.035f, 0.035f},
    {Bone::LeftLowerArm, Bone::LeftHand, 0.15f, {0, 0, 0}, 0.038f, 0.038f},
    {Bone::LeftLowerArm, Bone::LeftHand, 0.32f, {0, 0, 0}, 0.039f, 0.038f},
    {Bone::LeftLowerArm, Bone::LeftHand, 0.62f, {0, 0, 0}, 0.032f, 0.030f},
    {Bone::LeftLowerArm, Bone::LeftHand, 0.90f, {0, 0, 0}, 0.027f, 0.022f},
    {Bone::LeftLowerArm, Bone::LeftHand, 1.0f, {0, 0, 0}, 0.027f, 0.020f}};
constexpr FigureSection hand[]{
    {Bone::LeftLowerArm, Bone::LeftHand, 0.98f, {0, 0, 0}, 0.027f, 0.020f},
    {Bone::LeftLowerArm, Bone::LeftHand, 1.14f, {0, 0, 0.002f}, 0.036f, 0.018f},
    {Bone::LeftLowerArm, Bone::LeftHand, 1.32f, {0, 0, 0}, 0.040f, 0.016f},
    {Bone::LeftLowerArm, Bone::LeftHand, 1.48f, {0, -0.003f, -0.002f}, 0.036f, 0.013f},
    {Bone::LeftLowerArm, Bone::LeftHand, 1.62f, {0, -0.006f, -0.003f}, 0.028f, 0.011f}};
constexpr FigureSection thumb[]{
    {Bone::LeftLowerArm, Bone::LeftHand, 1.10f, {0, -0.003f, 0.018f}, 0.017f, 0.016f},
    {Bone::LeftLowerArm, Bone::LeftHand, 1.26f, {0, -0.010f, 0.046f}, 0.014f, 0.013f},
    {Bone::LeftLowerArm, Bone::LeftHand, 1.40f, {0, -0.014f, 0.058f}, 0.011f, 0.011f}};

float step_between(float from, float to, float x) {
    const float u = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return u * u * (3.0f - 2.0f * u);
}

class FigureBody {
  public:
    FigureBody(const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map) {
        for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
            if (map.bones[i].node < 0) return;
            nodes_[i] = static_cast<std::size_t>(map.bones[i].node);
        }
        std::vector<rig::Transform> pose = rest_pose(skeleton);
        rest_.resize(skeleton.size()), bound_.resize(skeleton.size());
        humanoid::place(skeleton, pose, rest_);
        for (const float side : {1.0f, -1.0f}) {
            const std::size_t node = nodes_[static_cast<std::size_t>(on(Bone::LeftUpperArm, side))];
            const glm::dquat above = rest_[static_cast<std::size_t>(skeleton[node].parent)].rotation();
            pose[node].rotation =
                glm::conjugate(above) *
                math::rotation_about(glm::dvec3(0.0, 0.0, 1.0), static_cast<double>(-side * lowered)) *
                above * pose[node].rotation;
        }
        humanoid::place(skeleton, pose, bound_);
        sole_ = std::min(at(Bone::LeftToes).y, at(Bone::RightToes).y);
        unit_ = (at(Bone::Head).y - sole_) / 1.58f;
        sole_ -= 0.02f * unit_;
        complete_ = unit_ > 1e-4f && unit_ < 1e4f;
    }

    Skin made() {
        if (!complete_) return {};
        shape();
        BodySurface surface = body_surface(field_, 0.0175f * unit_);
        SkinBuilder builder;
        std::array<std::size_t, humanoid::bone_count> joints{};
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const Placement& bind = bound_[nodes_[i]];
            const glm::dmat3 back = glm::inverse(bind.axes);
            joints[i] = builder.add_joint(nodes_[i], {back, -(back * bind.position)});
        }
        SkinBuilder::Corners corners;
        corners.influences.reserve(surface.positions.size());
        for (std::size_t i = 0; i < surface.positions.size(); ++i) {
            std::vector<std::pair<std::size_t, double>> by;
            for (const auto& [bone, weight] : weights(surface.positions[i], surface.groups[i]))
                by.emplace_back(joints[static_cast<std::size_t>(bone)], weight);
            corners.influences.push_back(std::move(by));
        }
        corners.positions = std::move(surface.positions);
        corners.normals = std::move(surface.normals);
        builder.add_part("the figure's body", std::move(corners), std::move(surface.indices),
                         {.colour = {0.70f, 0.72f, 0.75f, 1.0f}});
        return builder.finish();
    }

  private:
    enum Group : std::size_t { Trunk, LeftArm, RightArm, LeftLeg, RightLeg };
    using Weights = std::vector<std::pair<Bone, double>>;

    static Bone on(Bone left, float side) { return side > 0.0f ? left : mirrored(left); }
    std::size_t node(Bone bone) const { return nodes_[static_cast<std::size_t>(bone)]; }
    vec3 at(Bone bone) const { return vec3(bound_[node(bone)].position); }

    // The shape.

    void shape() {
        const auto middle = [&](const auto& sections, vec3 flat) { chain(Trunk, sections, flat, 1.0f); };
        middle(trunk, flat_z), middle(neck, flat_z), middle(skull, flat_x), middle(jaw, flat_x);
        for (const float side : {1.0f, -1.0f}) {
            for (const auto& [sections, flat] :
                 {std::pair<std::span<const FigureSection>, vec3>(girdle, flat_z),
                  {slope, flat_z},
                  {breast, flat_z},
                  {blade, flat_z},
                  {pelvis, flat_z},
                  {seat, flat_z}})
                chain(Trunk, sections, flat, side);
        }
        for (const float side : {1.0f, -1.0f}) {
            const Group group = side > 0.0f ? LeftArm : RightArm;
            chain(group, arm, flat_y, side), chain(group, hand, flat_y, side),
                chain(group, thumb, flat_y, side);
        }
        for (const float side : {1.0f, -1.0f}) {
            const Group group = side > 0.0f ? LeftLeg : RightLeg;
            chain(group, leg, flat_z, side), chain(group, foot, flat_y, side);
        }
        field_.blend = 0.03f * unit_;
        field_.floor = sole_;
    }

    /// A section's position in the bind pose.
    BodySection placed(const FigureSection& section, vec3 flat, float side) const {
        const std::size_t from = node(on(section.from, side)), to = node(on(section.to, side));
        const Placement &rest = rest_[from], &bound = bound_[from];
        const glm::dvec3 beside(unit_ * vec3(side * section.beside.x, section.beside.y, section.beside.z));
        const glm::dvec3 point =
            glm::mix(rest.position, rest_[to].position, static_cast<double>(section.along)) + beside;
        const glm::dquat turn = bound.rotation() * glm::conjugate(rest.rotation());
        return {.at = vec3(bound.position + turn * (point - rest.position)),
                .flat = vec3(turn * glm::dvec3(flat)),
                .width = unit_ * section.width,
                .depth = unit_ * section.depth};
    }
    void chain(Group group, std::span<const FigureSection> sections, vec3 flat, float side) {
        std::vector<BodySection> all;
        for (const FigureSection& each : sections) all.push_back(placed(each, flat, side));
        field_.add_chain(group, all);
    }

    // The weights.

    /// How far a point is past a joint in direction `way`: 0 to 1 over a transition of `reach` metres.
    float past(Bone joint, vec3 way, float reach, const vec3& point) const {
        return step_between(-reach * unit_, reach * unit_, glm::dot(point - at(joint), glm::normalize(way)));
    }
    /// Divides a share along a chain of bones, from joint to joint.
    struct Joint {
        Bone bone;
        float reach;  ///< metres on a figure of 1.8 m
        vec3 way;
    };
    void share(Weights& weights, float all, Bone first, std::span<const Joint> joints,
               const vec3& point) const {
        Bone bone = first;
        for (const Joint& each : joints) {
            const float on = all * past(each.bone, each.way, each.reach, point);
            if (all > on) weights.emplace_back(bone, all - on);
            all = on, bone = each.bone;
        }
        if (all > 0.0f) weights.emplace_back(bone, all);
    }
    vec3 way(Bone from, Bone to) const { return glm::normalize(at(to) - at(from)); }

    /// `distance` is for each group.
    Weights weights(const vec3& point, const BodyField::Distances& distance) const {
        std::array<float, 5> part{};
        float limbs = 0.0f;
        for (std::size_t i = LeftArm; i <= RightLeg; ++i) {
            float rest = 1e9f;
            for (std::size_t k = 0; k < part.size(); ++k)
                if (k != i) rest = std::min(rest, distance[k]);
            // Points between a limb and the trunk, as in the armpit, belong to the trunk.
            const float from = (i <= RightArm ? -0.01f : -0.04f) * unit_, to = 0.045f * unit_;
            const bool is_arm = i <= RightArm;
            const Bone root = on(is_arm ? Bone::LeftUpperArm : Bone::LeftUpperLeg, i % 2 == 1 ? 1.0f : -1.0f);
            const auto end = static_cast<Bone>(static_cast<std::size_t>(root) + 1);
            part[i] = step_between(from, to, rest - distance[i]) *
                      past(root, way(root, end), is_arm ? 0.07f : 0.09f, point);
            limbs += part[i];
        }
        Weights all;
        const float most = std::max(limbs, 1.0f);
        for (const float side : {1.0f, -1.0f}) {
            const Bone upper_arm = on(Bone::LeftUpperArm, side), lower_arm = on(Bone::LeftLowerArm, side),
                       wrist = on(Bone::LeftHand, side);
            const vec3 upper = way(upper_arm, lower_arm), lower = way(lower_arm, wrist);
            const std::array<Joint, 2> arms{{{lower_arm, 0.045f, upper + lower}, {wrist, 0.03f, lower}}};
            share(all, part[side > 0.0f ? LeftArm : RightArm] / most, upper_arm, arms, point);
            const Bone hip = on(Bone::LeftUpperLeg, side), knee = on(Bone::LeftLowerLeg, side),
                       ankle = on(Bone::LeftFoot, side), toes = on(Bone::LeftToes, side);
            const std::array<Joint, 3> legs{{{knee, 0.06f, way(hip, knee) + way(knee, ankle)},
                                             {ankle, 0.045f, way(knee, ankle) + 0.35f * way(ankle, toes)},
                                             {toes, 0.03f, vec3(0, 0, 1)}}};
            share(all, part[side > 0.0f ? LeftLeg : RightLeg] / most, hip, legs, point);
        }
        share_trunk(all, 1.0f - limbs / most, point);
        return merged(all);
    }
    void share_trunk(Weights& all, float trunk_part, const vec3& point) const {
        if (!(trunk_part > 0.0f)) return;
        const vec3 up(0, 1, 0);
        for (const float side : {1.0f, -1.0f}) {
            const vec3 arm_at = at(on(Bone::LeftUpperArm, side)), chest = at(Bone::UpperChest);
            const float out = step_between(0.3f, 1.0f, (point.x - chest.x) / (arm_at.x - chest.x));
            const float high = step_between(arm_at.y - 0.16f * unit_, arm_at.y - 0.04f * unit_, point.y) *
                               step_between(arm_at.y + 0.14f * unit_, arm_at.y + 0.08f * unit_, point.y);
            const float share = trunk_part * out * high;
            if (share > 0.0f) all.emplace_back(on(Bone::LeftShoulder, side), share);
            trunk_part -= share;
        }
        const std::array<Joint, 5> spine{{{Bone::Spine, 0.06f, up},
                                          {Bone::Chest, 0.06f, up},
                                          {Bone::UpperChest, 0.07f, up},
                                          {Bone::Neck, 0.045f, up},
                                          {Bone::Head, 0.03f, vec3(0, 1, 0.5f)}}};
        share(all, trunk_part, Bone::Hips, spine, point);
    }
    static Weights merged(const Weights& all) {
        Weights sums;
        for (const auto& [bone, weight] : all) {
            const Bone wanted = bone;
            const auto same = std::ranges::find(sums, wanted, &Weights::value_type::first);
            if (same == sums.end())
                sums.emplace_back(bone, weight);
            else
                same->second += weight;
        }
        return sums;
    }

    std::array<std::size_t, humanoid::bone_count> nodes_{};
    std::vector<Placement> rest_{}, bound_{};
    float unit_ = 1.0f, sole_ = 0.0f;
    bool complete_ = false;
    BodyField field_{};
};

}  // namespace

Skin figure_body(const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map) {
    return FigureBody(skeleton, map).made();
}

}  // namespace tendril::app
