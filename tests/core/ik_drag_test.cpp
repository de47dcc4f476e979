// Dragging a target against limits: the chain follows from its state, without jumps or restarts.
#include "ik_hostile.hpp"
#include "ik_limit_support.hpp"

namespace tendril::test::ik_drag_test {
namespace {

using ik::Method;
using ik::Status;

/// A target beyond an arm's limits, and the arm after a solve from rest.
struct LimitedTarget {
    Arm arm;
    glm::vec3 target{0.0f};
    KeptSolver solver;
    Joints joints;
};

LimitedTarget some_limited_target(Random& random) {
    for (;;) {
        const Arm arm = some_arm(random, 2 + random.below(7));
        LimitedTarget it{arm, some_offset(random, 0.1f * arm.reach(), 0.95f * arm.reach()), arm.solver(),
                         arm.at_rest()};
        const ik::Report report =
            it.solver.solve(Method::Fabrik, it.joints, it.target, {.limits = arm.limits});
        if (report.status == Status::Limited && report.residual > 0.1f * arm.reach()) return it;
    }
}

double furthest_moved(const Joints& from, const Joints& to) {
    double furthest = 0.0;
    for (std::size_t i = 0; i < to.size(); ++i) furthest = std::max(furthest, distance(from[i], to[i]));
    return furthest;
}

TEST(IkDrag, NoJointMovesFurtherThanTwentyTimesTheTargetAndTheTolerance) {
    Random random(given_seed());
    int frames = 0, bent = 0, worst = 0;
    for (int k = 0; k < 150 && !HasFailure(); ++k) {
        LimitedTarget it = some_limited_target(random);
        const ik::Options options{.limits = it.arm.limits};
        const float step = it.arm.reach() * (random.chance(3) ? 0.0f : between(random, 1e-4f, 5e-3f));
        const glm::vec3 by = some_direction(random) * step;
        for (int i = 0; i < 150; ++i, ++frames) {
            const Joints before = it.joints;
            it.target += by;
            const ik::Report report = it.solver.solve(Method::Fabrik, it.joints, it.target, options);
            EXPECT_EQ(report.restarts, 0);
            EXPECT_TRUE(WithinLimits(it.arm, it.joints, it.solver.rotations()));
            bent += report.perturbations > 0;  // a singular pose cannot be left by a small step
            if (report.perturbations > 0) continue;
            const double moved = furthest_moved(before, it.joints);
            EXPECT_LE(moved, 20.0 * (step + 1e-3 * it.arm.reach()) * 1.001) << k << " " << i;
            worst = std::max(worst, static_cast<int>(moved / (step + 1e-3 * it.arm.reach())));
        }
    }
    std::printf("%d frames, at most %d times, bent in %d\n", frames, worst, bent);
    EXPECT_LE(bent, frames / 100);
}

TEST(IkDrag, AStillTargetMovesNothing) {
    Random random(given_seed() + 1);
    int still = 0, limited = 0;
    for (int k = 0; k < 200; ++k) {
        LimitedTarget it = some_limited_target(random);
        const ik::Options options{.limits = it.arm.limits};
        for (int i = 0; i < 100; ++i) it.solver.solve(Method::Fabrik, it.joints, it.target, options);
        const Joints before = it.joints;
        const ik::Status status = it.solver.solve(Method::Fabrik, it.joints, it.target, options).status;
        limited += status == Status::Limited;
        still += furthest_moved(before, it.joints) <= 1e-4 * it.arm.reach();
    }
    EXPECT_GE(still, 198);
    EXPECT_GE(limited, 190);
}

/// Restarts in each frame would find better poses, and jump to them. The average gain must be small.
TEST(IkDrag, FollowsAboutAsCloselyAsASearchInEveryFrame) {
    Random random(given_seed() + 2);
    double followed = 0.0, searched = 0.0;
    for (int k = 0; k < 40; ++k) {
        LimitedTarget it = some_limited_target(random);
        Joints other = it.joints;
        ik::State state = it.solver.state;
        const glm::vec3 by = some_direction(random) * (1e-3f * it.arm.reach());
        for (int i = 0; i < 60; ++i) {
            it.target += by;
            const float reach = it.arm.reach();
            followed +=
                it.solver.solve(Method::Fabrik, it.joints, it.target, {.limits = it.arm.limits}).residual /
                reach;
            std::swap(state, it.solver.state);
            const ik::Report report =
                it.solver.solve(Method::Fabrik, other, it.target, {.limits = it.arm.limits, .restarts = 8});
            searched += report.residual / reach;
            std::swap(state, it.solver.state);
        }
    }
    EXPECT_LE(followed, 1.15 * searched);
}

/// The last solve is not repeated: neither its verdict, nor the result of FABRIK's passes.
TEST(IkDrag, AFrameOfAnUnreachableTargetIsOneIteration) {
    Random random(given_seed() + 3);
    int frames = 0, iterations = 0, limited = 0;
    for (int k = 0; k < 100; ++k) {
        LimitedTarget it = some_limited_target(random);
        const glm::vec3 by = some_direction(random) * (1e-3f * it.arm.reach());
        for (int i = 0; i < 60; ++i) {
            it.target += by;
            const ik::Report report =
                it.solver.solve(Method::Fabrik, it.joints, it.target, {.limits = it.arm.limits});
            if (report.status == Status::Converged) break;
            if (i < 10) continue;  // restarts may end with a little left to gain
            ++frames;
            iterations += report.iterations;
            limited += report.status == Status::Limited;
        }
    }
    std::printf("%d frames, %d iterations, %d limited\n", frames, iterations, limited);
    EXPECT_LE(iterations, 1.1 * frames);
    EXPECT_GE(limited, 0.95 * frames);
}

/// From the last solution, one least-squares step replaces several FABRIK passes.
TEST(IkDrag, AFrameOfATargetWithinTheLimitsIsOneIterationOrLess) {
    Random random(given_seed() + 4);
    int frames = 0, arrived = 0, iterations = 0;
    for (int k = 0; k < 100; ++k) {
        const Arm arm = some_arm(random, 3 + random.below(20));
        KeptSolver solver = arm.solver();
        Joints start = arm.at_rest();
        const glm::vec3 a = some_tip(arm, random);
        const glm::vec3 b = some_tip(arm, random);
        if (solver.solve(Method::Fabrik, start, a, {.limits = arm.limits}).status != Status::Converged)
            continue;
        const ik::State state = solver.state;
        KeptSolver between = arm.solver();
        Joints joints = start;
        for (int i = 1; i <= 40; ++i, ++frames) {
            Joints part = start;
            between.state = state;  // a pose within the limits, part of the way to another one
            between.solve(Method::Fabrik, part, b,
                          {.limits = arm.limits, .weight = 0.005f * static_cast<float>(i)});
            const ik::Report report =
                solver.solve(Method::Fabrik, joints, part.back(), {.limits = arm.limits});
            iterations += report.iterations;
            arrived += report.status == Status::Converged;
        }
    }
    std::printf("%d frames, %d iterations, %d arrived\n", frames, iterations, arrived);
    EXPECT_LE(iterations, 1.1 * frames);
    EXPECT_GE(arrived, 0.98 * frames);
}

TEST(IkDrag, AGivenNumberOfRestartsHoldsInEverySolve) {
    Random random(3);
    int restarted = 0;
    for (int k = 0; k < 20; ++k) {
        LimitedTarget it = some_limited_target(random);
        it.target += some_direction(random) * (1e-3f * it.arm.reach());
        Joints other = it.joints;
        ik::State state = it.solver.state;
        EXPECT_EQ(it.solver.solve(Method::Fabrik, it.joints, it.target, {.limits = it.arm.limits}).restarts,
                  0);
        it.solver.state = state;
        restarted +=
            it.solver.solve(Method::Fabrik, other, it.target, {.limits = it.arm.limits, .restarts = 3})
                .restarts > 0;
    }
    EXPECT_GE(restarted, 18);
}

TEST(IkDrag, AJumpOfTheTargetOrOfThePoseStartsANewSearch) {
    Random random(4);
    int after_jump = 0, after_move = 0;
    for (int k = 0; k < 20; ++k) {
        LimitedTarget it = some_limited_target(random);
        const ik::Options options{.limits = it.arm.limits};
        const ik::State state = it.solver.state;
        const Joints as_left = it.joints;
        it.joints = it.arm.at_rest();
        after_move += it.solver.solve(Method::Fabrik, it.joints, it.target, options).restarts > 0;
        it.joints = as_left, it.solver.state = state;
        const glm::vec3 away = it.target * 1.2f + glm::vec3(0, 0.1f, 0) * it.arm.reach();
        after_jump += it.solver.solve(Method::Fabrik, it.joints, away, options).restarts > 0;
    }
    EXPECT_GE(after_move, 15);
    EXPECT_GE(after_jump, 5);
}

}  // namespace
}  // namespace tendril::test::ik_drag_test
