// Chains on a line with their target, within limits: every descent method leaves the line if the limits allow
// it, and a limit is blamed only if it keeps the tip from the target.
#include "ik_hostile.hpp"
#include "ik_limit_support.hpp"

namespace tendril::test::ik_singular_test {
namespace {

using ik::Limit;
using ik::Method;
using ik::Status;

constexpr std::array numerical_methods{Method::JacobianTranspose, Method::Dls, Method::SvdDls};

Arm straight_arm(const Lengths& lengths, const std::vector<Limit>& limits) {
    return {lengths, Joints(lengths.size(), glm::vec3(1, 0, 0)), limits};
}

struct Solved {
    ik::Report report;
    Joints joints;
    std::vector<glm::quat> rotations;
};

Solved solved(const Arm& arm, Method method, glm::vec3 target, int most = 100) {
    KeptSolver solver = arm.solver();
    Joints joints = arm.at_rest();
    const ik::Report report =
        solver.solve(method, joints, target, {.max_iterations = most, .limits = arm.limits});
    EXPECT_TRUE(WithinLimits(arm, joints, solver.rotations())) << name(method);
    return {report, joints, {solver.rotations().begin(), solver.rotations().end()}};
}

TEST(IkSingular, ReachesATargetBehindAOneSidedHinge) {
    const glm::vec3 target{-1.9f, 0, 0};
    for (const glm::vec3 axis : {glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::vec3(0, -0.6f, 0.8f)}) {
        for (const bool positive : {true, false}) {
            for (const std::size_t hinge : {1u, 2u}) {
                std::vector<Limit> limits(3);
                limits[hinge] = Limit::hinge(axis, positive ? 0 : radians(-45), positive ? radians(45) : 0);
                const Arm arm = straight_arm({1, 1, 1}, limits);
                for (const Method method : iterating_methods) {
                    SCOPED_TRACE(std::string(name(method)) + (positive ? " +" : " -"));
                    const ik::Report report = solved(arm, method, target).report;
                    if (method == Method::FabrikPlain) {  // stalls on the line
                        EXPECT_NE(report.status, Status::Limited);
                        continue;
                    }
                    EXPECT_EQ(report.status, Status::Converged);
                    EXPECT_LE(report.iterations, method == Method::JacobianTranspose ? 80 : 30);
                }
            }
        }
    }
}

TEST(IkSingular, ALockedJointLeavesTheMotionToTheOthers) {
    const Limit locked = Limit::hinge({0, 0, 1}, 0, 0), elbow = Limit::hinge({0, 1, 0}, 0, radians(145));
    const Arm arm = straight_arm({1, 0.5f, 1}, {Limit(), locked, elbow});
    for (const Method method : numerical_methods)
        for (const float at : {-1.9f, -1.0f, 1.0f, 1.9f})
            EXPECT_EQ(solved(arm, method, {at, 0, 0}, 200).report.status, Status::Converged)
                << name(method) << " " << at;
}

TEST(IkSingular, AnOffPlaneTargetIsApproachedWithinTheHingesPlane) {
    // The tip has to come back within the plane; only the limits forbid more.
    const Arm arm =
        straight_arm({1, 1, 1}, std::vector<Limit>(3, Limit::hinge({0, 0, 1}, radians(-90), radians(90))));
    for (const Method method : numerical_methods) {
        const ik::Report report = solved(arm, method, {1.5f, 0, 0.4f}, 200).report;
        EXPECT_EQ(report.status, Status::Limited) << name(method);
        EXPECT_NEAR(report.residual, 0.4f, 5e-3f) << name(method);
    }
}

TEST(IkSingular, LimitsThatDoHoldTheTipAreReported) {
    const Limit stiff = Limit::of(ik::JointKind::Suture);
    // It points at the target but cannot fold; no first derivative shows that the limit holds it.
    const Arm arm = straight_arm({1, 1}, {Limit(), stiff});
    for (const Method method : iterating_methods) {
        for (const float at : {-0.8f, 0.8f}) {
            const bool plain = method == Method::FabrikPlain;  // stays on the line
            const ik::Report report = solved(arm, method, {at, 0, 0}).report;
            EXPECT_EQ(report.status, Status::Limited) << name(method) << " " << at;
            EXPECT_NEAR(report.residual, at < 0 && plain ? 2.8f : 1.2f, 1e-2f);
        }
    }
}

TEST(IkSingular, LimitsWithoutEffectAreNotBlamed) {
    Random random(given_seed());
    for (int k = 0; k < 300; ++k) {
        const Lengths lengths = some_lengths(1 + random.below(6), random);
        const Arm arm = straight_arm(lengths, std::vector<Limit>(lengths.size()));
        const glm::vec3 target{arm.reach() * random.around(1.2f), 0, 0};
        for (const Method method : iterating_methods)
            EXPECT_NE(solved(arm, method, target).report.status, Status::Limited) << name(method);
    }
}

Arm some_straight_arm(Random& random) {
    Arm arm = some_arm(random, 2 + random.below(5));
    for (std::size_t i = 0; i < arm.limits.size(); ++i) {
        arm.rest[i] = {1, 0, 0};
        if (random.chance(3))
            arm.limits[i] = Limit();
        else
            arm.limits[i].axis = some_axis(random, arm.rest[i]);
    }
    return arm;
}

TEST(IkSingular, OutOfReachAStraightArmsLimitsAreNotBlamed) {
    Random random(given_seed());
    int stretched = 0, blaming = 0;
    for (int k = 0; k < 500; ++k) {
        const Arm arm = some_straight_arm(random);
        const glm::vec3 target = some_offset(random, 1.01f * arm.reach(), 3.0f * arm.reach());
        if (solved(arm, Method::Fabrik, target).report.status != Status::Stretched) continue;
        ++stretched;
        for (const Method method : iterating_methods)
            blaming += solved(arm, method, target).report.status == Status::Limited;
    }
    EXPECT_GE(stretched, 100);
    EXPECT_LE(blaming, stretched / 20);
}

/// Results of a method for targets that the default method reaches.
struct Count {
    int there = 0;
    int blaming = 0;  ///< ended as Limited
    int unjust = 0;   ///< of these, those that least squares still solves
};

struct Counts {
    int reached = 0;
    std::array<Count, iterating_methods.size()> by{};
};

bool goes_on(Method method, const Arm& arm, const Solved& from, glm::vec3 target,
             std::span<const Limit> limits) {
    Joints joints = from.joints;
    KeptSolver solver = arm.solver();
    solver.set_rotations(from.rotations);
    return solver.solve(method, joints, target, {.limits = limits}).status == Status::Converged;
}

Counts count_on_the_line(bool ahead, int arms, std::uint64_t seed) {
    Random random(seed);
    Counts counts;
    for (int k = 0; k < arms; ++k) {
        const Arm arm = some_straight_arm(random);
        const float away = between(random, 0.0f, 0.98f) * arm.reach();
        const glm::vec3 target{ahead ? away : -away, 0, 0};
        if (solved(arm, Method::Fabrik, target, 200).report.status != Status::Converged) continue;
        ++counts.reached;
        for (std::size_t m = 0; m < iterating_methods.size(); ++m) {
            SCOPED_TRACE(name(iterating_methods[m]) + std::to_string(k));
            const Solved one = solved(arm, iterating_methods[m], target, 200);
            counts.by[m].there += one.report.status == Status::Converged;
            if (one.report.status != Status::Limited) continue;
            ++counts.by[m].blaming;
            counts.by[m].unjust += goes_on(Method::Dls, arm, one, target, arm.limits);
            EXPECT_TRUE(goes_on(Method::Fabrik, arm, one, target, {}));  // without limits, nothing holds it
        }
    }
    return counts;
}

TEST(IkSingular, RandomArmsOnTheLineReachAndBlameFewLimits) {
    for (const bool ahead : {false, true}) {
        const Counts counts = count_on_the_line(ahead, 1000, given_seed() + ahead);
        EXPECT_GE(counts.reached, 500);
        for (std::size_t m = 0; m < iterating_methods.size(); ++m) {
            const Method method = iterating_methods[m];
            const Count& by = counts.by[m];
            SCOPED_TRACE(std::string(name(method)) + (ahead ? " ahead" : " behind"));
            if (method == Method::Fabrik) {
                EXPECT_EQ(by.blaming, 0);
                continue;
            }
            const bool plain = method == Method::FabrikPlain;
            EXPECT_GE(by.there, counts.reached * (plain ? 20 : 80) / 100) << "of " << counts.reached;
            // The limits led these into another pose, where they do keep the tip from the target.
            EXPECT_LE(by.blaming, counts.reached * (plain ? 20 : 12) / 100) << "of " << counts.reached;
            EXPECT_LE(by.unjust, counts.reached * 3 / 100) << "of " << counts.reached;
        }
    }
}

}  // namespace
}  // namespace tendril::test::ik_singular_test
