// solve_many against the scalar solver: the same pulls, whatever the vector unit, the number of threads, and
// the company that a chain is in.
#include "tendril/ik/many.hpp"

#include <gtest/gtest.h>

#include "ik_support.hpp"
#include "memory.hpp"

namespace tendril::test {
namespace {

using ik::Batch;
using ik::ManyOptions;
using ik::Report;
using ik::Status;

/// Chains as they are before a solve, and what to solve them for.
struct Crowd {
    std::vector<Lengths> lengths;
    std::vector<Joints> joints;
    std::vector<glm::vec3> targets;

    std::size_t size() const { return lengths.size(); }
    std::size_t bones() const { return lengths.front().size(); }
    void add(Lengths of, Joints pose, glm::vec3 target) {
        lengths.push_back(std::move(of)), joints.push_back(std::move(pose)), targets.push_back(target);
    }
};

/// Each chain with its own lengths, root and pose; targets between `least` and `most` of the reach.
Crowd some_crowd(std::size_t chains, std::size_t bones, Random& random, float least = 0.05f,
                 float most = 0.9f) {
    Crowd crowd;
    for (std::size_t i = 0; i < chains; ++i) {
        const Lengths lengths = some_lengths(bones, random);
        const glm::vec3 root = random.point(4.0f);
        const float far = between(random, least, most) * static_cast<float>(reach_of(lengths));
        crowd.add(lengths, some_pose(lengths, random, root), root + some_direction(random) * far);
    }
    return crowd;
}

Batch batch_of(const Crowd& crowd) {
    Batch batch(crowd.size(), crowd.bones());
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        batch.set_lengths(i, crowd.lengths[i]);
        batch.set_joints(i, crowd.joints[i]);
    }
    return batch;
}

struct Answer {
    std::vector<Joints> joints;
    std::vector<Report> reports;
};

/// Nothing where they are equal to the bit; else the first chain that is not.
std::string difference(const Answer& a, const Answer& b) {
    for (std::size_t i = 0; i < std::min(a.joints.size(), b.joints.size()); ++i) {
        if (!same_bits(a.joints[i], b.joints[i])) return "joints of chain " + std::to_string(i);
        if (!(a.reports[i] == b.reports[i])) return "report of chain " + std::to_string(i);
    }
    return {};
}

std::vector<Joints> joints_of(const Batch& batch) {
    std::vector<Joints> joints(batch.size(), Joints(batch.bones() + 1));
    for (std::size_t i = 0; i < batch.size(); ++i) batch.joints(i, joints[i]);
    return joints;
}

Answer solve_many(const Crowd& crowd, const ManyOptions& options) {
    Batch batch = batch_of(crowd);
    Answer answer{{}, std::vector<Report>(crowd.size())};
    ik::solve_many(batch, crowd.targets, answer.reports, options);
    answer.joints = joints_of(batch);
    return answer;
}

Answer solve_each(const Crowd& crowd, const ManyOptions& many, ik::Method method = ik::Method::FabrikPlain) {
    ik::Options options;
    options.tolerance = many.tolerance;
    options.max_iterations = many.max_iterations;
    options.every_iteration = many.every_iteration;
    Answer answer;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        Joints joints = crowd.joints[i];
        ik::Solver solver(crowd.lengths[i]);
        answer.reports.push_back(solver.solve(method, joints, crowd.targets[i], options));
        answer.joints.push_back(std::move(joints));
    }
    return answer;
}

double furthest(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double apart = distance(a[i], b[i]);
        if (!(apart <= most)) most = apart;
    }
    return most;
}

/// Equal to `part` of the reach, and in the reports.
void expect_same(const Crowd& crowd, const Answer& many, const Answer& each, double part) {
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        const double reach = reach_of(crowd.lengths[i]);
        EXPECT_LE(furthest(many.joints[i], each.joints[i]), part * reach) << "chain " << i;
        EXPECT_EQ(many.reports[i].status, each.reports[i].status) << "chain " << i;
        EXPECT_EQ(many.reports[i].iterations, each.reports[i].iterations) << "chain " << i;
        EXPECT_NEAR(many.reports[i].residual, each.reports[i].residual, part * reach) << "chain " << i;
        EXPECT_TRUE(Holds(many.joints[i], crowd.lengths[i])) << "chain " << i;
        EXPECT_TRUE(same_bits(many.joints[i].front(), crowd.joints[i].front())) << "chain " << i;
        if (::testing::Test::HasFailure()) return;  // one tells enough
    }
}

