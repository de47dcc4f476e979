// Hands on their targets: within a millimetre if the arm reaches; at weight 0 bitwise unchanged; only the
// arm's bones change.
#include <tendril/humanoid/hands.hpp>
#include <tendril/humanoid/look_at.hpp>

#include "humanoid_figure.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

class HandIk : public ::testing::Test, protected Figured {
  protected:
    /// A pose with random arms, the rest unchanged.
    std::vector<rig::Transform> pose() {
        std::vector<rig::Transform> made = rest_pose(skeleton);
        for (const Bone bone : {Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand, Bone::RightUpperArm,
                                Bone::RightLowerArm, Bone::RightHand, Bone::RightShoulder})
            made[node(bone)].rotation =
                glm::angleAxis(number(-0.8, 0.8), number.rotation() * glm::dvec3(0, 0, 1));
        return made;
    }
    /// A random point in front of the left arm, within its reach.
    glm::dvec3 near_left() {
        for (;;) {
            const glm::dvec3 from(number(-0.5, 0.5), number(-0.5, 0.5), number(-0.2, 0.5));
            const double far = glm::length(from);
            if (far > 0.1 && far < 0.53) return glm::dvec3(0.18, 1.45, 0.0) + from;
        }
    }

    RandomPoses number{11};
    const Hands hands = *Hands::make(skeleton, map);
};

LABEL(slow, "HandIk.BetweenTheTwoItIsSmooth");

TEST_F(HandIk, AtFullWeightTheHandHasItsTargetsPoseAndRotation) {
    for (int round = 0; round < 1000; ++round) {
        std::vector<rig::Transform> made = pose();
        const std::vector<rig::Transform> before = made;
        const glm::dvec3 target = near_left();
        const glm::dquat turned = number.rotation();
        HandsState state;
        HandTargets targets;
        targets[0] = {.position = target, .rotation = turned, .weight = 1.0};
        const HandsReport report = hands.step(made, targets, 1.0 / 60, state, {.view = 3.14});
        ASSERT_TRUE(report.accepted);
        EXPECT_EQ(report.hands[0].weight, 1.0);
        EXPECT_LT(glm::distance(at(made, Bone::LeftHand), target), 0.002);
        EXPECT_LT(report.hands[0].residual, 0.002);
        EXPECT_NEAR(std::abs(glm::dot(placed(made)[node(Bone::LeftHand)].rotation(), turned)), 1.0, 1e-9);
        for (std::size_t i = 0; i < made.size(); ++i)
            if (!skeleton.is_below(i, node(Bone::LeftShoulder))) {
                EXPECT_EQ(made[i], before[i]) << skeleton[i].name << " is none of the left arm";
            }
    }
}

TEST_F(HandIk, BetweenTheTwoItIsSmooth) {
    for (int round = 0; round < 50; ++round) {
        const bool straight = round % 5 == 0;
        const std::vector<rig::Transform> clip = straight ? rest_pose(skeleton) : pose();
        const glm::dvec3 target = near_left(), start = at(clip, Bone::LeftHand);
        const glm::dquat turned = number.rotation();
        HandsState state;
        glm::dvec3 before = start, elbow = at(clip, Bone::LeftLowerArm);
        double worst = 0.0;
        constexpr int steps = 2000;
        for (int i = 0; i <= steps; ++i) {
            std::vector<rig::Transform> made = clip;
            HandTargets targets;
            targets[0] = {.position = target, .rotation = turned, .weight = static_cast<double>(i) / steps};
            hands.step(made, targets, 1.0 / 60, state, {.view = 3.14});
            const glm::dvec3 now = at(made, Bone::LeftHand), bent = at(made, Bone::LeftLowerArm);
            worst = std::max(worst, glm::distance(now, before));
            const glm::dvec3 shoulder = at(made, Bone::LeftUpperArm);
            // Close to the shoulder, the arm's direction is undefined.
            if (glm::distance(now, shoulder) > 0.1) {
                EXPECT_LT(glm::distance(bent, elbow), 0.02) << i;
            }
            before = now;
            elbow = bent;
        }
        EXPECT_LT(worst, 1.1 * glm::distance(start, target) / steps + 0.002);
    }
}

