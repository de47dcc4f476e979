// Joint limits of a body: the T-pose they refer to, the defaults, and limits learned from clips.
#include <gtest/gtest.h>

#include <tendril/humanoid/limits.hpp>

#include "humanoid_figure.hpp"

namespace tendril::test {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

class HumanoidLimits : public testing::Test, protected Figured {
  protected:
    ik::JointAngles angles(Bone bone, const glm::dquat& turn) {
        auto pose = rest;
        pose[node(bone)].rotation = turn;
        return joints.measure(bone, placed(pose));
    }
    float excess(Bone bone, double degrees, const glm::dvec3& axis) {
        auto pose = rest;
        pose[node(bone)].rotation = glm::angleAxis(degrees * degree, axis);
        return joints.excess(bone, placed(pose)) / static_cast<float>(degree);
    }

    BodyLimits limits = default_limits(skeleton, map);
    BodyJoints joints = *BodyJoints::make(skeleton, map, limits);
    std::vector<Placement> placements = std::vector<Placement>(skeleton.size());
};

TEST_F(HumanoidLimits, TheFigureFacesForward) {
    const Facing at = facing(skeleton, map);
    EXPECT_NEAR(at.left.x, 1.0, 1e-12);
    EXPECT_NEAR(at.forward.z, 1.0, 1e-12);
    const Skeleton turned = make_figure({}, 0.5 * 3.14159265358979323846);
    EXPECT_NEAR(facing(turned, match_bones(turned)).forward.x, 1.0, 1e-12);
}

TEST_F(HumanoidLimits, AnAPoseIsTurnedIntoATPose) {
    // At rest, the arms hang 40 degrees down and the feet turn outward.
    std::vector<Node> nodes = skeleton.nodes();
    nodes[node(Bone::LeftUpperArm)].rest.rotation = glm::angleAxis(-40.0 * degree, glm::dvec3(0, 0, 1));
    nodes[node(Bone::RightUpperArm)].rest.rotation = glm::angleAxis(40.0 * degree, glm::dvec3(0, 0, 1));
    nodes[node(Bone::LeftFoot)].rest.rotation = glm::angleAxis(10.0 * degree, glm::dvec3(0, 1, 0));
    const Skeleton resting = *Skeleton::make(nodes);
    const BoneMap mapped = match_bones(resting);
    EXPECT_EQ(mapped.rest, RestPose::A);
    const auto pose = t_pose(resting, mapped);
    place(resting, pose, placements);
    const auto at = [&](Bone bone) { return placements[node(bone)].position; };
    EXPECT_NEAR(at(Bone::LeftHand).y, at(Bone::LeftUpperArm).y, 1e-9);
    EXPECT_NEAR(at(Bone::RightHand).y, at(Bone::RightUpperArm).y, 1e-9);
    EXPECT_NEAR(at(Bone::LeftFoot).x, at(Bone::LeftUpperLeg).x, 1e-9);
    const glm::dquat foot = placements[node(Bone::LeftFoot)].rotation();
    EXPECT_NEAR(2.0 * std::asin(foot.y), 10.0 * degree, 1e-9);  // as at rest
    // Angles are relative to the T-pose: at rest the arms are 40 degrees down.
    const BodyJoints its = *BodyJoints::make(resting, mapped, default_limits(resting, mapped));
    place(resting, rest_pose(resting), placements);
    EXPECT_NEAR(its.measure(Bone::LeftUpperArm, placements).up, -40.0 * degree, 1e-5);
    EXPECT_NEAR(its.measure(Bone::RightUpperArm, placements).up, -40.0 * degree, 1e-5);
    EXPECT_EQ(its.excess(Bone::LeftUpperArm, placements), 0.0f);
}

/// A bind pose in mid-run: one leg is kicked back, its sole facing up.
TEST_F(HumanoidLimits, AFootOffTheGroundAtRestIsMeasuredFromStanding) {
    for (const double kicked : {100.0, 130.0, 160.0}) {
        std::vector<Node> nodes = skeleton.nodes();
        nodes[node(Bone::RightLowerLeg)].rest.rotation = glm::angleAxis(kicked * degree, glm::dvec3(1, 0, 0));
        const Skeleton running = *Skeleton::make(nodes);
        const BodyJoints its = *BodyJoints::make(running, map, default_limits(running, map));
        // Standing, both feet are in the middle of their range. The other leg is not quite straight.
        place(running, rest_pose(skeleton), placements);
        const ik::JointAngles right = its.measure(Bone::RightFoot, placements);
        EXPECT_NEAR(right.up, its.measure(Bone::LeftFoot, placements).up, 2.0 * degree) << kicked;
        EXPECT_NEAR(right.up, 0.0, 2.0 * degree) << kicked;
        EXPECT_NEAR(right.left, 0.0, 1.0 * degree) << kicked;
        EXPECT_NEAR(right.twist, 0.0, 1.0 * degree) << kicked;
        EXPECT_LT(its.excess(Bone::RightFoot, placements), 1e-6) << kicked;
    }
}

/// Elbows and knees slightly overstretched at rest bend about the usual axes.
TEST_F(HumanoidLimits, AnOverstretchedRestDoesNotReverseAHinge) {
    std::vector<Node> nodes = skeleton.nodes();
    const double by = 8.0 * degree;
    nodes[node(Bone::LeftLowerArm)].rest.rotation = glm::angleAxis(by, glm::dvec3(0, 1, 0));
    nodes[node(Bone::RightLowerArm)].rest.rotation = glm::angleAxis(-by, glm::dvec3(0, 1, 0));
    nodes[node(Bone::LeftLowerLeg)].rest.rotation = glm::angleAxis(-by, glm::dvec3(1, 0, 0));
    const Skeleton stretched = *Skeleton::make(nodes);
    const BodyLimits its = default_limits(stretched, map);
    for (const Bone bone : {Bone::LeftLowerArm, Bone::RightLowerArm, Bone::LeftLowerLeg}) {
        const glm::vec3 axis = its[static_cast<std::size_t>(bone)].axis,
                        usual = limits[static_cast<std::size_t>(bone)].axis;
        EXPECT_GT(glm::dot(glm::normalize(axis), glm::normalize(usual)), 0.9f) << name(bone);
    }
}

TEST_F(HumanoidLimits, BothSidesTurnAlike) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (std::size_t i = 0; i < bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        if (mirrored(bone) == bone) continue;
        for (int n = 0; n < 50; ++n) {
            const double x = any(engine), y = any(engine), z = any(engine);
            const glm::dquat turn = glm::normalize(glm::dquat(1.0, x, y, z));
            const glm::dquat other(turn.w, turn.x, -turn.y, -turn.z);  // mirrored at x = 0
            const auto measured = [&](Bone each, const glm::dquat& by) {
                auto pose = rest_pose(skeleton);
                pose[node(each)].rotation = by;
                return joints.excess(each, placed(pose));
            };
            EXPECT_NEAR(measured(bone, turn), measured(mirrored(bone), other), 1e-5) << name(bone);
        }
    }
}

