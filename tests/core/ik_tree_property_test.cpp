// A tree of chains with random and hostile input: how often it converges, whether its invariant holds,
// whether the order of effectors matters, and whether solving allocates.
#include <cstdio>
#include <map>

#include "ik_tree_support.hpp"
#include "memory.hpp"

namespace tendril::test::ik_tree_property_test {
namespace {

struct Tally {
    int solves = 0, converged = 0;
    std::vector<int> iterations;

    void add(const TreeReport& report) {
        ++solves;
        converged += report.status == Status::Converged;
        iterations.push_back(report.status == Status::Converged ? report.iterations : 1000);
    }
    double rate() const { return 100.0 * converged / solves; }
    int percentile(std::size_t percent) {
        std::sort(iterations.begin(), iterations.end());
        return iterations[(iterations.size() - 1) * percent / 100];
    }
};

enum class Which { Body, Spider, Random };

/// Targets come from a random pose, so that they are reachable; the start is another one.
Tally converge(Which which, float straight, int solves) {
    Random random(21 + static_cast<std::uint64_t>(which));
    Tally tally;
    for (int i = 0; i < solves; ++i) {
        Figure figure = which == Which::Body     ? body()
                        : which == Which::Spider ? spider()
                                                 : random_figure(random);
        Tree tree = tree_of(figure.joints);
        aim(figure.effectors, random_pose(figure.joints, random, straight));
        Places places = random_pose(figure.joints, random, 0.5f);
        tally.add(tree.solve(places, figure.effectors));
        EXPECT_TRUE(Holds(figure.joints, places)) << i;
    }
    return tally;
}

TEST(IkTreeProperty, ConvergesOnReachableTargets) {
    const struct {
        Which which;
        const char* name;
        int solves;
        double least;  // percent; 95 is required
        int median;
    } cases[] = {{Which::Body, "body", 500, 99.0, 10},
                 {Which::Spider, "spider", 500, 99.0, 10},
                 {Which::Random, "random", 300, 97.0, 8}};
    for (const auto& each : cases)
        for (const float straight : {0.0f, 0.5f, 0.8f}) {
            Tally tally = converge(each.which, straight, each.solves);
            const int p50 = tally.percentile(50);
            std::printf("%s, targets' pose straight to %.1f: %.1f %% converged, iterations p50 %d p95 %d\n",
                        each.name, static_cast<double>(straight), tally.rate(), p50, tally.percentile(95));
            EXPECT_GE(tally.rate(), each.least) << each.name << ", " << straight;
            EXPECT_LE(p50, each.median) << each.name << ", " << straight;
        }
}

TEST(IkTreeProperty, MovesTheJointsNoFurtherThanPlainPulls) {
    double plain_travel = 0.0, travel = 0.0;
    Random random(24);
    for (int i = 0; i < 300; ++i) {
        Figure figure = random.chance(2) ? body() : spider();
        Tree tree = tree_of(figure.joints);
        aim(figure.effectors, random_pose(figure.joints, random, 0.5f));
        const Places before = random_pose(figure.joints, random, 0.5f);
        Places places = before, plain = before;
        tree.solve(places, figure.effectors);
        tree.solve(plain, figure.effectors, {.max_iterations = 1000, .plain = true});
        for (std::size_t k = 0; k < before.size(); ++k) {
            travel += distance(places[k], before[k]);
            plain_travel += distance(plain[k], before[k]);
        }
    }
    std::printf("mean joint travel %.4f of that by plain pulls\n", travel / plain_travel);
    EXPECT_LE(travel, 1.05 * plain_travel);
}

TEST(IkTreeProperty, TheOrderOfTheEffectorsDoesNotMatter) {
    Random random(25);
    for (int i = 0; i < 300; ++i) {
        Figure figure = random_figure(random);
        Tree tree = tree_of(figure.joints), other = tree_of(figure.joints);
        // Half of the cases conflict, so that the means matter.
        aim(figure.effectors, random_pose(figure.joints, random, 0.5f));
        if (random.chance(2)) {
            for (Effector& effector : figure.effectors) effector.target = random.point(float(tree.reach()));
        }
        const Places before = random_pose(figure.joints, random, 0.5f);
        std::vector<Effector> shuffled = figure.effectors;
        for (std::size_t k = shuffled.size(); k-- > 1;) std::swap(shuffled[k], shuffled[random.below(k + 1)]);
        Places a = before, b = before;
        std::vector<float> residuals(figure.effectors.size()), shuffled_residuals(shuffled.size());
        const TreeReport first = tree.solve(a, figure.effectors, {.effector_residuals = residuals});
        const TreeReport second = other.solve(b, shuffled, {.effector_residuals = shuffled_residuals});
        ASSERT_EQ(first, second) << i;
        ASSERT_TRUE(same_places(a, b)) << i;
        std::map<std::size_t, float> by_joint;
        for (std::size_t k = 0; k < shuffled.size(); ++k) by_joint[shuffled[k].joint] = shuffled_residuals[k];
        for (std::size_t k = 0; k < residuals.size(); ++k)
            ASSERT_EQ(residuals[k], by_joint[figure.effectors[k].joint]);
    }
}

TEST(IkTreeProperty, NeverEndsWorseThanItBegan) {
    Random random(26);
    for (int i = 0; i < 500; ++i) {
        Figure figure = random_figure(random);
        Tree tree = tree_of(figure.joints);
        for (Effector& effector : figure.effectors) {
            effector.target = random.point(0.3f * float(tree.reach()));
            effector.weight = 1.0f;
        }
        Places places = random_pose(figure.joints, random, 0.5f);
        const auto loss = [&] {
            double sum = 0.0;
            for (const Effector& effector : figure.effectors) {
                const double residual = distance(places[effector.joint], effector.target);
                sum += residual * residual;
            }
            return sum;
        };
        const bool reachable =
            std::all_of(figure.effectors.begin(), figure.effectors.end(), [&](auto& effector) {
                double way = 0.0;
                for (std::size_t k = effector.joint; k != 0; k = figure.joints[k].parent)
                    way += static_cast<double>(figure.joints[k].length);
                return distance(effector.target, glm::vec3(0.0f)) <= way;
            });
        if (!reachable) continue;  // solved for the nearest reachable targets: another loss
        const double before = loss();
        tree.solve(places, figure.effectors, {.max_iterations = 1 + static_cast<int>(random.below(20))});
        ASSERT_LE(loss(), before * (1.0 + 1e-5) + 1e-9) << i;
    }
}

float hostile_number(Random& random) {
    constexpr float numbers[] = {nan,  infinity, -infinity, 1e9f,   -1e9f, 1e10f,  -1e10f,  -1.0f, -0.0f,
                                 0.0f, 1e-40f,   -1e-40f,   1e-45f, 3e38f, 1e-30f, 3.4e-4f, 5e8f,  1e-7f};
    return numbers[random.below(std::size(numbers))];
}

float hostile_length(Random& random) {
    constexpr float numbers[] = {0.0f, 1e-45f, 1e-30f, 1e-16f, 1e-7f, 3e-4f, 1.0f, 1e3f, 1e9f};
    return random.chance(3) ? numbers[random.below(std::size(numbers))] : std::abs(random.around(2.0f));
}

glm::vec3 hostile_point(Random& random, const Places& places) {
    if (random.chance(5)) return places[random.below(places.size())];
    if (random.chance(8)) return glm::vec3(0.0f);
    glm::vec3 point = random.point(random.chance(10) ? 1e9f : 5.0f);
    if (random.chance(60)) point[static_cast<int>(random.below(3))] = hostile_number(random);
    return point;
}

TEST(IkTreeProperty, ThirtyThousandHostileSolves) {
    Random random(27);
    int refused = 0, solved = 0;
    for (int i = 0; i < 30'000; ++i) {
        TreeJointList joints = only_root();
        const std::size_t count = 1 + random.below(12);
        for (std::size_t k = 1; k < count; ++k) joints.push_back({random.below(k), hostile_length(random)});
        Tree tree = tree_of(joints);
        Places places(count, glm::vec3(0.0f));
        for (glm::vec3& place : places) place = hostile_point(random, places);
        std::vector<Effector> effectors(random.below(5));
        for (Effector& effector : effectors) {
            effector = {random.below(count + (random.chance(30) ? 1 : 0)), hostile_point(random, places)};
            if (random.chance(4)) effector.weight = random.chance(10) ? hostile_number(random) : 1e-45f;
        }
        TreeOptions options{.max_iterations = 1 + static_cast<int>(random.below(40))};
        options.every_iteration = random.chance(8);
        options.plain = random.chance(4);
        if (random.chance(8)) options.tolerance = random.chance(3) ? hostile_number(random) : 0.0f;
        if (random.chance(60)) options.max_iterations = random.chance(2) ? 0 : 1'000'001;
        const Places before = places;
        std::vector<float> residuals(effectors.size(), 0.0f);
        options.effector_residuals = residuals;
        TreeReport report;
        without_memory([&] { report = tree.solve(places, effectors, options); });
        if (report.status == Status::InvalidInput) {
            ++refused;
            ASSERT_TRUE(same_places(places, before)) << i;
            continue;
        }
        ++solved;
        ASSERT_TRUE(Holds(joints, places)) << i;
        ASSERT_TRUE(same_bits(places[0], before[0])) << i;
        ASSERT_TRUE(std::isfinite(report.residual) && report.residual >= 0.0f) << i;
        ASSERT_LE(report.iterations, options.max_iterations) << i;
        for (const float residual : residuals) ASSERT_TRUE(std::isfinite(residual)) << i;
    }
    std::printf("%d refused, %d solved\n", refused, solved);
    EXPECT_GT(refused, 3'000);  // enough of each for a fair test
    EXPECT_GT(solved, 10'000);
}

TEST(IkTreeProperty, ThousandsOfEffectorsAndALongChain) {
    TreeJointList joints = only_root();
    grow(joints, 0, std::vector<float>(20'000, 0.01f));
    Tree tree = tree_of(joints);
    Random random(28);
    std::vector<Effector> effectors;
    for (std::size_t k = 100; k <= 20'000; k += 100) effectors.push_back({k});
    aim(effectors, random_pose(joints, random, 0.9f));
    Places places = straight_pose(joints);
    std::vector<float> residuals(100);
    const TreeReport report = tree.solve(places, effectors, {.residuals = residuals});
    EXPECT_TRUE(Holds(joints, places));
    EXPECT_LT(report.residual, 0.1f * residuals[0]);  // on its way: too far for so few iterations
}

// A tree keeps nothing between solves: the state is in the caller's joints and rotations.

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

}  // namespace
}  // namespace tendril::test::ik_tree_property_test