TEST(SolveMany, TenThousandChainsAsTheScalarSolverWithForcedIterations) {
    Random random(1);
    const Crowd crowd = some_crowd(10'000, 10, random);
    const ManyOptions options{.max_iterations = 20, .every_iteration = true};
    const Answer many = solve_many(crowd, options), each = solve_each(crowd, options);
    expect_same(crowd, many, each, 1e-4);
    const auto same = [&](std::size_t i) { return many.joints[i] == each.joints[i]; };
    std::size_t equal = 0;
    for (std::size_t i = 0; i < crowd.size(); ++i) equal += same(i) ? 1 : 0;
    EXPECT_GE(equal, crowd.size() * 999 / 1000) << "of " << crowd.size() << " equal to the bit";
}

TEST(SolveMany, EachChainStopsWhereTheScalarSolverStops) {
    Random random(2);
    for (const std::size_t bones : {2u, 3u, 5u, 10u, 31u}) {
        const Crowd crowd = some_crowd(700, bones, random, 0.0f, 1.2f);  // some beyond reach, some at the rim
        for (const int most : {1, 7, 8, 9, 100, 1000}) {
            const ManyOptions options{.max_iterations = most};
            expect_same(crowd, solve_many(crowd, options), solve_each(crowd, options), 1e-4);
        }
    }
}

TEST(SolveMany, ATighterToleranceIsKept) {
    Random random(3);
    const Crowd crowd = some_crowd(500, 6, random);
    const ManyOptions options{.tolerance = 1e-4f, .max_iterations = 500};
    const Answer many = solve_many(crowd, options);
    expect_same(crowd, many, solve_each(crowd, options), 1e-4);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        ASSERT_EQ(many.reports[i].status, Status::Converged);
        EXPECT_LE(distance(many.joints[i].back(), crowd.targets[i]), 1.01e-4);
    }
}

TEST(SolveMany, AToleranceThatFloatsCannotKeepStalls) {
    Random random(18);
    const Crowd crowd = some_crowd(500, 6, random, 0.1f, 0.95f);
    const ManyOptions options{.tolerance = 0.0f, .max_iterations = 2000};
    const Answer many = solve_many(crowd, options);
    expect_same(crowd, many, solve_each(crowd, options), 1e-4);
    const auto stalled = [](const Report& report) { return report.status == Status::Stalled; };
    EXPECT_GT(std::count_if(many.reports.begin(), many.reports.end(), stalled), 50);
}

TEST(SolveMany, FarFromTheOriginChainsAreSolvedAsTheScalarSolverSolvesThem) {
    Random random(19);
    for (const float far : {900.0f, 2e3f, 3e4f, 1e6f}) {
        Crowd crowd;
        for (int i = 0; i < 300; ++i) {
            const Lengths lengths = some_lengths(5, random);
            const glm::vec3 root = some_direction(random) * far;
            const float reach = static_cast<float>(reach_of(lengths));
            crowd.add(lengths, some_pose(lengths, random, root),
                      root + some_direction(random) * (0.8f * reach * part(random)));
        }
        const ManyOptions options{.max_iterations = 5, .every_iteration = true};
        const Answer many = solve_many(crowd, options), each = solve_each(crowd, options);
        std::size_t equal = 0;
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            equal += same_bits(many.joints[i], each.joints[i]) ? 1 : 0;
            EXPECT_TRUE(Holds(many.joints[i], crowd.lengths[i])) << far;
        }
        EXPECT_GE(equal, crowd.size() * 9 / 10) << far;
    }
}

TEST(SolveMany, EveryVectorUnitGivesTheSameBits) {
    ASSERT_FALSE(ik::vector_units().empty());
    Random random(4);
    const Crowd crowd = some_crowd(300, 9, random, 0.0f, 1.1f);
    for (const bool every : {false, true}) {
        const Answer widest = solve_many(crowd, {.every_iteration = every});
        for (const std::string_view unit : ik::vector_units()) {
            SCOPED_TRACE(unit);
            const Answer answer = solve_many(crowd, {.every_iteration = every, .vector_unit = unit});
            EXPECT_EQ(difference(answer, widest), "");
        }
    }
}

