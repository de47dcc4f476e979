// solve_many with torn, moving, hostile and out-of-range input; and the class Batch.
#include "ik_many_scalar.hpp"

namespace tendril::test::ik_many_hostile_test {
namespace {

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

TEST(SolveMany, CoincidingJointsOnAGridAreLaidLikeTheScalarSolvers) {
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

TEST(SolveMany, MovingRootsCarryTheirChains) {
    Random random(13);
    const Crowd crowd = some_crowd(300, 6, random, 0.3f, 0.8f);
    Batch batch = batch_of(crowd);
    std::vector<Joints> each = crowd.joints;
    std::vector<glm::vec3> targets = crowd.targets;
    std::vector<ManyReport> reports(crowd.size());
    for (int frame = 0; frame < 20; ++frame) {
        for (std::size_t i = 0; i < crowd.size(); ++i) {
            const glm::vec3 by = random.point(0.1f);
            targets[i] += by;
            each[i].front() += by;
            ASSERT_TRUE(batch.set_root(i, each[i].front()));
            KeptSolver solver(crowd.lengths[i]);
            reports[i] = many_report(solver.solve(ik::Method::Fabrik, each[i], targets[i]));
        }
        std::vector<ManyReport> many(crowd.size());
        ik::solve_many(batch, targets, many);
        for (ManyReport& report : many) report.scalar_fallback = false;
        ASSERT_EQ(difference({joints_of(batch), many}, {each, reports}), "") << "frame " << frame;
    }
}

TEST(SolveMany, ABadTargetHarmsNoOtherChain) {
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
                EXPECT_EQ(many.reports[i], refused_chain);
                EXPECT_TRUE(same_bits(many.joints[i], crowd.joints[i]));
            } else if (!every) {
                EXPECT_TRUE(same_bits(many.joints[i], good.joints[i])) << "chain " << i;
            }
            EXPECT_EQ(many.reports[i].status, each.reports[i].status);
        }
    }
}

TEST(SolveMany, HostileNumbersNeverGiveNaN) {
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
            EXPECT_NE(std::isfinite(many.reports[i].residual), invalid);
            for (const glm::vec3& joint : many.joints[i])
                ASSERT_TRUE(std::isfinite(joint.x) && std::isfinite(joint.y) && std::isfinite(joint.z));
            EXPECT_TRUE(invalid || Holds(many.joints[i], crowd.lengths[i]));
        }
    }
}

TEST(SolveMany, JointsLeftTooFarOutAreInvalidNextTime) {
    Crowd crowd;
    // Straight towards a target out of reach, beyond the range of coordinates.
    crowd.add({1e9f, 1e9f}, {{0, 5e8f, 0}, {5e8f, 9.9e8f, 1}, {1e9f, 1e8f, 0}}, {1, 1e9f, 0});
    crowd.add({1, 1}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {0, 1.5f, 0});
    Batch batch = batch_of(crowd);
    std::vector<ManyReport> reports(2);
    ik::solve_many(batch, crowd.targets, reports);
    EXPECT_NE(reports[0].status, Status::InvalidInput);
    const std::vector<Joints> after = joints_of(batch);
    ASSERT_TRUE(
        std::any_of(after[0].begin(), after[0].end(), [](glm::vec3 joint) { return joint.y > 1e9f; }));
    EXPECT_TRUE(
        says(ik::solve_many(batch, crowd.targets, reports).accepted.message(), "solve_many chains[0] 1e9"));
    EXPECT_EQ(reports[0].status, Status::InvalidInput);
    EXPECT_EQ(reports[1].status, Status::Converged);
    EXPECT_TRUE(same_bits(joints_of(batch)[0], after[0]));
}

TEST(SolveMany, NeedsNoMemoryWithOrWithoutThreads) {
    Random random(17);
    const Crowd crowd = some_crowd(4000, 10, random, 0.0f, 1.1f);
    const Answer expected = solve_many(crowd, {});
    for (const int threads : {1, 4}) {
        Batch batch = batch_of(crowd, threads);
        std::vector<ManyReport> reports(crowd.size());
        without_memory([&] { ik::solve_many(batch, crowd.targets, reports); });
        EXPECT_EQ(difference({joints_of(batch), reports}, expected), "");
    }
}

