// Hands must not pass through their own body.
#include <glm/trigonometric.hpp>
#include <tendril/humanoid/body.hpp>

#include "humanoid_figure.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

class HumanoidContact : public testing::TestWithParam<bool>, protected Figured {
  protected:
    /// Penetration of hands and lower arms into trunk, head and legs, recomputed from the pose, metres.
    double penetration(const std::vector<rig::Transform>& pose) {
        place(skeleton, pose, placements);
        double deepest = 0.0;
        for (const BodyCapsule& arm : capsules) {
            if (arm.bone != Bone::LeftHand && arm.bone != Bone::LeftLowerArm && arm.bone != Bone::RightHand &&
                arm.bone != Bone::RightLowerArm)
                continue;
            for (const BodyCapsule& other : capsules) {
                const bool counts = other.bone <= Bone::Head || other.bone == Bone::LeftUpperLeg ||
                                    other.bone == Bone::RightUpperLeg || other.bone == Bone::LeftLowerLeg ||
                                    other.bone == Bone::RightLowerLeg;
                if (!counts) continue;
                deepest = std::max(deepest, -gap(place(arm, map, placements), place(other, map, placements)));
            }
        }
        return deepest;
    }

    std::vector<BodyCapsule> capsules = default_capsules(skeleton, map);
    Body body =
        *Body::make(skeleton, map, GetParam() ? default_limits(skeleton, map) : no_limits(), capsules);
    std::vector<Placement> placements = std::vector<Placement>(skeleton.size());
};

/// A target's rotation is applied after the solve, so it may press the hand into the body; the report then
/// says so.
TEST_P(HumanoidContact, AHandRotatedIntoTheBodyIsReported) {
    BodyState state;
    double deepest = 0.0;
    for (int degrees = -180; degrees < 180; degrees += 20) {
        const double half = 0.5 * glm::radians(static_cast<double>(degrees));
        std::vector<BodyTarget> targets{{Effector::LeftHand, {0.2, 1.15, 0.05}}};
        targets[0].rotation = glm::dquat(std::cos(half), 0.0, std::sin(half), 0.0);
        if (degrees > 0) {  // the head turned into a hand in front of it
            targets[0] = {Effector::LeftHand, {0.05, 1.7, 0.12}};
            targets.push_back({Effector::Head, {0.0, 1.55, 0.0}});
            targets[1].rotation = glm::dquat(std::cos(0.3 * half), std::sin(0.3 * half), 0.0, 0.0);
        }
        for (int frame = 0; frame < 30; ++frame) {
            auto pose = rest;
            const auto report = body.solve(pose, targets, state);
            ASSERT_TRUE(report) << report.message();
            const double depth = penetration(pose);
            EXPECT_NEAR(report->penetration, depth, 1e-9) << degrees;
            deepest = std::max(deepest, depth);
        }
    }
    EXPECT_GE(deepest, GetParam() ? 0.0 : 0.005);  // limits keep the hand out
}

TEST_P(HumanoidContact, AHandDraggedThroughTheBodySlidesAroundIt) {
    const std::pair<glm::dvec3, glm::dvec3> ways[]{
        {{0.1, 1.15, 0.5}, {0.1, 1.15, -0.4}},    // the waist, from the front
        {{0.45, 1.15, 0.1}, {-0.45, 1.15, 0.1}},  // from the side
        {{0.3, 1.3, 0.4}, {-0.2, 1.0, -0.1}},
        {{0.1, 0.7, 0.5}, {0.1, 0.7, -0.3}},     // a thigh
        {{0.3, 1.7, 0.3}, {-0.2, 1.65, -0.1}}};  // the head
    for (const auto& [from, to] : ways)
        for (const double step : {2e-2, 5e-3, 1e-3}) {
            BodyState state;
            std::vector<glm::dvec3> before;
            const int frames = static_cast<int>(glm::distance(from, to) / step);
            for (int frame = -40; frame <= frames + 60; ++frame) {
                const glm::dvec3 target =
                    glm::mix(from, to, std::clamp(static_cast<double>(frame) / frames, 0.0, 1.0));
                auto pose = rest;
                const auto report =
                    body.solve(pose, std::vector<BodyTarget>{{Effector::LeftHand, target}}, state);
                ASSERT_TRUE(report) << report.message();
                const auto now = positions_of(skeleton, pose);
                ASSERT_LT(penetration(pose), 5e-3) << step << ' ' << frame;
                EXPECT_LT(report->penetration, 5e-3);
                if (frame >= 0 && frame <= frames) {
                    ASSERT_LT(farthest(before, now), 20.0 * step) << step << ' ' << frame;
                }
                if (frame > frames + 50) {
                    EXPECT_LT(farthest(before, now), 1e-5);
                }
                before = now;
            }
        }
}