TEST(SolveMany, EveryNumberOfChainsGivesTheSameBits) {
    Random random(5);
    const Crowd all = some_crowd(300, 4, random, 0.0f, 1.1f);
    for (const std::string_view unit : ik::vector_units()) {
        const Answer whole = solve_many(all, {.vector_unit = unit});
        for (std::size_t count = 1; count < all.size(); count += count < 40 ? 1 : 17) {
            SCOPED_TRACE(std::string(unit) + ", " + std::to_string(count) + " chains");
            Crowd some = all;
            some.lengths.resize(count), some.joints.resize(count), some.targets.resize(count);
            const Answer answer = solve_many(some, {.vector_unit = unit});
            ASSERT_EQ(answer.joints.size(), count);
            ASSERT_EQ(difference(answer, whole), "");
        }
    }
}

TEST(SolveMany, EveryNumberOfThreadsGivesTheSameBits) {
    Random random(6);
    // Near the rim some take hundreds of iterations: those are solved apart from their blocks.
    const Crowd crowd = some_crowd(5000, 10, random, 0.05f, 0.999f);
    const ManyOptions options{.max_iterations = 1000};
    const Answer one = solve_many(crowd, options);
    expect_same(crowd, one, solve_each(crowd, options), 1e-4);
    for (int threads = 2; threads <= 4; ++threads) {
        ManyOptions with = options;
        with.threads = threads;
        for (int again = 0; again < 3; ++again)
            EXPECT_EQ(difference(solve_many(crowd, with), one), "") << threads;
    }
    EXPECT_EQ(difference(solve_many(crowd, {.max_iterations = 1000, .threads = 256}), one), "");
}

TEST(SolveMany, AWholeCrowdOfStragglersIsSolved) {
    Random random(7);
    const Crowd crowd = some_crowd(1000, 10, random, 0.99f, 0.999f);
    const ManyOptions options{.max_iterations = 3000};
    expect_same(crowd, solve_many(crowd, options), solve_each(crowd, options), 1e-4);
}

TEST(SolveMany, TargetsBeyondReachLayTheChainStraight) {
    Random random(8);
    const Crowd crowd = some_crowd(400, 8, random, 1.01f, 50.0f);
    const Answer many = solve_many(crowd, {});
    expect_same(crowd, many, solve_each(crowd, {}), 1e-4);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        const double reach = reach_of(crowd.lengths[i]);
        const double beyond = distance(crowd.targets[i], crowd.joints[i].front()) - reach;
        ASSERT_EQ(many.reports[i].status, Status::Stretched);
        EXPECT_NEAR(many.reports[i].residual, beyond, 1e-4);
    }
}

TEST(SolveMany, TargetsTooCloseFoldTheChain) {
    Random random(9);
    Crowd crowd;
    for (int i = 0; i < 200; ++i) {
        Lengths lengths{1.0f, 1.0f, 1.0f, 1.0f};
        lengths[random.below(4)] = between(random, 4.0f, 9.0f);
        const glm::vec3 root = random.point(4.0f);
        crowd.add(lengths, some_pose(lengths, random, root), root + some_direction(random) * part(random));
    }
    const Answer many = solve_many(crowd, {});
    expect_same(crowd, many, solve_each(crowd, {}), 1e-4);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        EXPECT_EQ(many.reports[i].status, Status::TooClose);
        const double longest = *std::max_element(crowd.lengths[i].begin(), crowd.lengths[i].end());
        const double nearest = longest - 3.0 - distance(crowd.targets[i], crowd.joints[i].front());
        EXPECT_NEAR(many.reports[i].residual, nearest, 0.01 * nearest + 1e-5);
    }
}

TEST(SolveMany, ChainsOnTheLineWithTheirTargetComeOffIt) {
    Random random(10);
    Crowd crowd;
    for (int i = 0; i < 300; ++i) {
        const Lengths lengths = some_lengths(7, random);
        const glm::vec3 root = random.point(4.0f), along = some_direction(random);
        const float far = between(random, -0.95f, 0.95f) * static_cast<float>(reach_of(lengths));
        crowd.add(lengths, straight_joints(lengths, along, root), root + along * far);
    }
    const Answer many = solve_many(crowd, {});
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        EXPECT_EQ(many.reports[i].status, Status::Converged) << "chain " << i;
        EXPECT_TRUE(Holds(many.joints[i], crowd.lengths[i]));
    }
    expect_same(crowd, many, solve_each(crowd, {}, ik::Method::Fabrik), 1e-4);
}

