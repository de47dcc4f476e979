// Twist distribution along the arms: the measure of twist, and the nodes that share it.
#include <gtest/gtest.h>

#include <tendril/humanoid/body.hpp>
#include <tendril/humanoid/hands.hpp>
#include <tendril/humanoid/twist.hpp>

#include "humanoid_figure.hpp"

namespace tendril::test {
namespace {

constexpr double one_degree = 3.14159265358979323846 / 180.0;
const glm::dvec3 along{1.0, 0.0, 0.0};

/// The figure with extra nodes on its left arm: halfway along the lower arm and, below that, at its end; a
/// quarter along the upper arm; and one of another name.
Skeleton with_twist_nodes() {
    std::vector<Node> nodes = make_figure({}).nodes();
    const auto add = [&](const char* name, const char* parent, glm::dvec3 at) {
        Node node{name, -1, {}};
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (nodes[i].name == parent) node.parent = static_cast<std::int32_t>(i);
        node.rest.translation = at;
        nodes.push_back(node);
    };
    add("lowerarm_twist_01_l", "LeftLowerArm", {0.13, 0.0, 0.0});
    add("lowerarm_twist_02_l", "lowerarm_twist_01_l", {0.13, 0.0, 0.0});
    add("upperarm_twist_01_l", "LeftUpperArm", {0.07, 0.0, 0.0});
    add("elbow_pad_l", "LeftLowerArm", {0.05, 0.0, -0.05});
    // A rest rotation about an axis other than the bone's.
    nodes.back().rest.rotation = nodes[nodes.size() - 2].rest.rotation =
        glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.3, 1.0, 0.2)));
    return *Skeleton::make(nodes);
}

class HumanoidTwist : public testing::Test {
  protected:
    std::size_t node(const char* name) const { return *skeleton.find(name); }
    /// Rotation of a node about the arm from rest, in the character's space, degrees.
    double turned(const std::vector<rig::Transform>& pose, const char* name) const {
        std::vector<Placement> before(skeleton.size()), now(skeleton.size());
        place(skeleton, rest, before);
        place(skeleton, pose, now);
        return twist_about(along,
                           now[node(name)].rotation() * glm::conjugate(before[node(name)].rotation())) /
               one_degree;
    }

    Skeleton skeleton = with_twist_nodes();
    BoneMap map = match_bones(skeleton);
    std::vector<rig::Transform> rest = rest_pose(skeleton);
    TwistNodes nodes = TwistNodes::find(skeleton, map);
};

TEST(HumanoidTwistAngle, IsTheRotationAboutTheAxisBeforeTheSwing) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const double x = any(engine), y = any(engine), z = any(engine), part = any(engine);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(x, y, z));
        const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(z, x, y + 2.0)));
        const double twist = 179.9 * one_degree * part, swing = 159.0 * one_degree * any(engine);
        const glm::dquat turn = glm::angleAxis(swing, across) * glm::angleAxis(twist, axis);
        EXPECT_NEAR(twist_about(axis, turn), twist, 1e-9);
        EXPECT_NEAR(twist_about(axis, -turn), twist, 1e-9) << "the same rotation";
        EXPECT_NEAR(twist_about(axis, glm::conjugate(turn)), -twist, 1e-9);
    }
}

TEST(HumanoidTwistAngle, FadesOutAsTheSwingNearsHalfATurn) {
    double last = 0.0;
    for (int i = 0; i <= 18000; ++i) {
        const glm::dquat turn =
            glm::angleAxis(i * 0.01 * one_degree, glm::dvec3(0.0, 1.0, 0.0)) * glm::angleAxis(2.0, along);
        const double now = twist_about(along, turn);
        ASSERT_TRUE(std::isfinite(now));
        if (i > 0) {
            ASSERT_LT(std::abs(now - last), 0.01 * one_degree * 15.0) << i;
        }
        last = now;
    }
    EXPECT_NEAR(last, 0.0, 1e-9);
}