TEST_F(HandIk, APunchHitsThePostAndReturns) {
    const signal::Curve hook = *weight_curve(0.2, 0.5, 0.6, 0.9);
    const glm::dvec3 post(-0.1, 1.4, 0.4);
    HandsState state;
    glm::dvec3 before{0.0};
    for (int frame = 0; frame <= 66; ++frame) {
        const double time = frame / 60.0, weight = signal::evaluate_keys(hook, time);
        std::vector<rig::Transform> made = rest_pose(skeleton);
        made[node(Bone::RightUpperArm)].rotation = glm::angleAxis(0.6 + 0.5 * time, glm::dvec3(0, 1, 0));
        made[node(Bone::RightLowerArm)].rotation = glm::angleAxis(1.0, glm::dvec3(0, 1, 0));
        const std::vector<rig::Transform> clip = made;
        HandTargets targets;
        targets[1] = {.position = post, .weight = weight};
        hands.step(made, targets, 1.0 / 60, state);
        const glm::dvec3 now = at(made, Bone::RightHand);
        if (time <= 0.2 || time >= 0.9) {
            EXPECT_EQ(made, clip);
        }
        if (time >= 0.5 && time <= 0.6) {
            EXPECT_LT(glm::distance(now, post), 0.002);
        }
        if (frame > 0) {
            EXPECT_LT(glm::distance(now, before), 0.06) << time;
        }
        EXPECT_EQ(made[node(Bone::LeftHand)], clip[node(Bone::LeftHand)]);
        before = now;
    }
}

TEST_F(HandIk, TheShoulderHelpsWithinItsLimit) {
    const std::vector<rig::Transform> clip = rest_pose(skeleton);
    HandTargets targets;
    targets[0] = {.position = {0.05, 1.5, 0.57}, .weight = 1.0};  // 59 cm from the arm's root; it reaches 54
    const auto residual = [&](double shoulder) {
        HandsState state;
        std::vector<rig::Transform> made = clip;
        return hands.step(made, targets, 0.1, state, {.shoulder = shoulder}).hands[0].residual;
    };
    EXPECT_GT(residual(0.0), 0.04);
    EXPECT_LT(residual(0.5), 0.002);
    EXPECT_LT(residual(0.1), residual(0.0));
    targets[0].position = {0.05, 1.5, 30.0};
    EXPECT_GT(residual(0.5), 28.0) << "out of reach it points there";
}

TEST_F(HandIk, OutOfViewTheWeightFades) {
    HandsState state;
    HandTargets targets;
    targets[0] = {.position = {0.3, 1.3, 0.35}, .weight = 1.0};
    const HandsOptions options{.view = 1.2};
    std::vector<double> weights;
    const auto step = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            std::vector<rig::Transform> made = rest_pose(skeleton);
            weights.push_back(hands.step(made, targets, 1.0 / 60, state, options).hands[0].weight);
        }
        return weights.back();
    };
    EXPECT_EQ(step(10), 1.0);
    targets[0].position = {0.3, 1.3, -0.35};
    EXPECT_GT(step(1), 0.9);
    EXPECT_NEAR(step(5), 0.5, 0.1) << "half of it after 0.1 s";
    EXPECT_EQ(step(60), 0.0);
    EXPECT_FALSE(state.hands[0].in_view);
    targets[0].position.z = 0.35;
    EXPECT_EQ(step(90), 1.0);
    for (std::size_t i = 1; i < weights.size(); ++i) EXPECT_LT(std::abs(weights[i] - weights[i - 1]), 0.13);
}

TEST_F(HandIk, ARefusalChangesNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<rig::Transform> made = rest_pose(skeleton);
    const std::vector<rig::Transform> before = made;
    HandsState state;
    HandTargets targets;
    targets[0] = {.position = {0.3, 1.3, 0.3}, .weight = 1.0};
    targets[1] = {.position = {nan, 1.3, 0.3}, .weight = 0.0};
    EXPECT_TRUE(
        says(hands.step(made, targets, 0.1, state).accepted.message(), "step targets[1].position.x nan"));
    targets[1] = {.rotation = glm::dquat(0, 0, 0, 0)};
    EXPECT_FALSE(hands.step(made, targets, 0.1, state).accepted);
    targets[1] = {.weight = nan};
    EXPECT_FALSE(hands.step(made, targets, 0.1, state, {.half_life = 0.0}).accepted);
    EXPECT_EQ(made, before);
    EXPECT_EQ(state, HandsState());
    EXPECT_TRUE(hands.step(made, targets, nan, state).accepted) << "no weight and no time are fine";
    made[node(Bone::LeftHand)].translation.x = nan;
    EXPECT_FALSE(hands.step(made, targets, 0.1, state).accepted);
    EXPECT_FALSE(weight_curve(0.5, 0.2, 0.6, 0.9));
    EXPECT_FALSE(Hands::make(skeleton, BoneMap()));
}

// The head looks at its target within the limits of its bones, and returns to the clip if it cannot.

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