TEST(SolveMany, ATargetThatComesAndGoesOnOneLineIsFollowed) {
    Batch batch(200, 6);
    std::vector<Report> reports(batch.size());
    for (int frame = 0; frame < 60; ++frame) {
        const float far = 6.5f + 3.0f * std::sin(0.37f * static_cast<float>(frame));
        const std::vector<glm::vec3> targets(batch.size(), glm::vec3(0, far, 0));
        ik::solve_many(batch, targets, reports);
        for (const Report& report : reports) {
            ASSERT_EQ(report.status, far > 6.0f ? Status::Stretched : Status::Converged) << "at " << far;
        }
    }
}

TEST(SolveMany, LooseJointsAreLaidToTheirLengthsFirst) {
    Random random(11);
    Crowd crowd = some_crowd(1000, 5, random, 0.0f, 1.1f);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        Joints& joints = crowd.joints[i];
        if (i % 5 == 0) joints.front() += random.point(0.5f);
        if (i % 5 == 1) joints[random.below(6)] += random.point(2.0f);
        if (i % 5 == 2) crowd.lengths[i][random.below(5)] = part(random);
        if (i % 5 == 3) joints[1 + random.below(5)] = joints[random.below(6)];
    }
    for (const bool every : {false, true}) {
        const ManyOptions options{.max_iterations = 15, .every_iteration = every};
        expect_same(crowd, solve_many(crowd, options), solve_each(crowd, options), 1e-4);
    }
}

TEST(SolveMany, JointsOnAGridThatCoincideAreLaidAsTheScalarSolverLaysThem) {
    Random random(12);
    const auto grid = [&] {
        const auto whole = [&] { return static_cast<float>(random.below(4)); };
        const float x = whole(), y = whole();
        return glm::vec3(x, y, 0.0f);
    };
    Crowd crowd;
    for (int i = 0; i < 3000; ++i) {
        Lengths lengths(4);
        for (float& length : lengths) length = static_cast<float>(random.below(3));
        Joints joints(5);
        for (glm::vec3& joint : joints) joint = grid();
        crowd.add(lengths, joints, grid() + glm::vec3(0, 0, 0.3f));
    }
    const ManyOptions options{.max_iterations = 6, .every_iteration = true};
    expect_same(crowd, solve_many(crowd, options), solve_each(crowd, options), 1e-4);
}

TEST(SolveMany, RootsThatWalkTakeTheirChainsAlong) {
    Random random(13);
    const Crowd crowd = some_crowd(300, 6, random, 0.3f, 0.8f);
    Batch batch = batch_of(crowd);
    std::vector<Joints> each = crowd.joints;
    std::vector<glm::vec3> targets = crowd.targets;
    std::vector<Report> reports(crowd.size());
    for (int frame = 0; frame < 20; ++frame) {
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            const glm::vec3 by = random.point(0.1f);
            targets[i] += by;
            each[i].front() += by;
            batch.set_root(i, each[i].front());
            const Report report =
                ik::Solver(crowd.lengths[i]).solve(ik::Method::FabrikPlain, each[i], targets[i]);
            reports[i] = report;
        }
        std::vector<Report> many(crowd.size());
        ik::solve_many(batch, targets, many);
        ASSERT_EQ(difference({joints_of(batch), many}, {each, reports}), "") << "frame " << frame;
    }
}

TEST(SolveMany, ABadTargetHarmsNoOther) {
    Random random(14);
    Crowd crowd = some_crowd(260, 5, random);
    const Answer good = solve_many(crowd, {});
    const glm::vec3 bad[] = {
        {nan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}, {1.1e9f, 0, 0}, {nan, nan, nan}};
    for (std::size_t i = 0; i < crowd.size(); i += 3) crowd.targets[i] = bad[i % std::size(bad)];
    for (const bool every : {false, true}) {
        const ManyOptions options{.every_iteration = every};
        const Answer many = solve_many(crowd, options), each = solve_each(crowd, options);
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            if (i % 3 == 0) {
                EXPECT_EQ(many.reports[i], (Report{Status::InvalidInput, 0, 0.0f}));
                EXPECT_TRUE(same_bits(many.joints[i], crowd.joints[i]));
            } else if (!every) {
                EXPECT_TRUE(same_bits(many.joints[i], good.joints[i])) << "chain " << i;
            }
            EXPECT_EQ(many.reports[i].status, each.reports[i].status);
        }
    }
}