TEST_P(HumanoidContact, AClipWithAFistThroughTheWaistIsCorrected) {
    BodyState state;
    double deepest = 0.0, clip_deepest = 0.0;
    std::vector<glm::dvec3> before, clip_before;
    for (int frame = 0; frame <= 120; ++frame) {
        // The right arm swings down and across with a bent elbow: the hand passes through the belly.
        const double part = 0.5 - 0.5 * std::cos(2.0 * 3.14159265358979 * frame / 120.0);
        auto pose = rest;
        pose[node(Bone::RightUpperArm)].rotation = glm::angleAxis(part * 1.2, glm::dvec3(0, 0, 1));
        pose[node(Bone::RightLowerArm)].rotation =
            glm::angleAxis(part * 1.4, glm::normalize(glm::dvec3(0, 0.3, 1)));
        const auto clip = positions_of(skeleton, pose);
        clip_deepest = std::max(clip_deepest, penetration(pose));
        const auto report = body.solve(pose, std::vector<BodyTarget>{}, state);
        ASSERT_TRUE(report) << report.message();
        deepest = std::max(deepest, penetration(pose));
        const auto now = positions_of(skeleton, pose);
        if (frame > 0) {
            EXPECT_LT(farthest(before, now), 20.0 * farthest(clip_before, clip) + 1e-6) << frame;
        }
        before = now, clip_before = clip;
    }
    EXPECT_GT(clip_deepest, 0.05);  // the clip itself passes through
    EXPECT_LT(deepest, 5e-3);
}

TEST_P(HumanoidContact, AHandClearOfTheBodyKeepsItsPose) {
    auto pose = rest;
    pose[node(Bone::LeftUpperArm)].rotation = glm::angleAxis(0.4, glm::dvec3(0, 0, 1));
    const auto clip = positions_of(skeleton, pose);
    BodyState state;
    ASSERT_TRUE(body.solve(pose, std::vector<BodyTarget>{}, state));
    EXPECT_LT(farthest(clip, positions_of(skeleton, pose)), 1e-9);
}

TEST_P(HumanoidContact, AnyTargetsGiveFinitePosesAndRarelyContact) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int deep = 0;
    for (int i = 0; i < 1000; ++i) {
        std::vector<BodyTarget> targets;
        for (const Effector each : {Effector::LeftHand, Effector::RightHand, Effector::Head}) {
            const double x = any(engine), y = any(engine), z = any(engine);
            const glm::dvec3 about =
                each == Effector::Head ? glm::dvec3(0.0, 1.6, 0.0) : glm::dvec3(0.0, 1.2, 0.1);
            targets.push_back({each, about + 0.4 * glm::dvec3(x, y, z)});
        }
        auto pose = rest;
        BodyState state;
        ASSERT_TRUE(body.solve(pose, targets, state));
        for (const glm::dvec3& each : positions_of(skeleton, pose))
            ASSERT_TRUE(std::isfinite(each.x + each.y + each.z));
        deep += penetration(pose) > 5e-3;
    }
    EXPECT_LE(deep, 20);
}

TEST_P(HumanoidContact, AnInvalidCapsuleIsRefused) {
    auto bad = capsules;
    bad[2].radius = -1.0;
    EXPECT_TRUE(says(std::string(Body::make(skeleton, map, no_limits(), bad).message()),
                     "Body capsules[2].radius 0 1e9 -1"));
}

INSTANTIATE_TEST_SUITE_P(Limits, HumanoidContact, testing::Bool(),
                         [](const auto& each) { return each.param ? "default" : "none"; });

TEST(HumanoidCapsules, NearestPointsOfLinesMatchASearch) {
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        glm::dvec3 ends[4];
        for (glm::dvec3& each : ends) {
            const double x = any(engine), y = any(engine), z = any(engine);
            each = {x, y, z};
        }
        if (i % 10 == 0) ends[1] = ends[0];                              // a point
        if (i % 10 == 1) ends[3] = ends[2] + 2.0 * (ends[1] - ends[0]);  // parallel
        const PlacedCapsule a{ends[0], ends[1], 0.1}, b{ends[2], ends[3], 0.2};
        double least = 1e9;
        for (int m = 0; m <= 100; ++m)
            for (int n = 0; n <= 100; ++n)
                least = std::min(least, glm::distance(glm::mix(a.from, a.to, m / 100.0),
                                                      glm::mix(b.from, b.to, n / 100.0)));
        const Nearest at = nearest(a, b);
        EXPECT_LE(glm::distance(at.first, at.second), least + 1e-12);
        EXPECT_GT(glm::distance(at.first, at.second), least - 0.03);
        EXPECT_NEAR(gap(a, b), glm::distance(at.first, at.second) - 0.3, 1e-12);
        EXPECT_NEAR(gap(a, b), gap(b, a), 1e-9);
    }
}

TEST(HumanoidCapsules, DefaultsFollowTheFiguresSize) {
    const Skeleton figure = make_figure({});
    std::vector<Node> nodes = figure.nodes();
    nodes.front().rest.scale = glm::dvec3(2.0);
    const Skeleton large = *Skeleton::make(nodes);
    const auto one = default_capsules(figure, match_bones(figure)),
               two = default_capsules(large, match_bones(large));
    ASSERT_EQ(one.size(), two.size());
    EXPECT_EQ(one.size(), 15u);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].bone, two[i].bone);
        EXPECT_NEAR(two[i].radius, 2.0 * one[i].radius, 1e-9);
        EXPECT_LT(glm::distance(one[i].from, two[i].from), 1e-9);  // in the node's space, which is scaled
    }
}

}  // namespace
}  // namespace tendril::test
