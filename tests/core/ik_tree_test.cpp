// A tree of chains and its effectors in cases with a known answer.

#include "ik_tree_support.hpp"
#include "kept_solver.hpp"

namespace tendril::test::ik_tree_test {
namespace {

std::string refusal(const TreeJointList& joints) {
    return Tree::make(joints).message();
}

TEST(IkTree, RefusesInvalidTrees) {
    EXPECT_TRUE(says(refusal({}), "Tree joints none"));
    EXPECT_TRUE(says(refusal({{0, 0.0f}}), "Tree joints[0].parent no_joint root 0"));
    EXPECT_TRUE(says(refusal({{no_joint, 0}, {1, 1}}), "Tree joints[1].parent before 1"));
    EXPECT_TRUE(says(refusal({{no_joint, 0}, {0, 1}, {7, 1}}), "Tree joints[2].parent before 7"));
    EXPECT_TRUE(says(refusal({{no_joint, 0}, {no_joint, 1}}), "Tree joints[1].parent before no_joint"));
    EXPECT_TRUE(says(refusal({{no_joint, 0}, {0, -1}}), "Tree joints[1].length finite 0 1e9 -1"));
}

TEST(IkTree, ReportsItsSizeAndReach) {
    const Tree tree = tree_of(body().joints);
    EXPECT_EQ(tree.size(), 15u);
    EXPECT_NEAR(tree.reach(), 4 * 0.15 + 0.18 + 0.3 + 0.27 + 0.1, 1e-6);
}

TreeJointList chain_of(std::size_t bones, float length = 1.0f) {
    TreeJointList joints = only_root();
    grow(joints, 0, std::vector<float>(bones, length));
    return joints;
}

TEST(IkTree, PlainOnOneChainIsPlainFabrik) {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const TreeJointList joints = chain_of(10, 0.1f);
        Tree tree = tree_of(joints);
        KeptSolver solver(std::vector<float>(10, 0.1f));
        Places a = random_pose(joints, random, 0.5f), b = a;
        const glm::vec3 direction = random_direction(random);
        const glm::vec3 target = direction * (0.1f + 0.4f * std::abs(random.around(2.0f)));
        const int count = 1 + static_cast<int>(random.below(10));
        tree.solve(a, std::vector<Effector>{{10, target}},
                   {.max_iterations = count, .every_iteration = true, .plain = true});
        solver.solve(ik::Method::FabrikPlain, b, target, {.max_iterations = count, .every_iteration = true});
        for (std::size_t k = 0; k < a.size(); ++k) ASSERT_LT(distance(a[k], b[k]), 1e-5) << i << ", " << k;
    }
}

TEST(IkTree, OneChainMatchesTheChainSolver) {
    Random random(4);
    for (int i = 0; i < 500; ++i) {
        const TreeJointList joints = chain_of(10, 0.1f);
        Tree tree = tree_of(joints);
        Places places = random_pose(joints, random, 0.5f);
        const glm::vec3 direction = random_direction(random);
        const glm::vec3 target = direction * (0.05f + 0.47f * std::abs(random.around(2.0f)));
        const TreeReport report = tree.solve(places, std::vector<Effector>{{10, target}});
        ASSERT_EQ(report.status, Status::Converged) << i;
        ASSERT_LE(report.iterations, 15) << i;  // FABRIK (2011) takes up to 312 so near the rim
        ASSERT_LE(distance(places[10], target), 1e-3);
        ASSERT_TRUE(Holds(joints, places));
    }
}

TEST(IkTree, OutOfReachItLiesStraight) {
    Tree tree = tree_of(chain_of(5));
    Random random(5);
    for (const float far : {5.02f, 6.0f, 100.0f, 1e6f}) {
        Places places = random_pose(chain_of(5), random, 0.3f);
        const glm::vec3 target = random_direction(random) * far;
        const TreeReport report = tree.solve(places, std::vector<Effector>{{5, target}});
        EXPECT_EQ(report.status, Status::Stretched);
        EXPECT_NEAR(static_cast<double>(report.residual), distance(target, {}) - 5.0,
                    1e-4 * std::max(1.0f, far));
        EXPECT_NEAR(distance(places[5], glm::vec3(0.0f)), 5.0, 1e-4);
    }
}

TEST(IkTree, TooCloseItFolds) {
    TreeJointList joints = only_root();
    grow(joints, 0, {1.0f, 5.0f, 1.0f});
    Tree tree = tree_of(joints);
    for (const glm::vec3 target : {glm::vec3(0.0f), glm::vec3(0, 0.5f, 0), glm::vec3(-2, 1, 1)}) {
        Places places = straight_pose(joints);
        const TreeReport report = tree.solve(places, std::vector<Effector>{{3, target}});
        EXPECT_EQ(report.status, Status::TooClose);
        EXPECT_NEAR(static_cast<double>(report.residual), 3.0 - distance(target, {}), 0.01 * 0.5);
        EXPECT_TRUE(Holds(joints, places));
    }
}

TEST(IkTree, ATargetOutOfReachDoesNotHinderTheOthers) {
    Figure figure = body();
    Tree tree = tree_of(figure.joints);
    Random random(6);
    int others = 0;
    for (int i = 0; i < 200; ++i) {
        // The left hand's path is straight from the root; the other targets are still reachable.
        const glm::vec3 away = random_direction(random);
        aim(figure.effectors, straight_pose(figure.joints, away));
        figure.effectors[0].target += random_direction(random) * 0.05f;
        figure.effectors[0].target *= 0.9f;
        figure.effectors[1].target *= 3.0f;
        figure.effectors[2].target *= 0.8f;
        Places places = random_pose(figure.joints, random, 0.5f);
        std::vector<float> residuals(3);
        const TreeReport report = tree.solve(places, figure.effectors, {.effector_residuals = residuals});
        ASSERT_EQ(report.status, Status::Stretched) << i;
        ASSERT_TRUE(Holds(figure.joints, places));
        ASSERT_LE(residuals[1], 2.0 * tree.reach() * 1.002);
        others += residuals[0] <= 2e-3 * tree.reach() && residuals[2] <= 2e-3 * tree.reach();
    }
    EXPECT_GE(others, 190);
}

TEST(IkTree, ATargetsDistanceDoesNotChangeItsWeight) {
    Figure figure = body();
    Tree tree = tree_of(figure.joints);
    Random random(16);
    for (int i = 0; i < 100; ++i) {
        const Places before = random_pose(figure.joints, random, 0.5f);
        aim(figure.effectors, random_pose(figure.joints, random, 0.5f));
        const glm::vec3 away = random_direction(random);
        Places near = before, far = before;
        figure.effectors[1].target = away * 2.0f;
        tree.solve(near, figure.effectors);
        figure.effectors[1].target = away * 2097152.0f;
        tree.solve(far, figure.effectors);
        for (std::size_t k = 0; k < near.size(); ++k)
            ASSERT_LT(distance(near[k], far[k]), 1e-6) << i << ", " << k;
    }
}

/// A root, one bone and two arms of two bones; the hands' targets are further apart than the arms reach.
Figure unreachable_figure() {
    Figure figure;
    const std::size_t chest = grow(figure.joints, 0, {1.0f});
    figure.effectors = {{grow(figure.joints, chest, {0.5f, 0.5f}), {2.0f, 1.0f, 0.0f}},
                        {grow(figure.joints, chest, {0.5f, 0.5f}), {-2.0f, 1.0f, 0.0f}}};
    return figure;
}

TEST(IkTree, EqualWeightsShareTheLossEqually) {
    const Figure figure = unreachable_figure();
    Tree tree = tree_of(figure.joints);
    Places places = straight_pose(figure.joints, {0, 1, 0});
    std::vector<float> residuals(2);
    tree.solve(places, figure.effectors, {.max_iterations = 1000, .effector_residuals = residuals});
    EXPECT_NEAR(residuals[0], residuals[1], 2e-3f);
    EXPECT_NEAR(places[1].x, 0.0f, 2e-3f);
}

TEST(IkTree, TheHeavierEffectorComesCloser) {
    // Either target is within reach, but not both: as one's weight grows, the loss moves to the other.
    Figure figure = unreachable_figure();
    figure.effectors[0].target = {1.2f, 0.9f, 0.0f};
    figure.effectors[1].target = {-1.2f, 0.9f, 0.0f};
    Tree tree = tree_of(figure.joints);
    Random random(8);
    for (int start = 0; start < 20; ++start) {
        const Places given = random_pose(figure.joints, random, 0.5f);
        float heavy_before = infinity, light_before = 0.0f;
        for (const float weight : {1e-3f, 0.1f, 0.3f, 0.6f, 1.0f, 1.5f, 3.0f, 10.0f, 100.0f, 1e4f}) {
            Places places = given;
            std::vector<float> residuals(2);
            figure.effectors[0].weight = weight;
            const TreeReport report = tree.solve(places, figure.effectors,
                                                 {.max_iterations = 2000, .effector_residuals = residuals});
            EXPECT_EQ(report.status, Status::Stalled);
            EXPECT_LE(residuals[0], heavy_before + 1e-3f) << weight;
            EXPECT_GE(residuals[1], light_before - 1e-3f) << weight;
            heavy_before = residuals[0];
            light_before = residuals[1];
        }
        EXPECT_LT(heavy_before, 2e-3f);
    }
}

TEST(IkTree, WeightsDoNotMatterIfAllTargetsAreReachable) {
    Figure figure = body();
    Tree tree = tree_of(figure.joints);
    Random random(9);
    for (const float weight : {1e-4f, 1.0f, 1e4f, 1e9f})
        for (int i = 0; i < 50; ++i) {
            aim(figure.effectors, random_pose(figure.joints, random, 0.4f));
            figure.effectors[1].weight = weight;
            Places places = random_pose(figure.joints, random, 0.4f);
            EXPECT_EQ(tree.solve(places, figure.effectors).status, Status::Converged) << weight << ", " << i;
        }
}

TEST(IkTree, AnEffectorOnAnInnerJointMovesTheRestRigidly) {
    const TreeJointList joints = chain_of(6);
    Tree tree = tree_of(joints);
    Random random(10);
    for (int i = 0; i < 100; ++i) {
        const Places before = random_pose(joints, random, 0.3f);
        Places places = before;
        const glm::vec3 target = random_direction(random) * 2.0f;
        const TreeReport report = tree.solve(places, std::vector<Effector>{{3, target}});
        EXPECT_EQ(report.status, Status::Converged);
        EXPECT_TRUE(Holds(joints, places));
        // Joints 2 to 6 are rigid: all distances among them are unchanged.
        for (std::size_t a = 2; a <= 6; ++a)
            for (std::size_t b = a + 1; b <= 6; ++b)
                ASSERT_NEAR(distance(places[a], places[b]), distance(before[a], before[b]), 1e-5);
    }
}

TEST(IkTree, BranchesWithoutEffectorsAboveTheRootStay) {
    Figure figure = body();
    const std::size_t leg = grow(figure.joints, 0, {0.4f, 0.4f});
    Tree tree = tree_of(figure.joints);
    Random random(11);
    const Places before = random_pose(figure.joints, random, 0.3f);
    Places places = before;
    figure.effectors.resize(1);
    figure.effectors[0].target = {0.0f, 0.6f, 0.2f};
    tree.solve(places, figure.effectors);
    EXPECT_FALSE(same_bits(places[4], before[4]));
    for (std::size_t k : {std::size_t{0}, leg - 1, leg}) EXPECT_TRUE(same_bits(places[k], before[k])) << k;
}

TEST(IkTree, ReachedTargetsMoveNothing) {
    Figure figure = spider();
    Tree tree = tree_of(figure.joints);
    Random random(12);
    const Places before = random_pose(figure.joints, random, 0.3f);
    aim(figure.effectors, before);
    Places places = before;
    EXPECT_EQ(tree.solve(places, figure.effectors), (TreeReport{Status::Converged, 0, 0.0f}));
    EXPECT_TRUE(same_places(places, before));
    EXPECT_EQ(tree.solve(places, {}), (TreeReport{Status::Converged, 0, 0.0f}));
    EXPECT_TRUE(same_places(places, before));
}

TEST(IkTree, WeightlessEffectorsAreOnlyMeasured) {
    Tree tree = tree_of(chain_of(4));
    Places with = straight_pose(chain_of(4)), without = with;
    std::vector<float> residuals(3, -1.0f);
    const std::vector<Effector> effectors{{4, {0, 3, 0}}, {2, {9, 0, 0}, 0.0f}, {2, {2, 0, 0}, 0.0f}};
    const TreeReport report = tree.solve(with, effectors, {.effector_residuals = residuals});
    EXPECT_EQ(report, tree.solve(without, std::span(effectors).first(1)));
    EXPECT_TRUE(same_places(with, without));
    EXPECT_EQ(report.status, Status::Converged);
    EXPECT_NEAR(static_cast<double>(residuals[1]), distance(with[2], {9, 0, 0}), 1e-5);
    EXPECT_NEAR(static_cast<double>(residuals[2]), distance(with[2], {2, 0, 0}), 1e-5);
}

TEST(IkTree, TheRootNeverMoves) {
    Tree tree = tree_of(chain_of(4));
    Places places = straight_pose(chain_of(4));
    std::vector<float> residuals(2);
    const std::vector<Effector> effectors{{0, {0, 1, 0}, 1e9f}, {4, {0, 3, 0}, 1.0f}};
    const TreeReport report = tree.solve(places, effectors, {.effector_residuals = residuals});
    EXPECT_EQ(report.status, Status::Stretched);
    EXPECT_EQ(report.residual, 1.0f);
    EXPECT_LE(residuals[1], 4e-3f);
    EXPECT_TRUE(same_bits(places[0], {0, 0, 0}));
}

TEST(IkTree, ZeroLengthBonesKeepTheirJointsTogether) {
    TreeJointList joints = only_root();
    grow(joints, 0, {0.0f, 1.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f});
    Tree tree = tree_of(joints);
    Places places = straight_pose(joints);
    std::vector<float> residuals(3);
    const std::vector<Effector> effectors{{7, {0, 2, 0}}, {6, {0, 2, 0}, 3.0f}, {5, {0, 2, 0}, 2.0f}};
    const TreeReport report = tree.solve(places, effectors, {.effector_residuals = residuals});
    EXPECT_EQ(report.status, Status::Converged);
    EXPECT_TRUE(Holds(joints, places));
    EXPECT_TRUE(same_bits(places[1], places[0]) && same_bits(places[7], places[5]));
}

TEST(IkTree, ReportsTheWorstResidualOfEveryIteration) {
    Figure figure = body();
    Tree tree = tree_of(figure.joints);
    Random random(13);
    aim(figure.effectors, random_pose(figure.joints, random, 0.7f));
    Places places = random_pose(figure.joints, random, 0.3f);
    std::vector<float> residuals(40, -1.0f);
    const TreeReport report = tree.solve(places, figure.effectors, {.residuals = residuals});
    ASSERT_EQ(report.status, Status::Converged);
    ASSERT_GT(report.iterations, 2);
    EXPECT_EQ(residuals[static_cast<std::size_t>(report.iterations) - 1], report.residual);
    EXPECT_EQ(residuals[static_cast<std::size_t>(report.iterations)], -1.0f);
    EXPECT_GT(residuals[0], report.residual);

    std::fill(residuals.begin(), residuals.end(), -1.0f);
    EXPECT_EQ(tree.solve(places, figure.effectors,
                         {.max_iterations = 30, .every_iteration = true, .residuals = residuals})
                  .iterations,
              30);
    EXPECT_GE(residuals[29], 0.0f);
    EXPECT_EQ(residuals[30], -1.0f);
}

TEST(IkTree, StraightChainsLeaveTheirLine) {
    for (const std::size_t bones : {2u, 3u, 4u, 10u, 30u}) {
        const TreeJointList joints = chain_of(bones, 0.5f);
        const float reach = 0.5f * static_cast<float>(bones);
        Tree tree = tree_of(joints);
        for (const glm::vec3 along : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0.6f, 0, 0.8f)})
            for (const float part : {0.95f, 0.7f, 0.5f, 0.1f, 0.0f, -0.1f, -0.5f, -0.9f, -0.99f}) {
                Places places = straight_pose(joints, along);
                const std::vector<Effector> effectors{{bones, along * (reach * part)}};
                const TreeReport report = tree.solve(places, effectors);
                EXPECT_EQ(report.status, Status::Converged) << bones << ", " << part;
                EXPECT_LE(report.iterations, 14) << bones << ", " << part;
                EXPECT_TRUE(Holds(joints, places));
            }
    }
}

