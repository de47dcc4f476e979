// Steps of a body that reaches farther than its feet allow.
#include <tendril/humanoid/balance.hpp>
#include <tendril/humanoid/footsteps.hpp>

#include "humanoid_figure.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

constexpr double frame = 1.0 / 60.0;

class HumanoidFootsteps : public testing::Test, protected Figured {
  protected:
    /// One frame of a body that reaches from its rest pose.
    BodyReport solve(std::vector<BodyTarget> targets, double dt = frame) {
        BodyOptions options{.balance = true};
        options.ground = ground;
        options.feet = advance_steps(steps, soles, dt);
        pose = rest;
        const auto report = body.solve(pose, targets, state, options);
        EXPECT_TRUE(report) << report.message();
        place(skeleton, rest, clip);
        place(skeleton, pose, solved);
        if (dt > 0.0 && plan_step(steps, soles, masses.centre(solved), clip, state, ground)) ++begun;
        return report ? *report : BodyReport();
    }
    /// Moves the right hand from its rest position to `to` at 1 m/s, then waits for 3 s.
    BodyReport reach(const glm::dvec3& to) {
        const glm::dvec3 from{-0.72, 1.45, 0.0};
        const int frames = static_cast<int>(glm::distance(from, to) / frame) + 1;
        BodyReport report;
        for (int i = 1; i <= frames + 180; ++i)
            report = solve(
                {{Effector::RightHand, glm::mix(from, to, std::min(1.0, static_cast<double>(i) / frames))}});
        return report;
    }
    double margin() const { return find_support(soles, solved).margin(masses.centre(solved)); }

    std::vector<rig::Transform> pose = rest;
    std::vector<Placement> clip{skeleton.size()}, solved{skeleton.size()};
    Masses masses = *find_masses(skeleton, map);
    Soles soles = *find_soles(skeleton, map);
    Body body = *Body::make(skeleton, map, default_limits(skeleton, map));
    BodyState state;
    FootstepsState steps;
    const Ground* ground = nullptr;
    int begun = 0;
};

TEST_F(HumanoidFootsteps, ANearTargetNeedsNoStep) {
    reach({-0.2, 1.1, 0.95});
    EXPECT_EQ(begun, 0);
    EXPECT_FALSE(steps.away());
}

TEST_F(HumanoidFootsteps, AStepRisesAndLandsOnTime) {
    steps.feet[1] = {{}, {0.0, 0.0, 0.4}, 0.0};
    double highest = 0.0;
    int frames = 0;
    for (double before = 0.0; steps.stepping(); ++frames) {
        const std::array<FootShift, 2> feet = advance_steps(steps, soles, frame);
        highest = std::max(highest, feet[1].lift);
        EXPECT_EQ(feet[0], FootShift());
        EXPECT_GE(feet[1].stand.z, before);
        before = feet[1].stand.z;
    }
    EXPECT_NEAR(frames, 18, 1);
    EXPECT_NEAR(highest, 0.1 * soles.leg, 0.005);
    EXPECT_EQ(advance_steps(steps, soles, frame)[1], (FootShift{{0.0, 0.0, 0.4}, 0.0}));
}

TEST_F(HumanoidFootsteps, NothingJumps) {
    const glm::dvec3 from{-0.72, 1.45, 0.0}, to{-0.2, 1.0, 2.0};
    std::vector<Placement> before;
    double worst = 0.0;
    for (int i = 1; i <= 300; ++i) {
        solve({{Effector::RightHand, glm::mix(from, to, std::min(1.0, i / 120.0))}});
        for (std::size_t k = 0; k < solved.size() && !before.empty(); ++k)
            worst = std::max(worst, glm::distance(solved[k].position, before[k].position));
        before = solved;
    }
    EXPECT_GE(begun, 2);
    EXPECT_LT(worst, 0.16);  // the hips catch up with a foot that moves 5 cm a frame
}

TEST_F(HumanoidFootsteps, WithoutTargetsTheFeetStepBack) {
    reach({-0.2, 1.0, 1.6});
    ASSERT_TRUE(steps.away());
    for (int i = 0; i < 90; ++i) solve({});
    EXPECT_FALSE(steps.away());
    solve({});
    EXPECT_EQ(pose, rest);
    EXPECT_EQ(state, BodyState());
}

TEST_F(HumanoidFootsteps, AFootClimbsOneStairAfterAnother) {
    const Ground stairs = *Ground::stairs(0.3, 0.4);
    ground = &stairs;
    const auto hips = static_cast<std::size_t>(map[Bone::Hips].node);
    rest[hips].translation.z -= 0.3;
    const glm::dvec3 from{-0.72, 1.45, -0.3}, to{-0.2, 2.0, 1.9};
    double highest = 0.0;
    for (int i = 1; i <= 900; ++i) {
        solve({{Effector::RightHand, glm::mix(from, to, std::min(1.0, i / 600.0))}});
        for (const SolePoints& sole : sole_points(soles, solved)) highest = std::max(highest, sole.toe.y);
    }
    EXPECT_FALSE(steps.stepping());
    std::array<double, 2> up{};
    for (std::size_t side = 0; side < 2; ++side) {
        const SolePoints sole = sole_points(soles, solved)[side];
        up[side] = stairs.highest(sole.toe.x, sole.toe.z)->height;
        EXPECT_NEAR(sole.toe.y, up[side], 0.03) << side;
    }
    // Above the clip's ground, the second stair is more than half a leg up.
    EXPECT_GT(0.6, 0.5 * soles.leg);
    EXPECT_GT(std::max(up[0], up[1]), 0.59);
}

TEST_F(HumanoidFootsteps, StepsEndForAnyTarget) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int few = 0;
    for (int i = 0; i < 40; ++i) {
        state = {}, steps = {}, begun = 0;
        const double x = any(random), y = any(random), z = any(random);
        const BodyReport report = reach({-0.3 + 1.3 * x, 1.0 + 0.9 * y, 0.3 + 1.3 * z});
        EXPECT_LE(begun, 4) << i;
        few += begun <= 2;
        EXPECT_FALSE(steps.stepping()) << i;
        EXPECT_LT(report.residual, 0.03) << i;
        EXPECT_GT(margin(), 0.0) << i;
    }
    EXPECT_GE(few, 30);
}

TEST_F(HumanoidFootsteps, OptionsOutOfRangeAreClamped) {
    const auto after = [&](const FootstepOptions& options) {
        FootstepsState begun{.feet = {Footstep{{}, {0.0, 0.0, 0.4}, 0.0}}};
        return advance_steps(begun, soles, 0.01, options);
    };
    EXPECT_EQ(after({.seconds = 1e-9, .lift = 7.0}), after({.seconds = 0.05, .lift = 1.0}));
    EXPECT_EQ(after({.seconds = 1e9, .lift = std::nan("")}), after({.seconds = 5.0, .lift = 0.0}));
}

TEST_F(HumanoidFootsteps, BadStatesAreReset) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    steps.feet[0].to.x = nan;
    EXPECT_FALSE(check(steps));
    EXPECT_EQ(advance_steps(steps, soles, frame), (std::array<FootShift, 2>{}));
    EXPECT_FALSE(steps.away());
    const auto report =
        body.solve(pose, {}, state, {.balance = true, .feet = {FootShift{{nan, 0.0, 0.0}, 0.0}}});
    EXPECT_TRUE(says(report.message(), "options.feet.left.stand.x"));
}

}  // namespace
}  // namespace tendril::test
