// A body whose targets are released or reweighted while its state continues.
#include <tendril/humanoid/body.hpp>

#include "humanoid_figure.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

class HumanoidBodySwitch : public testing::Test, protected Figured {
  protected:
    double any(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
    glm::dvec3 near(const glm::dvec3& at, double size) {
        const double x = any(-size, size), y = any(-size, size), z = any(-size, size);
        return at + glm::dvec3(x, y, z);
    }
    std::vector<glm::dvec3> solve(const std::vector<BodyTarget>& targets, const BodyOptions& options = {}) {
        auto pose = rest;
        const auto made = body.solve(pose, targets, state, options);
        EXPECT_TRUE(made) << made.message();
        if (made) report = *made;
        return positions_of(skeleton, pose);
    }
    /// Solves until the pose is at rest.
    std::vector<glm::dvec3> settled(const std::vector<BodyTarget>& targets) {
        std::vector<glm::dvec3> at;
        for (int i = 0; i < 40; ++i) at = solve(targets);
        return at;
    }
    double farthest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, Bone without) const {
        double most = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (i != node(without) && !skeleton.is_below(i, node(without)))
                most = std::max(most, glm::distance(a[i], b[i]));
        return most;
    }
    double residual(Effector effector) const { return report.residuals[static_cast<std::size_t>(effector)]; }

    Body body = *Body::make(skeleton, map, default_limits(skeleton, map));
    BodyState state;
    BodyReport report;
    std::mt19937 engine{5};
};

TEST_F(HumanoidBodySwitch, ReleasingAHandMovesOnlyItsArm) {
    int reached = 0;
    for (int i = 0; i < 100; ++i) {
        state = {};
        const std::vector<BodyTarget> both{{Effector::LeftHand, near({0.35, 1.2, 0.4}, 0.3)},
                                           {Effector::RightHand, near({-0.35, 1.1, 0.5}, 0.4)}};
        const auto before = settled(both);
        if (report.residual > 1e-4) continue;
        ++reached;
        const auto now = solve({both[0]});
        EXPECT_LT(farthest(before, now, Bone::RightUpperArm), 5e-3) << i;
    }
    EXPECT_GT(reached, 30);
}

TEST_F(HumanoidBodySwitch, TheTrunkSettlesGraduallyWhenOnlyAFootIsHeld) {
    const BodyTarget foot{Effector::LeftFoot, {0.15, 0.3, 0.2}}, hand{Effector::RightHand, {-0.2, 0.8, 0.9}};
    const auto before = settled({foot, hand});
    auto now = solve({foot});
    EXPECT_LT(farthest(before, now, Bone::RightUpperArm), 5e-3);
    for (int frame = 0; frame < 90; ++frame) {
        const auto next = solve({foot}, {.settle = 0.02});
        EXPECT_LT(farthest(now, next, Bone::RightUpperArm), 0.05) << frame;
        now = next;
    }
    state = {};
    EXPECT_LT(farthest(now, settled({foot}), Bone::RightUpperArm), 0.05);
}

TEST_F(HumanoidBodySwitch, ReleasingATargetLetsTheOtherOneBeReached) {
    const std::vector<BodyTarget> both{{Effector::LeftHand, {0.9, 1.3, 0.2}},
                                       {Effector::RightHand, {-1.2, 1.3, 0.2}}};
    settled(both);
    EXPECT_GT(residual(Effector::LeftHand), 0.02);
    settled({both[0]});
    EXPECT_LT(residual(Effector::LeftHand), 1e-3);
}

TEST_F(HumanoidBodySwitch, WeightsBlendSlowlyAndScaleTheResiduals) {
    for (int i = 0; i < 8; ++i) {
        state = {};
        std::vector<BodyTarget> targets{{Effector::LeftHand, near({1.4, 1.3, 0.2}, 0.3)},
                                        {Effector::RightHand, near({-1.4, 1.3, 0.2}, 0.3)}};
        auto before = settled(targets);
        const auto first = before;
        const double even = residual(Effector::LeftHand) / residual(Effector::RightHand);
        for (int k = 1; k <= 200; ++k) {
            targets[1].weight = k <= 100 ? 1.0 - 0.005 * k : 0.005 * k;
            const double way = report.residual * 0.005 / targets[1].weight;
            const auto now = solve(targets);
            ASSERT_LT(farthest(before, now, Bone::Head), 20.0 * way) << i << ' ' << k;
            before = now;
            if (k != 100) continue;
            before = settled(targets);
            EXPECT_NEAR(residual(Effector::LeftHand) / residual(Effector::RightHand), 0.5 * even, 0.15 * even)
                << i;
        }
        EXPECT_LT(farthest(first, settled(targets), Bone::Head), 0.1) << i;
    }
}

TEST_F(HumanoidBodySwitch, SettlingReturnsTheBodyAndKeepsTheHand) {
    const std::vector<BodyTarget> both{{Effector::LeftHand, {0.3, 1.2, 0.4}},
                                       {Effector::RightHand, {-0.2, 0.8, 0.9}}};
    const glm::dvec3 alone = settled({both[0]})[node(Bone::Head)];
    state = {};
    settled(both);
    auto before = solve({both[0]});
    EXPECT_GT(glm::distance(before[node(Bone::Head)], alone), 0.5) << "it has bent down";
    for (int frame = 0; frame < 90; ++frame) {
        const auto now = solve({both[0]}, {.settle = 0.02});
        EXPECT_LT(report.residual, 1e-3) << frame;
        EXPECT_LT(farthest(before, now, Bone::RightUpperArm), 0.05) << frame;
        before = now;
    }
    EXPECT_LT(glm::distance(before[node(Bone::Head)], alone), 0.05);
    EXPECT_LT(farthest(before, solve({both[0]}), Bone::RightUpperArm), 1e-5) << "then it is still";
}

}  // namespace
}  // namespace tendril::test