TEST(IkTree, PlainReportsThatItStalledOnTheLine) {
    Tree tree = tree_of(chain_of(4));
    Places places = straight_pose(chain_of(4));
    const std::vector<Effector> effectors{{4, {2.5f, 0, 0}}};
    EXPECT_EQ(tree.solve(places, effectors, {.plain = true}).status, Status::Stalled);
}

TEST(IkTree, EveryBranchLeavesItsLine) {
    Figure figure = spider();
    Tree tree = tree_of(figure.joints);
    for (const float part : {0.9f, 0.6f, 0.2f, -0.3f}) {
        // The spine is straight, all legs straight and square to it; the feet are pulled in along their legs.
        Places places(figure.joints.size(), glm::vec3(0.0f));
        for (std::size_t k = 1; k < places.size(); ++k) {
            const bool of_back =
                figure.joints[k].length == 0.3f && (figure.joints[k].parent == 0 || (k - 1) % 9 == 0);
            const glm::vec3 way = of_back ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, (k - 1) % 9 <= 4 ? 1 : -1);
            places[k] = places[figure.joints[k].parent] + way * figure.joints[k].length;
        }
        ASSERT_TRUE(Holds(figure.joints, places));
        for (Effector& effector : figure.effectors) {
            const glm::vec3 foot = places[effector.joint];
            effector.target = {foot.x, foot.y, foot.z * part};
        }
        EXPECT_EQ(tree.solve(places, figure.effectors).status, Status::Converged) << part;
    }
}

TEST(IkTree, SizeDoesNotMatter) {
    Random random(14);
    for (const float scale : {1e-6f, 1e-4f, 1e-2f, 1e2f, 1e4f, 1e6f}) {
        Figure figure = body();
        for (TreeJoint& joint : figure.joints) joint.length *= scale;
        Tree tree = tree_of(figure.joints);
        for (int i = 0; i < 50; ++i) {
            aim(figure.effectors, random_pose(figure.joints, random, 0.5f));
            Places places = random_pose(figure.joints, random, 0.5f);
            const TreeReport report = tree.solve(places, figure.effectors);
            EXPECT_EQ(report.status, Status::Converged) << scale;
            EXPECT_LE(report.iterations, 20) << scale;
        }
    }
}

}  // namespace
}  // namespace tendril::test::ik_tree_test
