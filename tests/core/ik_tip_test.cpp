// The tip's orientation as requested, with and without limits.
#include "ik_hostile.hpp"
#include "ik_limit_support.hpp"

namespace tendril::test::ik_tip_test {
namespace {

using ik::Method;
using ik::Status;

glm::quat some_rotation(Random& random) {
    return some_turn(random, 3.0f);
}

double angle_between(glm::quat a, glm::quat b) {
    const glm::dmat3 turn = glm::transpose(matrix_of(a)) * matrix_of(b);
    const glm::dvec3 v{turn[1][2] - turn[2][1], turn[2][0] - turn[0][2], turn[0][1] - turn[1][0]};
    return std::atan2(glm::length(v), turn[0][0] + turn[1][1] + turn[2][2] - 1.0);
}

TEST(IkTip, EveryMethodGivesTheTipItsOrientation) {
    Random random(given_seed());
    for (int k = 0; k < 2000 && !HasFailure(); ++k) {
        const Lengths lengths = some_lengths(2 + random.below(6), random);
        Joints rest;
        for (std::size_t i = 0; i < lengths.size(); ++i) rest.push_back(some_direction(random));
        const glm::quat asked = some_rotation(random);
        const glm::vec3 target = some_offset(random, 0.0f, static_cast<float>(reach_of(lengths)));
        for (const Method method : iterating_methods) {
            SCOPED_TRACE(std::string(name(method)) + " " + std::to_string(k));
            KeptSolver solver(lengths, rest);
            Joints joints = some_pose(lengths, random);
            const ik::Options options{.tip_orientation = asked};
            const ik::Report report = solver.solve(method, joints, target, options);
            EXPECT_TRUE(Holds(joints, lengths));
            const glm::vec3 last = joints.back() - joints[joints.size() - 2];
            EXPECT_LE(distance(last, asked * rest.back() * lengths.back()), 1e-4);
            EXPECT_LE(angle_between(solver.rotations().back(), asked), 1e-5);
            EXPECT_NEAR(report.residual, distance(joints.back(), target), 1e-5);
            // The status depends on the reach of the chain without its last bone.
            const Lengths others(lengths.begin(), lengths.end() - 1);
            const double away = distance(target - asked * rest.back() * lengths.back(), {});
            const double reach = reach_of(others), longest = *std::max_element(others.begin(), others.end());
            if (away > reach * 1.0001) {
                EXPECT_EQ(report.status, Status::Stretched);
                EXPECT_NEAR(report.residual, away - reach, 1e-4);
            } else if (away < 2 * longest - reach - 1e-4) {
                EXPECT_EQ(report.status, Status::TooClose);
            } else if (away < 0.98 * reach && away > (2 * longest - reach) + 0.02 * reach &&
                       (method == Method::Fabrik || method == Method::Dls)) {
                EXPECT_EQ(report.status, Status::Converged);
            }
        }
    }
}

TEST(IkTip, TheTwoBoneSolverPlacesAHandOnAnArm) {
    const Lengths arm{1, 1, 0.3f};
    KeptSolver solver(arm);
    Joints joints = straight_joints(arm);
    const glm::quat down = glm::angleAxis(radians(-90), glm::vec3(0, 0, 1));
    const ik::Report report = solver.solve(Method::TwoBone, joints, {1.2f, 0, 0}, {.tip_orientation = down});
    EXPECT_EQ(report.status, Status::Converged);
    EXPECT_LE(distance(joints[2], {1.2f, 0.3f, 0}), 1e-4);
    KeptSolver two(Lengths{1, 0.3f});
    joints = straight_joints(Lengths{1, 0.3f});
    EXPECT_EQ(two.solve(Method::TwoBone, joints, {0, 0.7f, 0}, {.tip_orientation = down}).status,
              Status::Converged);
    KeptSolver four(Lengths{1, 1, 1, 1});
    joints = straight_joints(Lengths{1, 1, 1, 1});
    EXPECT_EQ(four.solve(Method::TwoBone, joints, {1, 1, 0}, {.tip_orientation = down}).status,
              Status::InvalidInput);
}

TEST(IkTip, ASingleBoneTakesTheOrientation) {
    KeptSolver solver(Lengths{2});
    Joints joints{{1, 1, 1}, {3, 1, 1}};
    const glm::quat up = glm::angleAxis(radians(90), glm::vec3(0, 0, 1));
    EXPECT_EQ(solver.solve(Method::Fabrik, joints, {1, 3, 1}, {.tip_orientation = up}).status,
              Status::Converged);
    EXPECT_LE(distance(joints[1], {1, 3, 1}), 1e-5);
    const ik::Report off = solver.solve(Method::Fabrik, joints, {1, 1, 3}, {.tip_orientation = up});
    EXPECT_EQ(off.status, Status::Stretched);
    EXPECT_NEAR(off.residual, std::sqrt(8.0f), 1e-5f);
}

/// The orientation comes from the same pose as the target.
TEST(IkTip, WithinLimitsMostTargetsAreReached) {
    Random random(6);
    int there = 0, turned_so = 0;
    constexpr int count = 1000;
    for (int k = 0; k < count; ++k) {
        const Arm arm = some_arm(random, ArmKind::Cones, 5);
        // A first solve gives some pose within the limits, for any target.
        KeptSolver maker = arm.solver();
        Joints made = arm.at_rest();
        maker.solve(Method::Fabrik, made, some_tip(arm, random),
                    {.max_iterations = 200, .limits = arm.limits});
        KeptSolver solver = arm.solver();
        Joints joints = arm.at_rest();
        ik::Options options{
            .max_iterations = 200, .limits = arm.limits, .tip_orientation = maker.rotations().back()};
        const ik::Report report = solver.solve(Method::Fabrik, joints, made.back(), options);
        EXPECT_TRUE(WithinLimits(arm, joints, solver.rotations()));
        there += report.status == Status::Converged;
        turned_so += angle_between(solver.rotations().back(), *options.tip_orientation) < 1 * degree;
        if (report.status == Status::Converged) {
            EXPECT_LE(report.residual, 1e-3f * arm.reach());
            EXPECT_LE(degrees(angle_between(solver.rotations().back(), *options.tip_orientation)), 0.1);
        }
    }
    EXPECT_GE(there, count * 95 / 100);
    EXPECT_GE(turned_so, count * 95 / 100);
}

TEST(IkTip, AWristBeyondItsLimitIsLimited) {
    Arm arm{{1, 1, 0.3f}, {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {}};
    arm.limits = {ik::Limit::of(ik::JointKind::Suture), ik::Limit::of(ik::JointKind::Suture),
                  ik::Limit::of(ik::JointKind::Gliding)};
    for (const Method method : iterating_methods) {
        KeptSolver solver = arm.solver();
        Joints joints = arm.at_rest();
        const glm::quat back = glm::angleAxis(radians(170), glm::vec3(0, 0, 1));
        const ik::Options options{.limits = arm.limits, .tip_orientation = back};
        EXPECT_EQ(solver.solve(method, joints, {2.3f, 0, 0}, options).status, Status::Limited)
            << name(method);
        EXPECT_TRUE(WithinLimits(arm, joints, solver.rotations()));
    }
}

}  // namespace
}  // namespace tendril::test::ik_tip_test
