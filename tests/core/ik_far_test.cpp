// Distant targets: a tree and the two-bone solver keep their lengths.
#include "ik_tree_support.hpp"
#include "tendril/ik/two_bone.hpp"

namespace tendril::test::ik_far_test {
namespace {

constexpr float far_away[] = {1e3f, 1e6f, 1e8f, 1e9f};

std::vector<glm::vec3> directions() {
    return {{1, 0, 0}, {0, -1, 0}, {0.6f, 0, 0.8f}, {-0.48f, 0.6f, 0.64f}};
}

/// The spec's tolerance of a bone's length near the origin.
void expect_length(const glm::vec3& a, const glm::vec3& b, float length, float target) {
    EXPECT_NEAR(glm::length(glm::dvec3(b) - glm::dvec3(a)), static_cast<double>(length),
                1e-4 * std::max(1.0, static_cast<double>(length)))
        << "target at " << target;
}

TEST(IkFar, ATreeKeepsItsLengths) {
    for (const Figure& given : {body(), spider()})
        for (const float far : far_away)
            for (const glm::vec3& direction : directions()) {
                Figure figure = given;
                Tree tree = tree_of(figure.joints);
                Places places(figure.joints.size(), glm::vec3(0));
                for (std::size_t k = 1; k < places.size(); ++k)
                    places[k] = places[figure.joints[k].parent] + glm::vec3(0, figure.joints[k].length, 0);
                float side = 1.0f;
                for (Effector& effector : figure.effectors) {
                    effector.target = direction * (far * side);
                    side = -side;
                }
                const TreeReport report = tree.solve(places, figure.effectors);
                EXPECT_EQ(report.status, Status::Stretched) << far;
                for (std::size_t k = 1; k < places.size(); ++k)
                    expect_length(places[figure.joints[k].parent], places[k], figure.joints[k].length, far);
            }
}

TEST(IkFar, ATreeWithOneEffectorLiesStraightTowardsIt) {
    TreeJointList joints = only_root();
    const std::size_t tip = grow(joints, 0, {1.0f, 0.3f, 2.0f, 0.01f, 0.7f});
    Tree tree = tree_of(joints);
    for (const float far : far_away)
        for (const glm::vec3& direction : directions()) {
            Places places{{0, 0, 0}, {0, 1, 0}, {0, 1.3f, 0}, {0, 3.3f, 0}, {0, 3.31f, 0}, {0, 4.01f, 0}};
            const std::vector<Effector> effectors{{tip, direction * far}};
            EXPECT_EQ(tree.solve(places, effectors).status, Status::Stretched) << far;
            for (std::size_t k = 1; k < places.size(); ++k)
                expect_length(places[k - 1], places[k], joints[k].length, far);
            EXPECT_LE(glm::distance(places[tip], direction * 4.01f), 1e-4f) << far;
        }
}

TEST(IkFar, TwoBonesKeepTheirLengths) {
    const ik::TwoBone limb{{0, 0, 0}, {0, 0.4f, 0.1f}, {0, 0.7f, 0.4f}, 0.41231056f, 0.42426407f};
    for (const float far : far_away)
        for (const glm::vec3& direction : directions())
            for (const bool pole : {false, true}) {
                ik::TwoBoneOptions options;
                if (pole) options.pole = glm::vec3(0.3f, -1, 2);
                const ik::TwoBoneResult result = ik::two_bone(limb, direction * far, options);
                EXPECT_EQ(result.status, Status::Stretched) << far;
                expect_length(limb.root, result.mid, limb.upper, far);
                expect_length(result.mid, result.tip, limb.lower, far);
                EXPECT_LE(glm::distance(result.tip, direction * (limb.upper + limb.lower)), 1e-4f) << far;
            }
}

}  // namespace
}  // namespace tendril::test::ik_far_test
