// All output is finite, also with options at the ends of their documented ranges.
#include "ik_hostile.hpp"
#include "ik_limit_support.hpp"
#include "ik_tree_support.hpp"
#include "tendril/ik/two_bone.hpp"

namespace tendril::test::ik_finite_test {
namespace {

using ik::Method;

template <class... T>
float one_of(Random& random, T... values) {
    const float all[] = {static_cast<float>(values)...};
    return all[random.below(sizeof...(values))];
}

/// Half of the options keep their defaults; the others are at or near an end of their range.
ik::Options extreme_options(const Arm& arm, Random& random) {
    ik::Options options{.max_iterations = 1 + static_cast<int>(random.below(40)),
                        .every_iteration = random.chance(3)};
    if (random.chance(2)) options.tolerance = one_of(random, 0, 1e-30, 1e-9, 1e9);
    if (random.chance(2)) options.limits = arm.limits;
    if (random.chance(2)) options.pole = random.chance(2) ? random.point(1e9f) : random.point(arm.reach());
    if (random.chance(2)) options.pole_turn = ik::PoleTurn::EachJoint;
    if (random.chance(2)) options.snap_back = one_of(random, 1, 1e-30, 0.5);
    if (random.chance(3)) options.tip_orientation = glm::quat(0.5f, -0.5f, 0.5f, 0.5f);
    if (random.chance(2)) options.soft_zone = one_of(random, 1, 1e-30, 1e-6);
    if (random.chance(2)) options.damping = one_of(random, 1e-45, 1e-38, 1e-20, 1e-10, 1e-5, 10);
    if (random.chance(2)) options.start_stretch_ratio = one_of(random, 1e-45, 1e-20, 1e-3);
    if (random.chance(2)) options.max_stretch_scale = one_of(random, 1, 100);
    if (random.chance(2)) options.twist = one_of(random, -1e9, 1e9, 1e-30, 3.14159265);
    if (random.chance(2)) options.weight = one_of(random, 0, 1e-45, 1e-20, 0.999999);
    if (random.chance(2)) options.restarts = random.chance(2) ? 0 : 1000;
    options.rotations = random.chance(2);
    return options;
}

bool are_finite(std::span<const glm::vec3> points) {
    return std::all_of(points.begin(), points.end(), [](const glm::vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

TEST(IkFinite, OptionsAtTheEndsOfTheirRanges) {
    Random random(given_seed());
    for (int number = 0; number < 6000 && !::testing::Test::HasFailure(); ++number) {
        const Method method = ik::all_methods[random.below(ik::all_methods.size())];
        const std::size_t bones = method == Method::TwoBone ? 2 : 1 + random.below(6);
        Arm arm = some_arm(random, bones);
        const float scale = one_of(random, 1, 1, 1, 1e-4, 1e3, 1e7);
        for (float& length : arm.lengths) length *= random.chance(12) ? 0.0f : scale;
        KeptSolver solver = arm.solver();
        Joints joints = random.chance(2) ? arm.at_rest() : some_pose(arm.lengths, random);
        for (int turn = 0; turn < 3; ++turn) {
            SCOPED_TRACE(std::string(name(method)) + " " + std::to_string(number) + " " +
                         std::to_string(turn));
            ik::Options options = extreme_options(arm, random);
            std::vector<float> residuals(64, 0.0f);
            options.residuals = residuals;
            const Joints before = joints;
            const glm::vec3 target = hostile_target(joints, arm.lengths, random);
            const ik::Report report = solver.solve(method, joints, target, options);
            if (report.status == ik::Status::InvalidInput) {  // moved out of range by an earlier solve
                EXPECT_TRUE(same_bits(joints, before));
                break;
            }
            EXPECT_TRUE(are_finite(joints));
            EXPECT_TRUE(std::isfinite(report.residual));
            for (const float residual : residuals) EXPECT_TRUE(std::isfinite(residual));
            const Result state = check(solver.state, bones);
            EXPECT_TRUE(state) << state.message();
        }
    }
}

/// A case that once failed: damped least squares within limits, almost without damping.
TEST(IkFinite, AlmostNoDampingWithinLimits) {
    Random random(77);
    for (int number = 0; number < 2000; ++number) {
        const Arm arm = some_arm(random, 1 + random.below(4));
        for (const Method method : {Method::Dls, Method::SvdDls}) {
            KeptSolver solver = arm.solver();
            Joints joints = arm.at_rest();
            std::vector<float> residuals(30, 0.0f);
            const ik::Options options{.max_iterations = 30,
                                      .every_iteration = true,
                                      .limits = arm.limits,
                                      .damping = 1e-20f,
                                      .residuals = residuals};
            const ik::Report report = solver.solve(method, joints, random.point(arm.reach()), options);
            EXPECT_TRUE(std::isfinite(report.residual));
            for (const float residual : residuals) ASSERT_TRUE(std::isfinite(residual)) << number;
        }
    }
}

/// Lengths are kept for a target at the end of the range. Beyond it nothing moves.
TEST(IkFinite, FarTargetsKeepLengths) {
    Random random(78);
    for (int number = 0; number < 500; ++number)
        for (const Method method : ik::all_methods) {
            const Arm arm = some_arm(random, method == Method::TwoBone ? 2 : 2 + random.below(6));
            KeptSolver solver = arm.solver();
            Joints joints = some_pose(arm.lengths, random, random.point(10.0f));
            ik::Options options;
            if (random.chance(2)) options.limits = arm.limits;
            if (random.chance(2)) options.pole = random.point(3.0f);
            if (random.chance(2)) options.soft_zone = 0.2f;
            if (random.chance(2)) options.weight = part(random);
            const float far = std::pow(10.0f, between(random, 3.0f, 9.0f));
            const glm::vec3 target = some_direction(random) * far;
            EXPECT_NE(solver.solve(method, joints, target, options).status, ik::Status::InvalidInput);
            EXPECT_TRUE(Holds(joints, arm.lengths)) << name(method) << " " << far;
            const Joints before = joints;
            const ik::State state = solver.state;
            for (const float beyond : {1.1e9f, 1e30f, infinity}) {
                EXPECT_EQ(solver.solve(method, joints, {beyond, 0, 1}, options).status,
                          ik::Status::InvalidInput);
                EXPECT_TRUE(same_bits(joints, before));
                EXPECT_EQ(solver.state, state);
            }
        }
}

// Distant targets: a tree and the two-bone solver keep their lengths.

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
}  // namespace tendril::test::ik_finite_test
