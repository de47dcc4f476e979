// FABRIK and the loop around every method: the two passes by hand, reachability, collinear singularities,
// snap-back, the soft zone, and the pose kept if nothing helps.
#include "ik_support.hpp"

namespace tendril::test::ik_fabrik_test {
namespace {

using ik::Method;
using ik::Options;
using ik::Report;
using ik::Status;

void expect_near(const Joints& joints, const Joints& expected, double tolerance = 1e-5) {
    ASSERT_EQ(joints.size(), expected.size());
    for (std::size_t i = 0; i < joints.size(); ++i)
        EXPECT_LE(distance(joints[i], expected[i]), tolerance)
            << "joint " << i << " is at " << joints[i].x << ' ' << joints[i].y << ' ' << joints[i].z;
}

TEST(IkFabrik, OneIterationIsTwoPulls) {
    KeptSolver solver(Lengths{5.0f, 5.0f});
    Joints joints{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}};
    // Forward reaching: the tip goes to (2, 4); joint 1 to 5 from it towards (5, 0), which is (5, 0) itself;
    // the root to 5 from there, its old position. Backward reaching then changes only the tip.
    const Report report = solver.solve(Method::FabrikPlain, joints, {2, 4, 0}, {.max_iterations = 1});
    expect_near(joints, {{0, 0, 0}, {5, 0, 0}, {2, 4, 0}});
    EXPECT_EQ(report, (Report{Status::Converged, 1, report.residual}));
    EXPECT_LE(report.residual, 1e-5f);
}

TEST(IkFabrik, AReachedTargetMovesNothing) {
    const Lengths lengths{1.0f, 2.0f, 0.5f};
    Random random(1);
    for (const Method method : iterating_methods) {
        KeptSolver solver(lengths);
        const Joints start = some_pose(lengths, random);
        Joints joints = start;
        const Report report = solver.solve(method, joints, start.back());
        EXPECT_EQ(report, (Report{Status::Converged, 0, 0.0f})) << name(method);
        EXPECT_TRUE(same_bits(joints, start));
    }
}

TEST(IkFabrik, OutOfReachTheChainLiesStraight) {
    Random random(2);
    for (int i = 0; i < 500; ++i) {
        const Lengths lengths = some_lengths(1 + random.below(40), random);
        const double reach = reach_of(lengths);
        const glm::vec3 root = random.point(10.0f), towards = some_direction(random);
        const double beyond = static_cast<double>(between(random, 0.001f, 20.0f));
        const glm::vec3 target = root + towards * static_cast<float>(reach + beyond);
        Joints joints = some_pose(lengths, random, root);
        KeptSolver solver(lengths);
        const Report report =
            solver.solve(iterating_methods[random.below(iterating_methods.size())], joints, target);
        EXPECT_EQ(report.status, Status::Stretched);
        EXPECT_EQ(report.iterations, 0);
        EXPECT_NEAR(report.residual, distance(root, target) - reach, 1e-4);
        EXPECT_NEAR(distance(joints.back(), target), distance(root, target) - reach, 1e-4);
        EXPECT_TRUE(Holds(joints, lengths));
        EXPECT_TRUE(same_bits(joints.front(), root));
    }
}

TEST(IkFabrik, AMillionTimesFurtherGivesTheSameStraightLine) {
    const Lengths lengths(10, 1.0f);
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths, {0, 1, 0});
    const Report report = solver.solve(Method::Fabrik, joints, {0, 0, 1e9f});
    EXPECT_EQ(report.status, Status::Stretched);
    expect_near(joints, straight_joints(lengths, {0, 0, 1}));
}

TEST(IkFabrik, TooCloseTheOtherBonesFoldBackAlongTheLongest) {
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        Lengths lengths = some_lengths(1 + random.below(8), random);
        const std::size_t longest = random.below(lengths.size());
        lengths[longest] += 1.1f * static_cast<float>(reach_of(lengths));
        const double nearest = 2.0 * static_cast<double>(lengths[longest]) - reach_of(lengths);
        const double off = random.chance(4) ? 0.0 : static_cast<double>(part(random)) * 0.99 * nearest;
        Joints joints = some_pose(lengths, random);
        const Joints start = joints;
        KeptSolver solver(lengths);
        const glm::vec3 target = some_direction(random) * static_cast<float>(off);
        const Report report =
            solver.solve(iterating_methods[random.below(iterating_methods.size())], joints, target);
        EXPECT_EQ(report.status, Status::TooClose);
        EXPECT_NEAR(report.residual, nearest - off, 0.01 * (nearest - off));
        EXPECT_NEAR(distance(joints.back(), target), nearest - off, 0.01 * (nearest - off));
        EXPECT_TRUE(Holds(joints, lengths));
        Joints again = start;
        solver.solve(Method::Fabrik, again, target);
        EXPECT_TRUE(same_bits(again, joints));
    }
}

