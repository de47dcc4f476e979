// solve_many against the scalar solver: the same bits for any vector unit, threads and neighbours.
#include "ik_limit_support.hpp"
#include "ik_many_scalar.hpp"

namespace tendril::test::ik_many_test {
namespace {

TEST(SolveMany, TenThousandChainsMatchTheScalarSolverAtFixedIterations) {
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

TEST(SolveMany, EachChainStopsWithTheScalarSolver) {
    Random random(2);
    for (const std::size_t bones : {2u, 3u, 5u, 10u, 31u}) {
        const Crowd crowd = some_crowd(700, bones, random, 0.0f, 1.2f);  // some out of reach, some at the rim
        for (const int most : {1, 7, 8, 9, 100, 1000}) {
            const ManyOptions options{.max_iterations = most};
            expect_same(crowd, solve_many(crowd, options), solve_each(crowd, options), 1e-4);
        }
    }
}

TEST(SolveMany, AToleranceBelowFloatPrecisionStalls) {
    Random random(18);
    const Crowd crowd = some_crowd(500, 6, random, 0.1f, 0.95f);
    const ManyOptions options{.tolerance = 0.0f, .max_iterations = 2000};
    const Answer many = solve_many(crowd, options);
    expect_same(crowd, many, solve_each(crowd, options), 1e-4);
    const auto stalled = [](const ManyReport& report) { return report.status == Status::Stalled; };
    EXPECT_GT(std::count_if(many.reports.begin(), many.reports.end(), stalled), 5);
}

TEST(SolveMany, ChainsFarFromTheOriginMatchTheScalarSolver) {
    Random random(19);
    for (const float far : {900.0f, 2e3f, 3e4f, 1e6f}) {
        Crowd crowd;
        for (int i = 0; i < 300; ++i) {
            const Lengths lengths = some_lengths(5, random);
            const glm::vec3 root = some_direction(random) * far;
            const float reach = static_cast<float>(reach_of(lengths));
            const Joints pose = some_pose(lengths, random, root);
            crowd.add(lengths, pose, root + some_offset(random, 0.0f, 0.8f * reach));
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

TEST(SolveMany, EveryNumberOfChainsGivesTheSameBits) {
    Random random(5);
    const Crowd all = some_crowd(300, 4, random, 0.0f, 1.1f);
    ASSERT_FALSE(ik::vector_units().empty());
    for (const std::string_view unit : ik::vector_units()) {
        const Answer whole = solve_many(all, {.vector_unit = unit});
        EXPECT_EQ(difference(whole, solve_many(all, {})), "") << unit;
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
    // Near the rim, some take hundreds of iterations: those are solved outside their blocks.
    const Crowd crowd = some_crowd(5000, 10, random, 0.05f, 0.999f);
    const ManyOptions options{.max_iterations = 1000};
    const Answer one = solve_many(crowd, options);
    expect_same(crowd, one, solve_each(crowd, options), 1e-4);
    for (const int threads : {2, 3, 4, 256})
        for (int again = 0; again < 3; ++again)
            EXPECT_EQ(difference(solve_many(crowd, options, threads), one), "") << threads;
}

/// Degenerate chains: bones of no length, one dominant bone, coincident joints, poses straight or folded
/// nearly on the line to the target.
Crowd hostile_crowd(std::size_t chains, std::size_t bones, Random& random) {
    Crowd crowd;
    for (std::size_t i = 0; i < chains; ++i) {
        Lengths lengths = some_lengths(bones, random);
        if (random.chance(4)) lengths[random.below(bones)] = 0.0f;
        if (random.chance(4)) lengths[random.below(bones)] *= 6.0f;
        const glm::vec3 root = random.point(random.chance(8) ? 500.0f : 4.0f), along = some_direction(random);
        Joints pose = some_pose(lengths, random, root);
        if (random.chance(3)) pose = straight_joints(lengths, along, root);
        if (random.chance(6)) pose[1 + random.below(bones)] += random.point(1e-3f);
        if (random.chance(6)) pose[1 + random.below(bones)] = pose[random.below(bones)];
        const glm::vec3 to = random.chance(3) ? along : some_direction(random);
        const float far = random.chance(4) ? part(random) * 1e-2f : between(random, 0.0f, 1.05f);
        crowd.add(lengths, pose, root + to * (far * static_cast<float>(reach_of(lengths))));
    }
    return crowd;
}

TEST(SolveMany, HostileChainsMatchTheScalarSolver) {
    Random random(21);
    for (const std::size_t bones : {1u, 2u, 3u, 7u, 8u, 12u, 31u}) {
        const Crowd crowd = hostile_crowd(1500, bones, random);
        for (const ManyOptions& options :
             {ManyOptions{}, ManyOptions{.max_iterations = 3}, ManyOptions{.tolerance = 1e-5f},
              ManyOptions{.max_iterations = 12, .every_iteration = true}}) {
            SCOPED_TRACE(std::to_string(bones) + " bones, at most " + std::to_string(options.max_iterations));
            const Answer many = solve_many(crowd, options), each = solve_each(crowd, options);
            expect_same(crowd, many, each, 1e-4);
            std::size_t iterated = 0, equal = 0;
            for (std::size_t i = 0; i < crowd.size(); ++i) {
                const Status status = many.reports[i].status;
                // Straight and folded poses are computed in float.
                if (status == Status::Stretched || status == Status::TooClose) continue;
                ++iterated;
                equal += same_bits(many.joints[i], each.joints[i]) ? 1 : 0;
            }
            EXPECT_GE(equal, iterated * 999 / 1000);
        }
    }
}

TEST(SolveMany, TheSummaryCountsTheReports) {
    Random random(22);
    Crowd crowd = hostile_crowd(2000, 6, random);
    for (std::size_t i = 0; i < crowd.size(); i += 7) crowd.targets[i].z = nan;
    for (const int threads : {1, 3}) {
        Batch batch = batch_of(crowd, threads);
        std::vector<ManyReport> reports(crowd.size());
        const ik::ManySummary summary = ik::solve_many(batch, crowd.targets, reports);
        ik::ManySummary counted;
        for (const ManyReport& report : reports) {
            counted.invalid += report.status == Status::InvalidInput ? 1 : 0;
            counted.scalar_fallbacks += report.scalar_fallback ? 1 : 0;
        }
        counted.accepted = summary.accepted;
        EXPECT_EQ(summary, counted);
        EXPECT_TRUE(says(summary.accepted.message(), "solve_many targets[0].z nan"));
        EXPECT_EQ(summary.invalid, (crowd.size() + 6) / 7);
    }
}

TEST(SolveMany, AWholeCrowdOfStragglersIsSolved) {
    Random random(7);
    const Crowd crowd = some_crowd(1000, 10, random, 0.99f, 0.999f);
    const ManyOptions options{.max_iterations = 3000};
    expect_same(crowd, solve_many(crowd, options), solve_each(crowd, options), 1e-4);
}

TEST(SolveMany, ATargetMovingBackAndForthOnALineIsFollowed) {
    Batch batch = *Batch::make(200, 6);
    std::vector<ManyReport> reports(batch.size());
    for (int frame = 0; frame < 60; ++frame) {
        const float far = 6.5f + 3.0f * std::sin(0.37f * static_cast<float>(frame));
        const std::vector<glm::vec3> targets(batch.size(), glm::vec3(0, far, 0));
        ik::solve_many(batch, targets, reports);
        for (const ManyReport& report : reports)
            ASSERT_EQ(report.status, far > 6.0f ? Status::Stretched : Status::Converged) << "at " << far;
    }
}

// solve_many over the caller's joints: bitwise equal to a solve of the batch's own, which stay unchanged.

/// The joints of all chains, one chain after the other.
Joints all_joints(const std::vector<Joints>& of) {
    Joints all;
    for (const Joints& each : of) all.insert(all.end(), each.begin(), each.end());
    return all;
}

Answer solve_kept(Batch& batch, const Crowd& crowd, const ManyOptions& options) {
    Joints joints = all_joints(crowd.joints);
    Answer answer{{}, std::vector<ManyReport>(crowd.size())};
    const std::vector<Joints> own = joints_of(batch);
    without_memory([&] { ik::solve_many(batch, joints, crowd.targets, answer.reports, options); });
    EXPECT_EQ(all_joints(joints_of(batch)), all_joints(own));
    const auto each = static_cast<std::ptrdiff_t>(crowd.bones() + 1);
    for (auto at = joints.begin(); at != joints.end(); at += each) answer.joints.emplace_back(at, at + each);
    return answer;
}

Batch batch_of_lengths(const Crowd& crowd, int threads = 1) {
    Batch batch = *Batch::make(crowd.size(), crowd.bones(), threads);
    for (std::size_t i = 0; i < crowd.size(); ++i) EXPECT_TRUE(batch.set_lengths(i, crowd.lengths[i]));
    return batch;
}

TEST(SolveManyJoints, SolvesTheCallersJointsBitForBitLikeItsOwn) {
    Random random(61);
    for (const std::size_t bones : {1u, 2u, 3u, 4u, 10u, 31u}) {
        // Some are out of reach, some near full reach: those move between blocks.
        const Crowd crowd = some_crowd(501, bones, random, 0.0f, 1.05f);
        for (const int threads : {1, 3}) {
            Batch batch = batch_of_lengths(crowd, threads);
            for (const std::string_view unit : ik::vector_units())
                for (const ManyOptions& options :
                     {ManyOptions{.vector_unit = unit},
                      ManyOptions{.max_iterations = 7, .every_iteration = true, .vector_unit = unit},
                      ManyOptions{.tolerance = 0.0f, .vector_unit = unit}}) {
                    SCOPED_TRACE(std::string(unit) + ", " + std::to_string(bones) + " bones");
                    ASSERT_EQ(difference(solve_kept(batch, crowd, options), solve_many(crowd, options)), "");
                }
        }
    }
}

TEST(SolveManyJoints, AlsoWithinLimitsWithTheBatchsRotations) {
    Random random(62);
    const Arm arm = some_arm(random, ArmKind::Cones, 5);
    Crowd crowd;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 root = random.point(4.0f);
        crowd.add(arm.lengths, arm.at_rest(root), root + some_tip(arm, random));
    }
    Batch own = batch_of(crowd), kept = batch_of_lengths(crowd);
    std::vector<glm::quat> own_rotations(crowd.size() * 5), kept_rotations(own_rotations.size());
    for (int tick = 0; tick < 3; ++tick) {
        ASSERT_TRUE(own.set_limits(arm.limits, arm.rest) && kept.set_limits(arm.limits, arm.rest));
        Answer expected{{}, std::vector<ManyReport>(crowd.size())};
        ik::solve_many(own, crowd.targets, expected.reports);
        expected.joints = joints_of(own);
        ASSERT_EQ(difference(solve_kept(kept, crowd, {}), expected), "") << tick;
        ASSERT_TRUE(own.copy_rotations(own_rotations) && kept.copy_rotations(kept_rotations));
        EXPECT_EQ(own_rotations, kept_rotations);
        crowd.joints = expected.joints;
        for (glm::vec3& target : crowd.targets) target += random.point(0.05f);
    }
}

TEST(SolveManyJoints, ABadJointHarmsNoOtherChain) {
    Random random(63);
    Crowd crowd = some_crowd(333, 6, random);
    const Answer good = solve_many(crowd, {});
    const float bad[] = {nan, infinity, -infinity, 1.1e9f};
    for (std::size_t i = 0; i < crowd.size(); i += 3) {
        const int axis = static_cast<int>(random.below(3));
        crowd.joints[i][random.below(7)][axis] = bad[random.below(4)];
    }
    for (const bool limited : {false, true}) {
        Batch batch = batch_of_lengths(crowd);
        const std::vector<ik::Limit> limits(6, ik::Limit::of(ik::JointKind::BallAndSocket));
        if (limited) {
            ASSERT_TRUE(batch.set_limits(limits));
        }
        for (const std::string_view unit : ik::vector_units()) {
            const Answer many = solve_kept(batch, crowd, {.vector_unit = unit});
            for (std::size_t i = 0; i < crowd.size(); ++i) {
                if (i % 3 != 0) {
                    EXPECT_NE(many.reports[i].status, Status::InvalidInput) << "chain " << i;
                    EXPECT_TRUE(limited || same_bits(many.joints[i], good.joints[i])) << "chain " << i;
                } else {
                    EXPECT_EQ(many.reports[i], refused_chain);
                    EXPECT_TRUE(same_bits(many.joints[i], crowd.joints[i])) << "chain " << i;
                }
            }
        }
    }
}

}  // namespace
}  // namespace tendril::test::ik_many_test