/// Knees, thighs and spine bend the same way if the map swaps left and right.
TEST_F(HumanoidLimits, SwappedSidesBendTheSameWay) {
    BoneMap exchanged = map;
    for (std::size_t i = 0; i < bone_count; ++i) exchanged.bones[i] = map[mirrored(static_cast<Bone>(i))];
    review(exchanged, skeleton);
    const BodyLimits usual = default_limits(skeleton, map), other = default_limits(skeleton, exchanged);
    for (std::size_t i = 0; i < bone_count; ++i) {
        const ik::Limit& a = usual[static_cast<std::size_t>(mirrored(static_cast<Bone>(i)))];
        EXPECT_TRUE(a == other[i]) << name(static_cast<Bone>(i)) << " is the same node in both";
    }
}

/// A very short shoulder bone is no collar bone: the whole arm turns there.
TEST_F(HumanoidLimits, AShoulderStubTurnsAsTheArmDoes) {
    EXPECT_GT(excess(Bone::LeftShoulder, 70.0, {0, 0, -1}), 45.0f);
    std::vector<Node> nodes = skeleton.nodes();
    for (const Bone bone : {Bone::LeftShoulder, Bone::RightShoulder}) {
        const std::size_t arm = node(bone == Bone::LeftShoulder ? Bone::LeftUpperArm : Bone::RightUpperArm);
        nodes[node(bone)].rest.translation += nodes[arm].rest.translation * 0.8;
        nodes[arm].rest.translation *= 0.2;
    }
    skeleton = *Skeleton::make(nodes);
    joints = *BodyJoints::make(skeleton, map, default_limits(skeleton, map));
    EXPECT_EQ(excess(Bone::LeftShoulder, 70.0, {0, 0, -1}), 0.0f);
    EXPECT_EQ(excess(Bone::RightShoulder, 70.0, {0, 0, 1}), 0.0f);
    EXPECT_GT(excess(Bone::LeftShoulder, 80.0, {0, 1, 0}), 20.0f) << "not to the back, as no arm does";
}