TEST(IkFabrik, ATargetAtTheRootLeavesAFoldedChainInPlace) {
    const Lengths lengths{3.0f, 0.5f, 0.5f};
    KeptSolver solver(lengths);
    for (const glm::vec3 along : {glm::vec3(0, 1, 0), glm::vec3(0, -0.6f, 0.8f)}) {
        const Joints folded{{0, 0, 0}, along * 3.0f, along * 2.5f, along * 2.0f};
        Joints joints = folded;
        EXPECT_EQ(solver.solve(Method::Fabrik, joints, {0, 0, 0}).status, Status::TooClose);
        expect_near(joints, folded);
    }
}

/// Starts straight or folded on the line through the target, in any direction, from any root.
TEST(IkFabrik, EveryStartOnTheLineConverges) {
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const Lengths lengths = random.chance(2) ? some_lengths(2 + random.below(14), random)
                                                 : Lengths(2 + random.below(14), 1.0f);
        const auto reach = static_cast<float>(reach_of(lengths));
        const float nearest =
            std::max(0.0f, 2.0f * *std::max_element(lengths.begin(), lengths.end()) - reach);
        const glm::vec3 along = random.chance(3) ? glm::vec3(1, 0, 0) : some_direction(random);
        const glm::vec3 root = random.chance(2) ? glm::vec3(0) : random.point(8.0f);
        Joints joints{root};
        const bool folds = random.chance(2);
        for (const float length : lengths)
            joints.push_back(joints.back() + along * (folds && random.chance(2) ? -length : length));
        const float off = random.chance(4) ? between(random, 0.0f, 0.01f) : part(random);
        const float far = (nearest + (reach - nearest) * off) * (random.chance(2) ? -1.0f : 1.0f);
        // Starts slightly off the line are as hard: by a thousandth of the reach, or a millionth.
        const float beside = random.chance(2) ? 0.0f : (random.chance(2) ? 1e-3f : 1e-6f) * reach;
        const glm::vec3 target = root + along * far + some_direction(random) * beside;
        KeptSolver solver(lengths);
        const Report report = solver.solve(Method::Fabrik, joints, target);
        EXPECT_LE(report.residual, 1.01e-3f * reach + beside)
            << name(report.status) << ", case " << i << ", " << lengths.size() << " bones";
        EXPECT_TRUE(Holds(joints, lengths));
    }
}

TEST(IkFabrik, ThePerturbationIsTowardsThePole) {
    const Lengths lengths(4, 1.0f);
    for (const glm::vec3 pole : {glm::vec3(1, 5, 0), glm::vec3(1, -5, 0), glm::vec3(2, 0, 3)}) {
        KeptSolver solver(lengths);
        Joints joints = straight_joints(lengths);
        const Report report = solver.solve(Method::Fabrik, joints, {3, 0, 0}, {.pole = pole});
        EXPECT_EQ(report.status, Status::Converged);
        const glm::vec3 off(0, joints[2].y, joints[2].z), side(0, pole.y, pole.z);
        EXPECT_GT(off.y * side.y + off.z * side.z,
                  0.95f * std::hypot(off.y, off.z) * std::hypot(side.y, side.z));
    }
}