TEST(SolveMany, HostileNumbersNeverMakeWhatIsNotANumber) {
    Random random(15);
    const float hostile[] = {0.0f, -0.0f, 1e-30f, 1e-6f, 3e-4f, 1.0f,     -1.0f,
                             1e3f, 1e6f,  1e9f,   -1e9f, nan,   infinity, 1e-42f};
    const auto number = [&] { return hostile[random.below(std::size(hostile))]; };
    const auto finite = [&] {
        for (;;) {
            if (const float value = number(); std::abs(value) <= 1e9f) return value;
        }
    };
    for (int round = 0; round < 20; ++round) {
        Crowd crowd;
        for (int i = 0; i < 200; ++i) {
            Lengths lengths(3);
            for (float& length : lengths) length = std::abs(finite());
            Joints joints(4);
            for (glm::vec3& joint : joints) joint = {finite(), finite(), finite()};
            crowd.add(lengths, joints, {number(), number(), number()});
        }
        const ManyOptions options{.max_iterations = 12, .every_iteration = round % 2 == 0};
        const Answer many = solve_many(crowd, options), each = solve_each(crowd, options);
        for (const std::string_view unit : ik::vector_units()) {
            ManyOptions with = options;
            with.vector_unit = unit;
            EXPECT_EQ(difference(solve_many(crowd, with), many), "") << unit;
        }
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            const bool invalid = each.reports[i].status == Status::InvalidInput;
            EXPECT_EQ(many.reports[i].status == Status::InvalidInput, invalid);
            EXPECT_TRUE(std::isfinite(many.reports[i].residual));
            for (const glm::vec3& joint : many.joints[i]) {
                ASSERT_TRUE(std::isfinite(joint.x) && std::isfinite(joint.y) && std::isfinite(joint.z));
            }
            EXPECT_TRUE(invalid || Holds(many.joints[i], crowd.lengths[i]));
        }
    }
}

TEST(SolveMany, JointsLeftTooFarOutAreInvalidNextTime) {
    Crowd crowd;
    // An elbow that will point up, over the ceiling of what is accepted.
    crowd.add({1e9f, 1e9f}, {{0, 1e9f, 0}, {5e8f, 9.9e8f, 1}, {1e9f, 1e8f, 0}}, {5e8f, 1e9f, 0});
    crowd.add({1, 1}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {0, 1.5f, 0});
    Batch batch = batch_of(crowd);
    std::vector<Report> reports(2);
    ik::solve_many(batch, crowd.targets, reports);
    EXPECT_NE(reports[0].status, Status::InvalidInput);
    const std::vector<Joints> after = joints_of(batch);
    ASSERT_TRUE(
        std::any_of(after[0].begin(), after[0].end(), [](glm::vec3 joint) { return joint.y > 1e9f; }));
    ik::solve_many(batch, crowd.targets, reports);
    EXPECT_EQ(reports[0].status, Status::InvalidInput);
    EXPECT_EQ(reports[1].status, Status::Converged);
    EXPECT_TRUE(same_bits(joints_of(batch)[0], after[0]));
}

TEST(SolveMany, OptionsOutOfRangeAndListsOfTheWrongSizeMoveNothing) {
    Random random(16);
    const Crowd crowd = some_crowd(5, 3, random);
    Batch batch = batch_of(crowd);
    const std::vector<Joints> before = joints_of(batch);
    const auto expect_refused = [&](std::span<const glm::vec3> targets, std::size_t places,
                                    const ManyOptions& options) {
        std::vector<Report> reports(places);
        ik::solve_many(batch, targets, reports, options);
        for (const Report& report : reports) EXPECT_EQ(report, (Report{Status::InvalidInput, 0, 0.0f}));
        EXPECT_EQ(joints_of(batch), before);
    };
    const std::span<const glm::vec3> all(crowd.targets);
    expect_refused(all.first(4), 5, {});
    expect_refused(all, 4, {});
    expect_refused(all, 6, {});
    for (const float tolerance : {-1.0f, nan, infinity, 2e9f})
        expect_refused(all, 5, {.tolerance = tolerance});
    for (const int most : {0, -1, 1'000'001}) expect_refused(all, 5, {.max_iterations = most});
    for (const int threads : {0, -1, 257}) expect_refused(all, 5, {.threads = threads});
    expect_refused(all, 5, {.vector_unit = "abacus"});
    ik::solve_many(batch, all);  // without reports
    EXPECT_NE(joints_of(batch), before);
}