TEST_F(HumanoidLimits, JointsBendAsInPeople) {
    EXPECT_EQ(excess(Bone::LeftLowerArm, 100.0, {0, -1, 0}), 0.0f);  // the hand forward
    EXPECT_NEAR(excess(Bone::LeftLowerArm, 20.0, {0, 1, 0}), 20.0f, 1e-2);
    EXPECT_NEAR(excess(Bone::LeftLowerArm, 160.0, {0, -1, 0}), 10.0f, 1e-2);
    EXPECT_EQ(excess(Bone::RightLowerArm, 100.0, {0, 1, 0}), 0.0f);
    EXPECT_EQ(excess(Bone::LeftLowerLeg, 100.0, {1, 0, 0}), 0.0f);           // the heel back
    EXPECT_NEAR(excess(Bone::LeftLowerLeg, 20.0, {-1, 0, 0}), 17.3f, 0.1f);  // the knees rest bent by 2.7
    EXPECT_EQ(excess(Bone::LeftUpperLeg, 100.0, {-1, 0, 0}), 0.0f);          // the knee up
    EXPECT_NEAR(excess(Bone::LeftUpperLeg, 60.0, {1, 0, 0}), 28.6f, 0.1f);
    EXPECT_EQ(excess(Bone::LeftUpperArm, 90.0, {0, 0, 1}), 0.0f);           // the arm up
    EXPECT_EQ(excess(Bone::LeftUpperArm, 120.0, {0, -1, 0}), 0.0f);         // to the front
    EXPECT_NEAR(excess(Bone::LeftUpperArm, 80.0, {0, 1, 0}), 30.0f, 1e-1);  // to the back
    EXPECT_EQ(excess(Bone::Hips, 170.0, {0, 1, 0}), 0.0f);
    EXPECT_NEAR(angles(Bone::LeftLowerArm, glm::angleAxis(1.0, glm::dvec3(0, -1, 0))).up, 1.0, 1e-5);
}

TEST_F(HumanoidLimits, AHingeLimitsOnlyItsOwnAxis) {
    EXPECT_EQ(excess(Bone::LeftLowerArm, 50.0, {1, 0, 0}), 0.0f);
}