TEST_F(HumanoidTwist, FindsOnlyTwistNodesBelowAnArm) {
    EXPECT_EQ(nodes.along(Bone::LeftLowerArm),
              (std::vector{node("lowerarm_twist_01_l"), node("lowerarm_twist_02_l")}));
    EXPECT_EQ(nodes.along(Bone::LeftUpperArm), (std::vector{node("upperarm_twist_01_l")}));
    EXPECT_TRUE(nodes.along(Bone::RightLowerArm).empty());
    EXPECT_TRUE(TwistNodes::find(make_figure({}), match_bones(make_figure({}))).empty());
    for (const char* other : {"Controller_l", "strollers", "Twin", "LeftForeArm"}) {
        std::vector<Node> renamed = skeleton.nodes();
        renamed[node("elbow_pad_l")].name = other;
        const Skeleton figure = *Skeleton::make(renamed);
        EXPECT_EQ(TwistNodes::find(figure, map).along(Bone::LeftLowerArm).size(), 2u) << other;
    }
    for (const char* name : {"LeftForeArmRoll", "Bip01 L ForeTwist", "lowerarm_l_twist2", "forearmtwist"}) {
        std::vector<Node> renamed = skeleton.nodes();
        renamed[node("elbow_pad_l")].name = name;
        const Skeleton figure = *Skeleton::make(renamed);
        EXPECT_EQ(TwistNodes::find(figure, map).along(Bone::LeftLowerArm).size(), 3u) << name;
    }
}

TEST_F(HumanoidTwist, NodesTurnByTheirPlaceAlongTheBone) {
    auto pose = rest;
    const auto before = nodes.turns(pose);
    pose[node("LeftHand")].rotation = glm::angleAxis(170.0 * one_degree, along);
    pose[node("LeftUpperArm")].rotation = glm::angleAxis(80.0 * one_degree, along);
    nodes.follow(before, pose);
    EXPECT_NEAR(turned(pose, "upperarm_twist_01_l"), 20.0, 1e-9);
    EXPECT_NEAR(turned(pose, "LeftLowerArm"), 80.0, 1e-9);
    EXPECT_NEAR(turned(pose, "lowerarm_twist_01_l"), 80.0 + 85.0, 1e-9);
    EXPECT_NEAR(turned(pose, "lowerarm_twist_02_l"), -110.0, 1e-9) << "80 and 170, the short way";
    EXPECT_EQ(pose[node("elbow_pad_l")], rest[node("elbow_pad_l")]);
}

TEST_F(HumanoidTwist, WithoutTwistThePoseKeepsItsBits) {
    std::mt19937 engine(6);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        auto pose = rest;
        for (rig::Transform& each : pose) {
            const double x = any(engine), y = any(engine), z = any(engine), w = any(engine);
            each.rotation = glm::normalize(glm::dquat(w, x, y, z));
        }
        const auto same = pose;
        nodes.follow(nodes.turns(pose), pose);
        EXPECT_EQ(pose, same);
        nodes.follow(TwistNodes::ArmTurns{}, pose);
        for (const rig::Transform& each : pose) EXPECT_NEAR(glm::length(each.rotation), 1.0, 1e-12);
    }
}

TEST_F(HumanoidTwist, ABodyTurnsTwistNodesWithTheHand) {
    Body body = *Body::make(skeleton, map);
    BodyState state;
    auto pose = rest;
    const glm::dquat wanted = glm::angleAxis(170.0 * one_degree, along);
    const std::vector<BodyTarget> targets{{Effector::LeftHand, {0.72, 1.45, 0.0}, wanted}};
    for (int i = 0; i < 20; ++i) {
        pose = rest;
        ASSERT_TRUE(body.solve(pose, targets, state));
    }
    EXPECT_NEAR(turned(pose, "LeftHand"), 170.0, 0.1);
    EXPECT_NEAR(turned(pose, "LeftLowerArm"), 85.0, 0.1) << "the bone's own share";
    EXPECT_NEAR(turned(pose, "lowerarm_twist_01_l"), 85.0, 0.1) << "half way";
    EXPECT_NEAR(turned(pose, "lowerarm_twist_02_l"), 170.0, 0.1) << "at the wrist";
}

TEST_F(HumanoidTwist, HandIkTurnsTwistNodesToo) {
    const Hands hands = *Hands::make(skeleton, map);
    HandsState state;
    auto pose = rest;
    HandTargets targets{};
    targets[0] = {
        .position = {0.718, 1.45, 0.0}, .rotation = glm::angleAxis(120.0 * one_degree, along), .weight = 1.0};
    for (int i = 0; i < 300; ++i) {
        pose = rest;
        ASSERT_TRUE(hands.step(pose, targets, 1.0 / 60.0, state, {.view = 3.14}).accepted);
    }
    EXPECT_NEAR(turned(pose, "LeftHand"), 120.0, 1.0);
    EXPECT_NEAR(turned(pose, "lowerarm_twist_01_l"), 60.0, 3.0);
    EXPECT_NEAR(turned(pose, "lowerarm_twist_02_l"), 120.0, 3.0);
}

}  // namespace
}  // namespace tendril::test
