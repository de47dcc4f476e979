// Explanations: the limit that keeps the tip from the target, its value, and the angle that the target needs.
#include "ik_hostile.hpp"
#include "ik_limit_support.hpp"

namespace tendril::test::ik_explain_test {
namespace {

using ik::ActiveLimit;
using ik::Bound;
using ik::JointKind;
using ik::Limit;
using ik::Method;
using ik::Status;

Limit wide_ball(double half_angle, double twist) {
    Limit limit = Limit::of(JointKind::BallAndSocket);
    limit.up = limit.down = limit.left = limit.right = radians(half_angle);
    limit.twist_min = -radians(twist), limit.twist_max = radians(twist);
    return limit;
}

/// An arm with its bones along +X at rest.
Arm arm_of(Lengths lengths, std::vector<Limit> limits) {
    Arm arm{std::move(lengths), {}, std::move(limits)};
    arm.rest.assign(arm.lengths.size(), {1, 0, 0});
    return arm;
}

struct Explained {
    ik::Report report;
    std::optional<ActiveLimit> hold;
};

Explained explained(const Arm& arm, glm::vec3 target, Method method = Method::Fabrik) {
    KeptSolver solver = arm.solver();
    Joints joints = arm.at_rest();
    const ik::Options options{.limits = arm.limits};
    const ik::Report report = solver.solve(method, joints, target, options);
    return {report, solver.explain(joints, target, options)};
}

/// Distance from root to tip of two bones with the second turned by `angle` degrees.
float span(float a, float b, double angle) {
    return static_cast<float>(std::sqrt(a * a + b * b + 2 * a * b * std::cos(angle * degree)));
}

TEST(IkExplain, AnElbowJustOutOfRangeIsNamedWithTheLawOfCosinesAngle) {
    const glm::vec3 directions[] = {{1, 0, 0}, {0.48f, 0.6f, 0.64f}, {0, -1, 0}, {-0.6f, 0, 0.8f}};
    for (const Limit& shoulder : {Limit(), wide_ball(170, 170)}) {
        for (const double needed : {150.0, 162.0, 175.0}) {
            for (const glm::vec3 direction : directions) {
                const Arm arm = arm_of({1.0f, 0.8f}, {shoulder, Limit::hinge({0, 0, 1}, 0, radians(145))});
                for (const Method method : ik::all_methods) {
                    SCOPED_TRACE(std::string(name(method)) + " " + std::to_string(needed));
                    const auto [report, hold] = explained(arm, direction * span(1.0f, 0.8f, needed), method);
                    // FABRIK (2011) may still be crawling when it runs out of iterations.
                    if (method != Method::FabrikPlain) {
                        EXPECT_EQ(report.status, Status::Limited);
                    }
                    ASSERT_TRUE(hold.has_value());
                    EXPECT_EQ(hold->joint, 1u);
                    EXPECT_EQ(hold->kind, JointKind::Hinge);
                    EXPECT_EQ(hold->bound, Bound::Max);
                    EXPECT_NEAR(degrees(hold->limit), 145, 1e-3);
                    EXPECT_NEAR(degrees(hold->needed), needed, 0.5);
                    EXPECT_TRUE(hold->enough);
                }
            }
        }
    }
}

TEST(IkExplain, ALowerBoundIsNamedToo) {
    const Arm arm = arm_of({1, 1}, {Limit(), Limit::hinge({0, 0, 1}, radians(40), radians(145))});
    const auto [report, hold] = explained(arm, glm::vec3(0, 1, 0) * span(1, 1, 15));
    EXPECT_EQ(report.status, Status::Limited);
    ASSERT_TRUE(hold.has_value());
    EXPECT_EQ(hold->bound, Bound::Min);
    EXPECT_NEAR(degrees(hold->limit), 40, 1e-3);
    EXPECT_NEAR(degrees(hold->needed), 15, 0.5);
}

TEST(IkExplain, ASwingIsNamedByItsAxis) {
    Limit shoulder = Limit::of(JointKind::BallAndSocket);
    shoulder.up = radians(60), shoulder.down = radians(30), shoulder.left = radians(40);
    shoulder.right = radians(20);
    const Arm arm = arm_of({1}, {shoulder});
    const struct {
        glm::vec3 axis;
        Bound bound;
        double limit;
    } cases[] = {{{0, 0, 1}, Bound::Up, 60},
                 {{0, 0, -1}, Bound::Down, 30},
                 {{0, 1, 0}, Bound::Left, 40},
                 {{0, -1, 0}, Bound::Right, 20}};
    for (const auto& c : cases) {
        const glm::vec3 target = glm::angleAxis(radians(c.limit + 15), c.axis) * glm::vec3(1, 0, 0);
        const auto [report, hold] = explained(arm, target);
        EXPECT_EQ(report.status, Status::Limited);
        ASSERT_TRUE(hold.has_value());
        EXPECT_EQ(hold->bound, c.bound);
        EXPECT_NEAR(degrees(hold->limit), c.limit, 0.3);
        EXPECT_NEAR(degrees(hold->needed), c.limit + 15, 0.5);
        EXPECT_TRUE(hold->enough);
    }
}

TEST(IkExplain, TwistIsNamedToo) {
    // The elbow bends about +Z only; to reach +Z the shoulder has to twist by 90 degrees.
    const Arm arm = arm_of({1, 1}, {wide_ball(0, 30), Limit::hinge({0, 0, 1}, radians(90), radians(90))});
    const auto [report, hold] = explained(arm, {1, 0, 1});
    EXPECT_EQ(report.status, Status::Limited);
    ASSERT_TRUE(hold.has_value());
    EXPECT_EQ(hold->joint, 0u);
    EXPECT_EQ(hold->bound, Bound::TwistMax);
    EXPECT_NEAR(degrees(hold->limit), 30, 1e-2);
    EXPECT_NEAR(degrees(hold->needed), 90, 1.0);
}

TEST(IkExplain, TheLimitThatHelpsMostIsNamed) {
    // All three are at their limits, but only the first, next to the root, can bring the tip there by itself.
    const Limit stiff = Limit::hinge({0, 0, 1}, radians(-10), radians(10));
    const Arm arm = arm_of({0.2f, 0.2f, 2.0f}, {stiff, stiff, stiff});
    Joints bent{{0, 0, 0}};
    double direction = 0;
    for (const double turn : {10.0, 10.0, 60.0}) {  // by itself, the last one would have to turn by 60
        direction += turn;
        bent.push_back(bent.back() + arm.lengths[bent.size() - 1] * glm::vec3(std::cos(radians(direction)),
                                                                              std::sin(radians(direction)),
                                                                              0));
    }
    const auto [report, hold] = explained(arm, bent.back());
    EXPECT_EQ(report.status, Status::Limited);
    ASSERT_TRUE(hold.has_value());
    EXPECT_TRUE(hold->enough);
    EXPECT_GT(hold->needed, hold->limit + radians(10));
    // The named angle is sufficient: with that much more range the tip arrives, with less it does not.
    for (const double part : {0.8, 1.02}) {
        Arm freed = arm;
        freed.limits[hold->joint].max += (hold->needed - hold->limit) * static_cast<float>(part);
        EXPECT_EQ(explained(freed, bent.back()).report.status == Status::Converged, part > 1) << part;
    }
}

TEST(IkExplain, WithoutAHoldingLimitNothingIsNamed) {
    const Arm arm = arm_of({1, 1}, {Limit(), Limit::hinge({0, 0, 1}, 0, radians(145))});
    EXPECT_FALSE(explained(arm, {0.9f, 0.9f, 0}).hold.has_value());  // reached
    EXPECT_FALSE(explained(arm, {0, 5, 0}).hold.has_value());        // out of reach
    KeptSolver solver = arm.solver();
    const Joints joints = arm.at_rest();
    EXPECT_FALSE(solver.explain(joints, {1, 1, 0}, {}).has_value());
    const ik::Options options{.limits = arm.limits};
    EXPECT_FALSE(solver.explain(joints, {nan, 1, 0}, options).has_value());
    EXPECT_FALSE(solver.explain({joints.data(), 2}, {1, 1, 0}, options).has_value());
}

/// On arms of all kinds: the named joint is at its limit, raising it helps, explaining changes nothing.
TEST(IkExplain, RaisingTheNamedLimitHelps) {
    Random random(given_seed());
    int limited = 0, named = 0;
    for (int k = 0; k < 400 && !HasFailure(); ++k) {
        SCOPED_TRACE(k);
        const Arm arm = some_arm(random, 2 + random.below(4));
        const glm::vec3 target = some_offset(random, 0.0f, 0.9f * arm.reach());
        KeptSolver solver = arm.solver();
        Joints joints = arm.at_rest();
        const ik::Options options{.limits = arm.limits};
        const ik::Report report = solver.solve(Method::Fabrik, joints, target, options);
        if (report.status != Status::Limited) continue;
        ++limited;
        const Joints before = joints;
        const std::vector<glm::quat> rotations(solver.rotations().begin(), solver.rotations().end());
        const std::optional<ActiveLimit> hold = solver.explain(joints, target, options);
        EXPECT_TRUE(same_bits(joints, before));
        EXPECT_EQ(
            std::memcmp(rotations.data(), solver.rotations().data(), rotations.size() * sizeof(glm::quat)),
            0);
        if (!hold) continue;
        ++named;
        ASSERT_LT(hold->joint, arm.lengths.size());
        EXPECT_EQ(hold->kind, arm.limits[hold->joint].kind);
        const bool below = hold->bound == Bound::Min || hold->bound == Bound::TwistMin;
        EXPECT_GT(below ? hold->limit - hold->needed : hold->needed - hold->limit, 0);
        EXPECT_TRUE(std::isfinite(hold->needed));
    }
    EXPECT_GT(limited, 100);
    EXPECT_GT(named, limited * 7 / 10) << "of " << limited;
}

}  // namespace
}  // namespace tendril::test::ik_explain_test