TEST_F(HumanoidLimits, AnElbowBentAtRestBendsAboutThatAxis) {
    std::vector<Node> nodes = skeleton.nodes();
    // Bent upwards by 20 degrees at rest.
    nodes[node(Bone::LeftLowerArm)].rest.rotation = glm::angleAxis(20.0 * degree, glm::dvec3(0, 0, 1));
    const Skeleton bent = *Skeleton::make(nodes);
    const BodyLimits its = default_limits(bent, match_bones(bent));
    const glm::vec3 axis = its[static_cast<std::size_t>(Bone::LeftLowerArm)].axis;
    EXPECT_NEAR(axis.z, 1.0f, 1e-3f);
    const glm::vec3 straight = limits[static_cast<std::size_t>(Bone::LeftLowerArm)].axis;
    EXPECT_NEAR(straight.y, -1.0f, 1e-6f);
}

TEST_F(HumanoidLimits, LearnedLimitsHoldTheClipAndLittleMore) {
    Clip clip{"swing", 2.0, {}};
    Channel arm{node(Bone::LeftUpperArm)}, elbow{node(Bone::LeftLowerArm)}, other{node(Bone::RightUpperArm)};
    for (int i = 0; i <= 8; ++i) {
        const double time = 0.25 * i, phase = 2.0 * 3.14159265358979323846 * i / 8.0;
        const glm::dvec3 turn{0.0, 0.3 * std::cos(phase), 0.5 * std::sin(phase)};
        arm.rotation.times.push_back(time), elbow.rotation.times.push_back(time);
        arm.rotation.values.push_back(glm::angleAxis(glm::length(turn), glm::normalize(turn)));
        elbow.rotation.values.push_back(glm::angleAxis(0.4 + 0.3 * std::sin(phase), glm::dvec3(0, -1, 0)));
        other.rotation.times.push_back(time);
        other.rotation.values.push_back(glm::angleAxis(0.4 + 0.1 * std::sin(phase), glm::dvec3(1, 0, 0)));
    }
    clip.channels = {arm, elbow, other};
    ASSERT_TRUE(check(clip, skeleton)) << check(clip, skeleton).message();
    const std::vector<Clip> clips{clip};
    const BodyLimits learned = learned_limits(skeleton, map, clips, limits);
    const BodyJoints its = *BodyJoints::make(skeleton, map, learned);
    auto pose = rest_pose(skeleton);
    for (int frame = 0; frame <= 120; ++frame) {
        sample(clip, skeleton, frame / 60.0, pose);
        place(skeleton, pose, placements);
        for (std::size_t i = 0; i < bone_count; ++i)
            EXPECT_EQ(its.excess(static_cast<Bone>(i), placements), 0.0f) << frame;
    }
    const ik::Limit& of_elbow = learned[static_cast<std::size_t>(Bone::LeftLowerArm)];
    EXPECT_NEAR(of_elbow.min, 0.1 - degree, 2e-3);
    EXPECT_NEAR(of_elbow.max, 0.7 + degree, 2e-3);
    const ik::Limit& of_arm = learned[static_cast<std::size_t>(Bone::LeftUpperArm)];
    EXPECT_NEAR(of_arm.up, 0.5, 0.06);
    EXPECT_NEAR(of_arm.left, 0.3, 0.05);
    EXPECT_LT(of_arm.twist_max - of_arm.twist_min, 0.1);
    const ik::Limit& of_other = learned[static_cast<std::size_t>(Bone::RightUpperArm)];
    EXPECT_GT(std::min(std::abs(of_other.twist_min), std::abs(of_other.twist_max)), 0.25);
    // A joint that no clip turns keeps its default limit.
    EXPECT_EQ(learned[static_cast<std::size_t>(Bone::Neck)], limits[static_cast<std::size_t>(Bone::Neck)]);
}

TEST_F(HumanoidLimits, AnInvalidLimitIsRefusedByItsBonesName) {
    BodyLimits bad = limits;
    bad[static_cast<std::size_t>(Bone::LeftLowerArm)].min = 3.0f;
    const auto made = BodyJoints::make(skeleton, map, bad);
    ASSERT_FALSE(made);
    EXPECT_EQ(std::string(made.message()).find("LeftLowerArm: "), 0u) << made.message();
}

}  // namespace
}  // namespace tendril::test
