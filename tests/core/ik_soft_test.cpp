// The soft zone: the chain slows before it is straight, without jumps, and reports the true residual.
#include "ik_support.hpp"

namespace tendril::test::ik_soft_test {
namespace {

using ik::Method;
using ik::Report;
using ik::Status;

const Lengths lengths(4, 1.0f);

struct Result {
    Report report;
    double out;  ///< distance of the tip from its root
};

Result reach_for(float distance_from_root, float zone) {
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths, {0, 1, 0});
    const glm::vec3 target(distance_from_root, 0, 0);
    const Report report =
        solver.solve(Method::Fabrik, joints, target, {.tolerance = 1e-5f, .soft_zone = zone});
    EXPECT_NEAR(report.residual, distance(joints.back(), target), 1e-5);
    EXPECT_TRUE(Holds(joints, lengths));
    return {report, distance(joints.back(), joints.front())};
}

TEST(IkSoftReach, NothingChangesBeforeTheZone) {
    for (const float far : {0.5f, 2.0f, 3.19f}) {
        const Result result = reach_for(far, 0.2f);
        EXPECT_EQ(result.report.status, Status::Converged) << far;
        EXPECT_NEAR(result.out, far, 2e-5);
    }
}

TEST(IkSoftReach, InTheZoneItStaysShortAndReportsIt) {
    for (const float far : {3.5f, 3.9f, 4.0f, 5.0f, 100.0f}) {
        const Result result = reach_for(far, 0.2f);
        EXPECT_EQ(result.report.status, Status::Stretched) << far;
        EXPECT_LT(result.out, 4.0);
        EXPECT_NEAR(result.report.residual, static_cast<double>(far) - result.out, 1e-4);
        // The curve in the header, with a = 3.2 and z = 0.8.
        const double x = (static_cast<double>(far) - 3.2) / 0.8;
        EXPECT_NEAR(result.out, 3.2 + 0.8 * x / std::sqrt(1.0 + x * x), 1e-4);
    }
}

TEST(IkSoftReach, IsContinuousAndNeverSnaps) {
    double before = reach_for(2.7f, 0.3f).out, step_before = 0.01;
    for (int i = 1; i <= 300; ++i) {
        const double out = reach_for(2.7f + 0.01f * static_cast<float>(i), 0.3f).out;
        const double step = out - before;
        if (out < 3.99) {  // beyond, steps are rounding errors
            EXPECT_GT(step, 0.0) << i;
        }
        EXPECT_LE(step, 0.0101) << i;
        EXPECT_NEAR(step, step_before, 3e-4) << i;  // the slope is continuous, too
        before = out, step_before = step;
    }
    EXPECT_LT(before, 4.0);
}

TEST(IkSoftReach, WithoutAZoneItSnaps) {
    EXPECT_EQ(reach_for(4.2f, 0.0f).report.status, Status::Stretched);
    EXPECT_NEAR(reach_for(4.2f, 0.0f).out, 4.0, 1e-5);
}

TEST(IkSoftReach, TheWholeReachMayBeSoftWithoutFoldingTooFar) {
    const Lengths heavy{2.0f, 0.3f};
    KeptSolver solver(heavy);
    for (const float far : {0.2f, 1.0f, 1.6f, 1.71f, 1.8f, 2.2f, 9.0f}) {
        Joints joints = straight_joints(heavy);
        const Report report = solver.solve(Method::Fabrik, joints, {0, far, 0}, {.soft_zone = 1.0f});
        EXPECT_TRUE(Holds(joints, heavy));
        EXPECT_NEAR(report.residual, distance(joints.back(), {0, far, 0}), 1e-5);
        if (far < 1.7f) {
            EXPECT_EQ(report.status, Status::TooClose) << far;
        }
    }
}

}  // namespace
}  // namespace tendril::test::ik_soft_test