TEST(SolveMany, NeedsNoMemoryAndDoesWithoutThreadsWhereThereIsNone) {
    Random random(17);
    const Crowd crowd = some_crowd(4000, 10, random, 0.0f, 1.1f);
    const Answer expected = solve_many(crowd, {});
    for (const int threads : {1, 4}) {
        Batch batch = batch_of(crowd);
        std::vector<Report> reports(crowd.size());
        without_memory([&] { ik::solve_many(batch, crowd.targets, reports, {.threads = threads}); });
        EXPECT_EQ(difference({joints_of(batch), reports}, expected), "");
    }
}

TEST(Batch, StartsStraightAndKeepsWhatItIsGiven) {
    Batch batch(130, 3);
    EXPECT_EQ(batch.size(), 130u);
    EXPECT_EQ(batch.bones(), 3u);
    EXPECT_EQ(batch.reach(129), 3.0f);
    EXPECT_EQ(batch.joint(129, 2), glm::vec3(2, 0, 0));
    batch.set_lengths(128, Lengths{1, 2, 0.5f});
    batch.set_joints(128, Joints{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}});
    batch.set_root(128, {0, 0, 7});
    EXPECT_EQ(batch.length(128, 1), 2.0f);
    EXPECT_EQ(batch.reach(128), 3.5f);
    EXPECT_EQ(batch.joint(128, 0), glm::vec3(0, 0, 7));
    EXPECT_EQ(batch.joint(128, 3), glm::vec3(10, 11, 12));
    EXPECT_EQ(batch.joint(127, 3), glm::vec3(3, 0, 0));
    Joints out(4);
    batch.joints(128, out);
    EXPECT_EQ(out, (Joints{{0, 0, 7}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}));
    Batch moved = std::move(batch);
    EXPECT_EQ(moved.joint(128, 0), glm::vec3(0, 0, 7));

    Batch none(0, 1);
    ik::solve_many(none, {});
    EXPECT_EQ(none.size(), 0u);
}

TEST(Batch, RefusesWhatIsOutOfRangeAndKeepsWhatItWas) {
    Batch batch(2, 2);
    const std::vector<Joints> before = joints_of(batch);
    EXPECT_THROW(Batch(1, 0), std::invalid_argument);
    EXPECT_THROW(Batch(1, 1'000'001), std::invalid_argument);
    EXPECT_THROW(Batch((std::size_t{1} << 31) + 1, 1), std::invalid_argument);
    EXPECT_THROW(batch.set_lengths(2, Lengths{1, 1}), std::out_of_range);
    EXPECT_THROW(batch.set_joints(2, before[0]), std::out_of_range);
    EXPECT_THROW(batch.set_root(2, {}), std::out_of_range);
    EXPECT_THROW(batch.joint(0, 3), std::out_of_range);
    EXPECT_THROW(batch.length(0, 2), std::out_of_range);
    EXPECT_THROW(batch.reach(2), std::out_of_range);
    EXPECT_THROW(batch.set_root(0, {nan, 0, 0}), std::invalid_argument);
    EXPECT_THROW(batch.set_joints(0, Joints(2)), std::invalid_argument);
    EXPECT_THROW(batch.set_joints(0, Joints{{0, 0, 0}, {0, 0, 0}, {2e9f, 0, 0}}), std::invalid_argument);
    EXPECT_EQ(message_of<std::invalid_argument>([&] {
                  batch.set_lengths(0, Lengths{1, -2});
              }),
              "Batch: lengths[1] must be finite, at least 0 and at most 1e9, got -2");
    EXPECT_EQ(message_of<std::out_of_range>([&] { batch.set_root(5, {}); }),
              "Batch: chain 5 is out of range, there are 2");
    Joints small(2);
    EXPECT_THROW(batch.joints(0, small), std::invalid_argument);
    EXPECT_EQ(joints_of(batch), before);
    EXPECT_EQ(batch.length(0, 0), 1.0f);
}

}  // namespace
}  // namespace tendril::test
