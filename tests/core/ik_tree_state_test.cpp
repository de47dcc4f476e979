// A tree keeps nothing between solves: the state is in the caller's joints and rotations.
#include "ik_tree_support.hpp"

namespace tendril::test::ik_tree_state_test {
namespace {

struct Posture {
    Places places;
    std::vector<glm::quat> rotations;
    bool operator==(const Posture&) const = default;
};

/// A hundred solves towards moving targets.
Posture play(Tree& tree, const Figure& figure, Posture posture) {
    Random random(7);
    std::vector<Effector> effectors = figure.effectors;
    for (int i = 0; i < 100; ++i) {
        for (Effector& effector : effectors)
            effector.target = posture.places[effector.joint] + random.point(random.chance(10) ? 2.0f : 0.1f);
        TreeOptions options{.max_iterations = 10, .rotations = posture.rotations};
        EXPECT_NE(tree.solve(posture.places, effectors, options).status, Status::InvalidInput);
    }
    return posture;
}

TEST(IkTreeState, RollbackGivesTheSameBits) {
    Random random(72);
    for (int number = 0; number < 20; ++number) {
        const Figure figure = random_figure(random);
        Tree tree = tree_of(figure.joints), other = tree_of(figure.joints);
        const Posture start{random_pose(figure.joints, random, 0.5f),
                            std::vector<glm::quat>(figure.joints.size(), glm::quat(1, 0, 0, 0))};
        const Posture end = play(tree, figure, start);
        EXPECT_EQ(play(tree, figure, start), end);
        EXPECT_EQ(play(other, figure, start), end);
        // The rotations turn each bone from its start direction to its present one.
        for (std::size_t k = 1; k < figure.joints.size(); ++k) {
            const std::size_t parent = figure.joints[k].parent;
            const glm::vec3 rest = start.places[k] - start.places[parent];
            const glm::vec3 said = end.places[parent] + end.rotations[k] * rest;
            EXPECT_LE(distance(said, end.places[k]), 2e-4 * (1.0 + double(figure.joints[k].length))) << k;
        }
    }
}

TEST(IkTreeState, BadRotationsAreRefused) {
    const Figure figure = body();
    Tree tree = tree_of(figure.joints);
    Places places = straight_pose(figure.joints);
    const Places before = places;
    std::vector<Effector> effectors = figure.effectors;
    aim(effectors, places);
    std::vector<glm::quat> few(2, glm::quat(1, 0, 0, 0)), bad(figure.joints.size(), glm::quat(2, 0, 0, 0));
    EXPECT_EQ(tree.solve(places, effectors, {.rotations = few}).status, Status::InvalidInput);
    EXPECT_EQ(tree.solve(places, effectors, {.rotations = bad}).status, Status::InvalidInput);
    EXPECT_TRUE(same_places(places, before));
}

}  // namespace
}  // namespace tendril::test::ik_tree_state_test