TEST(Batch, StartsStraightAndKeepsWhatItIsGiven) {
    Batch batch = *Batch::make(130, 3);
    EXPECT_EQ(batch.size(), 130u);
    EXPECT_EQ(batch.bones(), 3u);
    EXPECT_EQ(batch.reach(129), 3.0f);
    EXPECT_EQ(batch.joint(129, 2), glm::vec3(2, 0, 0));
    EXPECT_TRUE(batch.set_lengths(128, Lengths{1, 2, 0.5f}));
    EXPECT_TRUE(batch.set_joints(128, Joints{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}));
    EXPECT_TRUE(batch.set_root(128, {0, 0, 7}));
    EXPECT_EQ(batch.length(128, 1), 2.0f);
    EXPECT_EQ(batch.reach(128), 3.5f);
    EXPECT_EQ(batch.joint(128, 0), glm::vec3(0, 0, 7));
    EXPECT_EQ(batch.joint(128, 3), glm::vec3(10, 11, 12));
    EXPECT_EQ(batch.joint(127, 3), glm::vec3(3, 0, 0));
    Joints out(4);
    EXPECT_TRUE(batch.copy_joints(128, out));
    EXPECT_EQ(out, (Joints{{0, 0, 7}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}));
    Batch moved = std::move(batch);
    EXPECT_EQ(moved.joint(128, 0), glm::vec3(0, 0, 7));

    Batch none = *Batch::make(0, 1);
    ik::solve_many(none, {});
    EXPECT_EQ(none.size(), 0u);
}

TEST(Batch, AllJointsAtOnceEqualEachChains) {
    Random random(20);
    for (const std::size_t bones : {1u, 2u, 3u, 4u, 7u, 10u})
        for (const std::size_t chains : {0u, 1u, 3u, 4u, 5u, 63u, 64u, 65u, 200u}) {
            Batch batch = *Batch::make(chains, bones);
            Joints in(chains * (bones + 1)), out(in.size());
            for (glm::vec3& joint : in) joint = random.point(9.0f);
            ASSERT_TRUE(batch.set_joints(in));
            ASSERT_TRUE(batch.copy_joints(out));
            EXPECT_TRUE(same_bits(in, out));
            for (std::size_t i = 0; i < in.size(); ++i)
                ASSERT_EQ(batch.joint(i / (bones + 1), i % (bones + 1)), in[i]);
            if (in.empty()) continue;
            in[random.below(in.size())].y = nan;
            EXPECT_EQ(batch.set_joints(in).code(), ErrorCode::InvalidArgument);
            Joints kept(out.size());
            ASSERT_TRUE(batch.copy_joints(kept));
            EXPECT_TRUE(same_bits(kept, out));
        }
}

TEST(Batch, RefusesInputOutOfRangeAndStaysUnchanged) {
    EXPECT_EQ(Batch::make(1, 0).code(), ErrorCode::InvalidArgument);
    EXPECT_EQ(Batch::make(1, 1'000'001).code(), ErrorCode::InvalidArgument);
    EXPECT_EQ(Batch::make((std::size_t{1} << 31) + 1, 1).code(), ErrorCode::InvalidArgument);
    for (const int threads : {0, -1, 257})
        EXPECT_EQ(Batch::make(1, 1, threads).code(), ErrorCode::InvalidArgument);
    Batch batch = *Batch::make(2, 2);
    const std::vector<Joints> before = joints_of(batch);
    Joints small(2);
    const auto out_of_range = [](const Result& result) { return result.code() == ErrorCode::OutOfRange; };
    const auto invalid = [](const Result& result) { return result.code() == ErrorCode::InvalidArgument; };
    EXPECT_TRUE(out_of_range(batch.set_lengths(2, Lengths{1, 1})));
    EXPECT_TRUE(out_of_range(batch.set_joints(2, before[0])));
    EXPECT_TRUE(out_of_range(batch.set_root(2, {})));
    EXPECT_TRUE(out_of_range(batch.copy_joints(2, small)));
    EXPECT_TRUE(invalid(batch.set_root(0, {nan, 0, 0})));
    EXPECT_TRUE(invalid(batch.set_joints(0, Joints(2))));
    EXPECT_TRUE(invalid(batch.set_joints(Joints(2))));
    EXPECT_TRUE(invalid(batch.set_joints(0, Joints{{0, 0, 0}, {0, 0, 0}, {2e9f, 0, 0}})));
    EXPECT_TRUE(invalid(batch.copy_joints(0, small)));
    EXPECT_TRUE(invalid(batch.copy_joints(small)));
    EXPECT_TRUE(
        says(batch.set_lengths(0, Lengths{1, -2}).message(), "set_lengths lengths[1] finite 0 1e9 -2"));
    EXPECT_TRUE(says(batch.set_root(5, {}).message(), "set_root index 5 range 2"));
    EXPECT_EQ(joints_of(batch), before);
    EXPECT_EQ(batch.length(0, 0), 1.0f);
}

}  // namespace
}  // namespace tendril::test::ik_many_hostile_test