TEST(IkFabrik, SnapBackStartsCloserToRest) {
    const Lengths lengths(3, 1.0f);
    const std::array<glm::vec3, 3> rest{{{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}};
    KeptSolver solver(lengths, rest);
    const Joints start{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    Joints joints = start;
    // At 1: the rest pose, which already reaches the target.
    EXPECT_EQ(solver.solve(Method::Fabrik, joints, {0, 3, 0}, {.snap_back = 1.0f}).iterations, 0);
    expect_near(joints, straight_joints(lengths, {0, 1, 0}));
    // At 0.5, the first joint is at (0.5, 0.5) from the root, scaled to its length.
    Recorder recorder;
    joints = start;
    solver.solve(Method::FabrikPlain, joints, {1, 1, 1}, {.snap_back = 0.5f}, &recorder);
    ASSERT_FALSE(recorder.steps.empty());
    EXPECT_EQ(recorder.steps.front().phase, ik::Phase::Prepare);
    EXPECT_LE(distance(recorder.steps.front().to, {std::sqrt(0.5f), std::sqrt(0.5f), 0.0f}), 1e-6);
}

TEST(IkFabrik, EveryIterationRunsAndReportsItsResidual) {
    const Lengths lengths(5, 1.0f);
    KeptSolver solver(lengths);
    Joints joints = straight_joints(lengths, {0, 1, 0});
    std::array<float, 8> residuals;
    residuals.fill(-1.0f);
    Options options{.max_iterations = 6, .every_iteration = true, .residuals = residuals};
    const Report report = solver.solve(Method::FabrikPlain, joints, {2, 1, 1}, options);
    EXPECT_EQ(report.status, Status::Converged);
    EXPECT_EQ(report.iterations, 6);
    EXPECT_EQ(residuals[5], report.residual);
    EXPECT_EQ(residuals[6], -1.0f);
    for (int i = 0; i < 6; ++i) EXPECT_GE(residuals[static_cast<std::size_t>(i)], 0.0f);
    // A shorter buffer is filled to its end.
    residuals.fill(-1.0f);
    options.residuals = std::span(residuals).first(2);
    solver.solve(Method::FabrikPlain, joints, {-2, 1, 1}, options);
    EXPECT_GE(residuals[1], 0.0f);
    EXPECT_EQ(residuals[2], -1.0f);
}

TEST(IkFabrik, TornChainsAreLaidToTheirLengthsFirst) {
    const Lengths lengths{1.0f, 1.0f, 0.0f, 1.0f};
    KeptSolver solver(lengths);
    Joints broken{{0, 0, 0}, {0, 7, 0}, {0, 7, 3}, {9, 9, 9}, {9, 9, 9}};
    const Report report = solver.solve(Method::Fabrik, broken, {1.5f, 1, 0});
    EXPECT_EQ(report.status, Status::Converged);
    EXPECT_TRUE(Holds(broken, lengths));
    // All joints at one point: laid along the rest directions, then off the line.
    Joints heap(5, glm::vec3(2, 2, 2));
    EXPECT_EQ(solver.solve(Method::Fabrik, heap, {4, 2, 2}).status, Status::Converged);
    EXPECT_TRUE(Holds(heap, lengths));
}

TEST(IkFabrik, ASolveNeverEndsWorseThanItBegan) {
    Random random(5);
    for (int i = 0; i < 3000; ++i) {
        const Lengths lengths = some_lengths(2 + random.below(12), random);
        const auto reach = static_cast<float>(reach_of(lengths));
        const Method method = iterating_methods[random.below(iterating_methods.size())];
        Joints joints = some_pose(lengths, random);
        const glm::vec3 target = some_offset(random, 0.0f, reach);
        const double before = distance(joints.back(), target);
        KeptSolver solver(lengths);
        const Report report =
            solver.solve(method, joints, target, {.tolerance = 0.0f, .max_iterations = 1 + int(i % 5)});
        EXPECT_LE(distance(joints.back(), target), std::max(before, 1e-4)) << name(method);
        EXPECT_NEAR(report.residual, distance(joints.back(), target), 1e-5) << name(method);
    }
}

TEST(IkFabrik, ZeroBonesAndBonesOfNoLength) {
    KeptSolver none(Lengths{});
    Joints root{{1, 2, 3}};
    EXPECT_EQ(none.solve(Method::Fabrik, root, {1, 2, 3}), (Report{Status::Converged, 0, 0.0f, true}));
    EXPECT_EQ(none.solve(Method::Fabrik, root, {1, 2, 5}), (Report{Status::Stretched, 0, 2.0f, true}));
    const Lengths nothing(4, 0.0f);
    KeptSolver flat(nothing);
    for (const Method method : iterating_methods) {
        Joints joints(5, glm::vec3(1, 1, 1));
        EXPECT_EQ(flat.solve(method, joints, {1, 1, 4}), (Report{Status::Stretched, 0, 3.0f, true}))
            << name(method);
        EXPECT_TRUE(Holds(joints, nothing));
    }
}

TEST(IkFabrik, AChainGivesTheSameAsItsJoints) {
    Random random(6);
    for (int i = 0; i < 100; ++i) {
        const Lengths lengths = some_lengths(1 + random.below(10), random);
        Joints joints = some_pose(lengths, random);
        std::vector<Segment> segments{{joints.front(), 0.3f}};
        for (std::size_t j = 0; j < lengths.size(); ++j) segments.push_back({joints[j + 1], lengths[j]});
        Chain chain = *Chain::from_segments(segments);
        KeptSolver solver(chain);
        for (std::size_t j = 0; j < joints.size(); ++j) joints[j] = chain.position(j);
        const glm::vec3 target = random.point(4.0f);
        const Report of_chain = solver.solve(Method::Fabrik, chain, target);
        EXPECT_EQ(solver.solve(Method::Fabrik, joints, target), of_chain);
        for (std::size_t j = 0; j < joints.size(); ++j) EXPECT_TRUE(same_bits(chain.position(j), joints[j]));
        EXPECT_TRUE(Holds(chain));
    }
}

}  // namespace
}  // namespace tendril::test::ik_fabrik_test
