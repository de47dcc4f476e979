// A clip played on another skeleton: limbs point where the source's do, hips move in proportion.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <tendril/humanoid/attach.hpp>
#include <tendril/humanoid/retarget.hpp>
#include <tendril/humanoid/t_pose.hpp>

#include "tests/core/humanoid_figure.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

struct RetargetFigure {
    Skeleton skeleton;
    BoneMap map;

    std::vector<Placement> at(const Clip& clip, double time) const {
        std::vector<rig::Transform> pose(skeleton.size());
        sample(clip, skeleton, time, pose);
        return placed(pose);
    }
    std::vector<Placement> placed(const std::vector<rig::Transform>& pose) const {
        std::vector<Placement> result(skeleton.size());
        place(skeleton, pose, result);
        return result;
    }
    const Placement& of(const std::vector<Placement>& all, Bone bone) const {
        return all[static_cast<std::size_t>(map[bone].node)];
    }
    double leg() const {
        const auto all = placed(t_pose(skeleton, map));
        return of(all, Bone::Hips).position.y -
               std::min(of(all, Bone::LeftFoot).position.y, of(all, Bone::RightFoot).position.y);
    }
};

class RetargetDice {
  public:
    explicit RetargetDice(unsigned seed) : engine_(seed) {}
    double from(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
    glm::dquat turn(double most) {
        const glm::dvec3 axis(from(-1, 1), from(-1, 1), from(-1, 1));
        return glm::angleAxis(from(-most, most), glm::normalize(axis + glm::dvec3(0, 0, 1e-3)));
    }

  private:
    std::mt19937 engine_;
};

/// Limbs of any length, in a rest pose and with axes of their own, turned about Y, with some bones missing.
RetargetFigure random_body(RetargetDice& random, bool has_extras) {
    std::vector<Node> nodes{{"root", -1, {.rotation = random.turn(3.0)}}};
    RetargetFigure body;
    std::vector<Placement> placed{placement(nodes[0].rest)};
    std::map<std::string, std::size_t> index;
    const double size = random.from(0.3, 3.0), angle = random.from(-3.0, 3.0);
    const glm::dquat about = glm::angleAxis(angle, glm::dvec3(0, 1, 0));
    for (const FigureNode& each : figure_nodes()) {
        std::string parent = each.parent;
        const std::string key = each.key;
        const bool extra =
            key == "UpperChest" || key == "LeftShoulder" || key == "RightShoulder" || key == "Neck";
        if (extra && !has_extras) continue;
        const auto pose_of = [&](const std::string& name) {
            for (const FigureNode& other : figure_nodes())
                if (other.key == name) return other;
            return each;
        };
        while (!parent.empty() && !index.contains(parent)) parent = pose_of(parent).parent;
        const std::size_t above = parent.empty() ? 0 : index.at(parent);
        const glm::dvec3 from = parent.empty() ? glm::dvec3(0.0) : pose_of(parent).at;
        glm::dvec3 way = about * (each.at - from) * size;
        if (key.find("Arm") != key.npos || key.find("Leg") != key.npos || key.find("Hand") != key.npos ||
            key.find("Foot") != key.npos)
            way = random.turn(0.3) * way * random.from(0.7, 1.4);
        const glm::dvec3 at = parent.empty() ? way : placed[above].position + way;
        const Placement global = placement({.translation = at, .rotation = random.turn(3.0)});
        nodes.push_back({key, static_cast<std::int32_t>(above), relative(placed[above], global)});
        placed.push_back(global);
        index[key] = nodes.size() - 1;
    }
    body.skeleton = *Skeleton::make(std::move(nodes));
    for (std::size_t i = 0; i < bone_count; ++i)
        if (const auto node = body.skeleton.find(humanoid::name(static_cast<Bone>(i))))
            body.map.bones[i] = {static_cast<std::int32_t>(*node), 1.0, "by name"};
    review(body.map, body.skeleton);
    return body;
}

/// The same body, whose left foot was a child of the root in its file (attach.hpp).
RetargetFigure with_loose_foot(RetargetFigure body) {
    const std::size_t foot = static_cast<std::size_t>(body.map[Bone::LeftFoot].node);
    std::vector<Node> nodes = body.skeleton.nodes();
    const auto rest = body.placed(rest_pose(body.skeleton));
    const auto leg = static_cast<std::size_t>(nodes[foot].parent);
    nodes[foot].parent = 0;
    nodes[foot].rest = relative(rest[0], rest[foot]);
    body.skeleton = *attached(*Skeleton::make(std::move(nodes)), foot, leg);
    return body;
}

Clip random_clip(RetargetDice& random, const RetargetFigure& body) {
    Clip clip{.name = "any", .duration = 1.0, .channels = {}};
    for (std::size_t node = 0; node < body.skeleton.size(); ++node) {
        Channel channel{.node = node};
        const rig::Transform& rest = body.skeleton[node].rest;
        for (const double time : {0.0, 0.31, 1.0}) {
            channel.rotation.times.push_back(time);
            channel.rotation.values.push_back(glm::normalize(rest.rotation * random.turn(0.8)));
            if (body.map[Bone::Hips].node != static_cast<std::int32_t>(node)) continue;
            channel.translation.times.push_back(time);
            channel.translation.values.push_back(
                rest.translation + glm::dvec3(random.from(-1, 1), random.from(-1, 1), random.from(-1, 1)));
        }
        clip.channels.push_back(std::move(channel));
    }
    return clip;
}

/// Takes x, y, z to the body's left, up and forward.
glm::dmat3 frame_of(const RetargetFigure& body) {
    const Facing at = facing(body.skeleton, body.map);
    return {glm::cross(at.up, at.forward), at.up, at.forward};
}

TEST(HumanoidRetarget, limbs_point_where_those_of_the_source_do_and_hips_move_in_proportion) {
    constexpr std::pair<Bone, Bone> limbs[]{
        {Bone::LeftUpperArm, Bone::LeftLowerArm},   {Bone::LeftLowerArm, Bone::LeftHand},
        {Bone::RightUpperArm, Bone::RightLowerArm}, {Bone::RightLowerArm, Bone::RightHand},
        {Bone::LeftUpperLeg, Bone::LeftLowerLeg},   {Bone::LeftLowerLeg, Bone::LeftFoot},
        {Bone::RightUpperLeg, Bone::RightLowerLeg}, {Bone::RightLowerLeg, Bone::RightFoot}};
    RetargetDice random(7);
    for (int i = 0; i < 60; ++i) {
        const RetargetFigure from = random_body(random, i % 2 == 0), plain = random_body(random, i % 3 == 0),
                             to = i % 4 == 1 ? with_loose_foot(plain) : plain;
        const Clip clip = random_clip(random, from);
        ASSERT_TRUE(check(clip, from.skeleton));
        const auto made = retarget({from.skeleton, from.map}, clip, {to.skeleton, to.map});
        ASSERT_TRUE(made) << made.message();
        ASSERT_TRUE(check(made->clip, to.skeleton));
        EXPECT_NEAR(made->scale, to.leg() / from.leg(), 1e-9);
        const glm::dmat3 turn = frame_of(to) * glm::transpose(frame_of(from));
        const auto rest_from = from.placed(rest_pose(from.skeleton)),
                   rest_to = to.placed(rest_pose(to.skeleton));
        for (const double time : {0.0, 1.0 / 60.0, 0.31, 0.5, 1.0}) {
            const auto was = from.at(clip, time), now = to.at(made->clip, time);
            for (const std::pair<Bone, Bone>& limb : limbs) {
                const Bone upper = limb.first, lower = limb.second;
                const auto direction = [&](const RetargetFigure& body, const std::vector<Placement>& all) {
                    return glm::normalize(body.of(all, lower).position - body.of(all, upper).position);
                };
                EXPECT_LT(glm::distance(turn * direction(from, was), direction(to, now)), 1e-6)
                    << i << ' ' << humanoid::name(upper) << " at " << time;
            }
            const auto moved = [](const RetargetFigure& body, const std::vector<Placement>& all,
                                  const std::vector<Placement>& rest) {
                return body.of(all, Bone::Hips).position - body.of(rest, Bone::Hips).position;
            };
            EXPECT_LT(
                glm::distance(turn * moved(from, was, rest_from) * made->scale, moved(to, now, rest_to)),
                1e-6);
        }
    }
}

TEST(HumanoidRetarget, on_the_same_skeleton_it_is_the_same_motion) {
    RetargetDice random(3);
    const RetargetFigure body = random_body(random, true);
    const Clip clip = random_clip(random, body);
    const auto made = retarget({body.skeleton, body.map}, clip, {body.skeleton, body.map});
    ASSERT_TRUE(made);
    EXPECT_TRUE(made->left_out.empty() && made->at_rest.empty());
    // But for the root, which is no bone: what it does the hips do.
    for (const double time : {0.0, 0.31, 1.0}) {
        const auto was = body.at(clip, time), now = body.at(made->clip, time);
        for (std::size_t i = 0; i < bone_count; ++i)
            EXPECT_LT(glm::distance(body.of(was, static_cast<Bone>(i)).position,
                                    body.of(now, static_cast<Bone>(i)).position),
                      1e-6);
    }
}

TEST(HumanoidRetarget, it_says_which_bones_only_one_of_them_has) {
    RetargetDice random(5);
    const RetargetFigure full = random_body(random, true), plain = random_body(random, false);
    const Clip clip = random_clip(random, full);
    const std::vector<Bone> extras{Bone::UpperChest, Bone::Neck, Bone::LeftShoulder, Bone::RightShoulder};
    EXPECT_EQ(retarget({full.skeleton, full.map}, clip, {plain.skeleton, plain.map})->left_out, extras);
    const Clip back = random_clip(random, plain);
    const auto made = retarget({plain.skeleton, plain.map}, back, {full.skeleton, full.map});
    EXPECT_EQ(made->at_rest, extras);
    for (const Channel& each : made->clip.channels) EXPECT_NE(full.skeleton[each.node].name, "Neck");
}

TEST(HumanoidRetarget, what_does_not_fit_is_refused) {
    RetargetDice random(9);
    const RetargetFigure body = random_body(random, true);
    const Clip clip = random_clip(random, body);
    BoneMap none;
    const auto said = [&](const BoneMap& from, const Clip& of, const BoneMap& to) {
        return std::string(retarget({body.skeleton, from}, of, {body.skeleton, to}).message());
    };
    EXPECT_TRUE(says(said(none, clip, body.map), "retarget from.map Hips"));
    EXPECT_TRUE(says(said(body.map, clip, none), "retarget to.map Hips"));
    BoneMap twice = body.map;
    twice[Bone::Spine].node = twice[Bone::Head].node;
    EXPECT_NE(said(twice, clip, body.map), "");
    Clip bad = clip;
    bad.channels[0].node = 1000;
    EXPECT_NE(said(body.map, bad, body.map), "");
    Clip endless = clip;
    endless.duration = 1e6;
    EXPECT_TRUE(says(said(body.map, endless, body.map), "retarget clip 100000"));
}

}  // namespace
}  // namespace tendril::test
