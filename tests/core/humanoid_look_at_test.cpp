// The head looks at its target within the limits of its bones, and returns to the clip if it cannot.
#include <tendril/humanoid/look_at.hpp>

#include "humanoid_figure.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

class HeadLook : public ::testing::Test, protected Figured {
  protected:
    /// The rotation of a bone from its rest pose, radians.
    double turned(const std::vector<rig::Transform>& made, Bone bone) const {
        return 2.0 * std::acos(std::min(1.0, std::abs(made[node(bone)].rotation.w)));
    }
    /// Angle between the gaze and the target, radians.
    double left(const std::vector<rig::Transform>& made, const glm::dvec3& target) const {
        const Placement head = placed(made)[node(Bone::Head)];
        const glm::dvec3 gaze = head.rotation() * glm::dvec3(0, 0, 1);
        return std::acos(std::min(1.0, glm::dot(gaze, glm::normalize(target - head.position))));
    }

    RandomPoses number{13};
    const LookAt look = *LookAt::make(skeleton, map);
};

TEST_F(HeadLook, ReachesTheTargetSpreadOverTheBones) {
    for (int round = 0; round < 500; ++round) {
        const double yaw = number(-1.0, 1.0), pitch = number(-0.5, 0.5);
        const glm::dvec3 way(std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                             std::cos(yaw) * std::cos(pitch));
        const glm::dvec3 target = glm::dvec3(0, 1.6, 0) + way * number(1.0, 10.0);
        std::vector<rig::Transform> made = rest_pose(skeleton);
        LookAtState state;
        const LookAtReport report = look.step(made, {.target = target}, 1.0 / 60, state);
        ASSERT_TRUE(report.accepted);
        EXPECT_LT(left(made, target), 1e-6);
        EXPECT_LT(report.left, 1e-6);
        if (std::abs(yaw) < 0.5) continue;
        EXPECT_GT(turned(made, Bone::Spine), 0.02);
        EXPECT_GT(turned(made, Bone::Neck), turned(made, Bone::Spine));
        EXPECT_GT(turned(made, Bone::Head), turned(made, Bone::Neck));
    }
}

TEST_F(HeadLook, StaysWithinItsLimits) {
    for (int round = 0; round < 500; ++round) {
        const glm::dvec3 target(number(-5, 5), number(-5, 5), number(-5, 5));
        std::vector<rig::Transform> made = rest_pose(skeleton);
        LookAtState state;
        const LookAtOptions options{
            .target = target, .spine_limit = 0.2, .neck_limit = 0.3, .head_limit = 0.4, .view = 3.14};
        look.step(made, options, 1.0 / 60, state);
        EXPECT_LE(turned(made, Bone::Spine) + turned(made, Bone::Chest) + turned(made, Bone::UpperChest),
                  0.2 + 1e-6);
        EXPECT_LE(turned(made, Bone::Neck), 0.3 + 1e-6);
        EXPECT_LE(turned(made, Bone::Head), 0.4 + 1e-6);
    }
}

TEST_F(HeadLook, AtWeightZeroIsTheClipAndOtherwiseSmooth) {
    const glm::dvec3 target(2.0, 1.2, 1.5);
    const std::vector<rig::Transform> clip = rest_pose(skeleton);
    double before = left(clip, target);
    for (int i = 0; i <= 100; ++i) {
        std::vector<rig::Transform> made = clip;
        LookAtState state;
        look.step(made, {.target = target, .weight = i / 100.0}, 1.0 / 60, state);
        if (i == 0) {
            EXPECT_EQ(made, clip);
        }
        const double now = left(made, target);
        EXPECT_LT(std::abs(now - before), 0.02);
        EXPECT_LE(now, before + 1e-9);
        before = now;
    }
    EXPECT_LT(before, 1e-6);
}

TEST_F(HeadLook, ATargetThatCirclesNeverMakesTheHeadJump) {
    for (const double view : {1.2, LookAtOptions().view, 1.91, 2.0, 2.2, 2.5, 2.8}) {
        SCOPED_TRACE(view);
        LookAtState state;
        std::vector<rig::Transform> before;
        bool was_lost = false;
        for (int frame = 0; frame < 1200; ++frame) {
            const double angle = frame / 60.0 * 2.0 * (frame < 900 ? 1.0 : -7.0);  // then it jumps about
            std::vector<rig::Transform> made = rest_pose(skeleton);
            const LookAtReport report =
                look.step(made, {.target = {3.0 * std::sin(angle), 1.6, 3.0 * std::cos(angle)}, .view = view},
                          1.0 / 60, state);
            was_lost |= report.weight == 0.0;
            for (std::size_t i = 0; i < before.size(); ++i) {
                const double half = std::min(1.0, std::abs(glm::dot(before[i].rotation, made[i].rotation)));
                EXPECT_LT(2.0 * std::acos(half), 0.2);
            }
            before = made;
        }
        EXPECT_TRUE(was_lost || view > 1.95) << "behind the back nothing is looked at";
    }
}

TEST_F(HeadLook, OutOfViewTheGazeIsTheClipsAgain) {
    LookAtState state;
    double weight = 1.0;
    for (int frame = 0; frame < 300; ++frame) {
        std::vector<rig::Transform> made = rest_pose(skeleton);
        const double z = frame < 60 ? 1.0 : -9.0;  // in view, then behind the back
        weight = look.step(made, {.target = {3.0, 1.6, z}}, 1.0 / 60, state).weight;
    }
    EXPECT_EQ(weight, 0.0);
    EXPECT_GT(state.gaze.z, 0.99);
}

TEST_F(HeadLook, RefusesInvalidTargets) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<rig::Transform> made = rest_pose(skeleton);
    const std::vector<rig::Transform> before = made;
    LookAtState state;
    EXPECT_TRUE(
        says(look.step(made, {.target = {0, nan, 0}}, 0.1, state).accepted.message(), "look_at target nan"));
    EXPECT_FALSE(look.step(made, {.spine_part = 0.8}, 0.1, state).accepted);
    EXPECT_EQ(made, before);
    EXPECT_EQ(state, LookAtState());
    EXPECT_FALSE(LookAt::make(skeleton, BoneMap()));
}

}  // namespace
}  // namespace tendril::test
