// Stiff joints: they rotate less, the other joints compensate, and the tip still arrives.
#include "ik_limit_support.hpp"

namespace tendril::test::ik_stiffness_test {
namespace {

using ik::Limit;
using ik::Method;
using ik::Status;

constexpr float stiffnesses[] = {0.0f, 0.5f, 0.9f, ik::max_stiffness};

/// Six bones in a bow, with free joints or within wide cones.
Arm bow(bool cones) {
    Arm arm;
    for (int i = 0; i < 6; ++i) {
        arm.lengths.push_back(0.5f);
        const float angle = 0.6f - 0.25f * static_cast<float>(i);
        arm.rest.push_back({std::cos(angle), std::sin(angle), 0.0f});
        Limit limit;
        if (cones) {
            limit = Limit::of(ik::JointKind::BallAndSocket);
            limit.up = limit.down = limit.left = limit.right = radians(120);
        }
        arm.limits.push_back(limit);
    }
    return arm;
}

/// Rotation of a joint from rest, radians.
double turn_of(std::span<const glm::quat> rotations, std::size_t joint) {
    const glm::dmat3 m = local_turn(rotations, joint);
    return std::acos(std::clamp(0.5 * (m[0][0] + m[1][1] + m[2][2] - 1.0), -1.0, 1.0));
}

struct Outcome {
    double stiff = 0.0, others = 0.0;  ///< mean rotations, degrees
    int arrived = 0;
};

constexpr int targets = 200;
constexpr std::size_t stiff_joint = 2;

Outcome outcome(Method method, bool cones, float stiffness) {
    Random random(5);
    Arm arm = bow(cones);
    arm.limits[stiff_joint].stiffness = stiffness;
    Outcome result;
    for (int k = 0; k < targets; ++k) {
        Joints joints = arm.at_rest();
        // Well within reach, as a straight chain has only one pose.
        const glm::vec3 target = 0.75f * joints.back() + random.point(0.4f);
        KeptSolver solver = arm.solver();
        ik::Options options{.max_iterations = 1000, .limits = arm.limits};
        const ik::Report report = solver.solve(method, joints, target, options);
        result.arrived += report.status == Status::Converged;
        EXPECT_TRUE(WithinLimits(arm, joints, solver.rotations())) << k;
        for (std::size_t i = 0; i < arm.lengths.size(); ++i) {
            const double turn = degrees(turn_of(solver.rotations(), i)) / targets;
            (i == stiff_joint ? result.stiff : result.others) += turn;
        }
    }
    return result;
}

TEST(IkStiffness, StiffJointsTurnLessOthersMoreAndTheTipArrives) {
    for (const Method method : {Method::Fabrik, Method::FabrikPlain, Method::Ccd, Method::JacobianTranspose,
                                Method::Dls, Method::SvdDls})
        for (const bool cones : {false, true}) {
            SCOPED_TRACE(std::string(ik::name(method)) + (cones ? ", cones" : ", free"));
            std::vector<Outcome> all;
            for (const float stiffness : stiffnesses) all.push_back(outcome(method, cones, stiffness));
            for (std::size_t i = 1; i < all.size(); ++i) {
                EXPECT_LT(all[i].stiff, 0.75 * all[i - 1].stiff) << stiffnesses[i];
                EXPECT_GE(all[i].arrived, all[0].arrived - targets / 50) << stiffnesses[i];
            }
            EXPECT_LT(all.back().stiff, 0.1 * all.front().stiff);
            EXPECT_GT(all.back().others, all.front().others);
        }
}

/// Stiff joints still turn if they must: every reachable target is reached.
TEST(IkStiffness, NoStiffnessKeepsATargetOutOfReach) {
    Random random(9);
    int reached = 0, reached_stiff = 0;
    for (int k = 0; k < 600; ++k) {
        Arm arm = some_arm(random, 2 + random.below(4));
        const glm::vec3 target = some_tip(arm, random);
        for (const bool stiff : {false, true}) {
            for (Limit& each : arm.limits) each.stiffness = stiff ? between(random, 0.0f, 0.99f) : 0.0f;
            Joints joints = arm.at_rest();
            KeptSolver solver = arm.solver();
            ik::Options options{.max_iterations = 1000, .limits = arm.limits};
            const ik::Report report = solver.solve(Method::Fabrik, joints, target, options);
            (stiff ? reached_stiff : reached) += report.status == Status::Converged;
            EXPECT_TRUE(WithinLimits(arm, joints, solver.rotations())) << k;
        }
    }
    EXPECT_GE(reached, 597);
    EXPECT_GE(reached_stiff, reached - 3);
}

/// Only differences of stiffness count.
TEST(IkStiffness, EquallyStiffJointsAreSolvedLikeFreeOnes) {
    Random random(21);
    for (const Method method : {Method::Fabrik, Method::FabrikPlain, Method::Ccd, Method::JacobianTranspose,
                                Method::Dls, Method::SvdDls}) {
        Arm arm = some_arm(random, 4);
        const glm::vec3 target = some_tip(arm, random);
        Joints plain = arm.at_rest(), stiff = plain;
        for (Joints* const joints : {&plain, &stiff}) {
            for (Limit& each : arm.limits) each.stiffness = joints == &stiff ? ik::max_stiffness : 0.0f;
            KeptSolver solver = arm.solver();
            ik::Options options{.limits = arm.limits};
            solver.solve(method, *joints, target, options);
        }
        EXPECT_TRUE(same_bits(plain, stiff)) << ik::name(method);
    }
}

/// A pose in which only stiff joints can turn towards the target is not singular: it is not perturbed.
TEST(IkStiffness, AStiffLimbIsNotMistakenForAStraightOne) {
    Arm arm{{0.5f, 0.5f, 0.5f}, {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, std::vector<Limit>(3)};
    arm.limits[1].stiffness = ik::max_stiffness;
    Joints joints{{0, 0, 0}, {0.5f, 0, 0}, {0.5f, 0.5f, 0}, {0.8f, 0.9f, 0}};
    const Joints before = joints;
    KeptSolver solver = arm.solver();
    ik::Options options{.max_iterations = 1, .limits = arm.limits};
    solver.solve(Method::Dls, joints, before.back() + glm::vec3(0.01f, 0.01f, 0), options);
    for (std::size_t i = 0; i < joints.size(); ++i) EXPECT_LT(distance(joints[i], before[i]), 0.05) << i;
}

TEST(IkStiffness, IsCheckedForEveryKind) {
    for (const ik::JointKind kind : {ik::JointKind::Free, ik::JointKind::Hinge, ik::JointKind::Saddle}) {
        Limit limit = Limit::of(kind);
        limit.stiffness = ik::max_stiffness;
        EXPECT_EQ(fault(limit), nullptr);
        for (const float bad : {-0.01f, 1.0f, std::numeric_limits<float>::infinity(), std::nanf("")}) {
            limit.stiffness = bad;
            ASSERT_NE(fault(limit), nullptr);
            EXPECT_TRUE(says(fault(limit), "stiffness 0 0.99"));
        }
    }
}

}  // namespace
}  // namespace tendril::test::ik_stiffness_test
