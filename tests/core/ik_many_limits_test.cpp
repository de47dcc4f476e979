// solve_many within limits: joints stay within their limits, every target that the scalar solver reaches is
// reached, and cases beyond the vector units are bitwise the scalar solver's answer.
#include "ik_limit_support.hpp"
#include "ik_many_scalar.hpp"

namespace tendril::test::ik_many_limits_test {
namespace {

using ik::Limit;
using Rotations = std::vector<glm::quat>;

/// One arm for a whole crowd, each at rest at its own position.
struct LimitedCrowd {
    Arm arm;
    Crowd crowd;
};

LimitedCrowd limited_crowd(std::size_t chains, std::size_t bones, ArmKind kind, Random& random) {
    LimitedCrowd all{some_arm(random, kind, bones), {}};
    for (std::size_t i = 0; i < chains; ++i) {
        const glm::vec3 root = random.point(4.0f);
        all.crowd.add(all.arm.lengths, all.arm.at_rest(root), root + some_tip(all.arm, random));
    }
    return all;
}

struct LimitedAnswer {
    Answer answer;
    Rotations rotations;
    ik::ManySummary summary;

    std::span<const glm::quat> of(std::size_t chain) const {
        const std::size_t bones = answer.joints[chain].size() - 1;
        return std::span(rotations).subspan(chain * bones, bones);
    }
};

Batch batch_of(const LimitedCrowd& all, int threads = 1) {
    Batch batch = batch_of(all.crowd, threads);
    EXPECT_TRUE(batch.set_limits(all.arm.limits, all.arm.rest));
    return batch;
}

LimitedAnswer solve(Batch& batch, const Crowd& crowd, const ManyOptions& options = {}) {
    LimitedAnswer all{
        {{}, std::vector<ManyReport>(crowd.size())}, Rotations(crowd.size() * crowd.bones()), {}};
    all.summary = ik::solve_many(batch, crowd.targets, all.answer.reports, options);
    all.answer.joints = joints_of(batch);
    EXPECT_TRUE(batch.copy_rotations(all.rotations));
    return all;
}

LimitedAnswer solve_limited(const LimitedCrowd& all, const ManyOptions& options = {}, int threads = 1) {
    Batch batch = batch_of(all, threads);
    return solve(batch, all.crowd, options);
}

/// Report, joints and rotations of the scalar solver.
struct ScalarAnswer {
    ik::Report report;
    Joints joints;
    Rotations rotations;
};

ScalarAnswer solve_alone(const LimitedCrowd& all, std::size_t chain, const ManyOptions& many = {}) {
    KeptSolver solver = all.arm.solver();
    ik::Options options{.max_iterations = many.max_iterations,
                        .every_iteration = many.every_iteration,
                        .limits = all.arm.limits};
    ScalarAnswer alone{{}, all.crowd.joints[chain], {}};
    alone.report = solver.solve(ik::Method::Fabrik, alone.joints, all.crowd.targets[chain], options);
    alone.rotations.assign(solver.rotations().begin(), solver.rotations().end());
    return alone;
}

void expect_fallback_is_scalar(const LimitedCrowd& all, const LimitedAnswer& many, std::size_t chain,
                               const ManyOptions& options = {}) {
    const ScalarAnswer alone = solve_alone(all, chain, options);
    ManyReport expected = many_report(alone.report);
    expected.scalar_fallback = true;
    EXPECT_EQ(many.answer.reports[chain], expected) << "chain " << chain;
    EXPECT_TRUE(same_bits(many.answer.joints[chain], alone.joints)) << "chain " << chain;
}

std::string difference(const LimitedAnswer& a, const LimitedAnswer& b) {
    if (!(a.rotations == b.rotations)) return "rotations";
    return difference(a.answer, b.answer);
}

TEST(SolveManyWithinLimits, KeepsLimitsAndReachesWhatTheScalarSolverReaches) {
    Random random(51);
    for (const ArmKind kind : arm_kinds)
        for (const std::size_t bones : {2u, 3u, 5u, 10u}) {
            SCOPED_TRACE(std::string(name(kind)) + ", " + std::to_string(bones) + " bones");
            const LimitedCrowd all = limited_crowd(150, bones, kind, random);
            const LimitedAnswer many = solve_limited(all);
            for (std::size_t i = 0; i < all.crowd.size(); ++i) {
                EXPECT_TRUE(WithinLimits(all.arm, many.answer.joints[i], many.of(i))) << "chain " << i;
                EXPECT_TRUE(Holds(many.answer.joints[i], all.crowd.lengths[i])) << "chain " << i;
                const ManyReport& report = many.answer.reports[i];
                if (report.status == Status::Converged) {
                    EXPECT_LE(distance(many.answer.joints[i].back(), all.crowd.targets[i]),
                              1.01e-3 * reach_of(all.crowd.lengths[i]));
                } else {
                    EXPECT_TRUE(report.scalar_fallback);
                }
                if (report.scalar_fallback && i % 10 == 0) expect_fallback_is_scalar(all, many, i);
            }
        }
}

TEST(SolveManyWithinLimits, HingesAndConesRarelyNeedTheScalarSolver) {
    Random random(52);
    for (const std::size_t bones : {3u, 10u, 30u}) {
        Arm arm;
        for (std::size_t i = 0; i < bones; ++i) {
            arm.lengths.push_back(1.0f);
            arm.rest.emplace_back(1, 0, 0);
            Limit limit = Limit::hinge({0, i % 4 == 1 ? 1.0f : 0.0f, i % 4 == 1 ? 0.0f : 1.0f}, -2.0f, 2.0f);
            if (i % 2 == 0) {
                limit = Limit::of(ik::JointKind::BallAndSocket);
                limit.up = limit.down = 1.4f, limit.left = limit.right = 1.2f;
                limit.twist_min = -1.0f, limit.twist_max = 1.0f;
            }
            arm.limits.push_back(limit);
        }
        LimitedCrowd all{arm, {}};
        for (int i = 0; i < 300; ++i) all.crowd.add(arm.lengths, arm.at_rest(), some_tip(arm, random));
        const LimitedAnswer many = solve_limited(all);
        for (const ManyReport& report : many.answer.reports) EXPECT_EQ(report.status, Status::Converged);
        EXPECT_LE(many.summary.scalar_fallbacks, 12u) << bones << " bones";
    }
}

TEST(SolveManyWithinLimits, VectorUnitsThreadsAndNeighboursChangeNoBit) {
    Random random(53);
    for (const ArmKind kind : {ArmKind::Cones, ArmKind::Human}) {
        const LimitedCrowd all = limited_crowd(900, 9, kind, random);
        const LimitedAnswer widest = solve_limited(all);
        for (const std::string_view unit : ik::vector_units())
            EXPECT_EQ(difference(solve_limited(all, {.vector_unit = unit}), widest), "") << unit;
        EXPECT_EQ(difference(solve_limited(all, {}, 3), widest), "");
        for (const std::size_t count : {1u, 7u, 81u, 200u}) {
            LimitedCrowd some = all;
            some.crowd.lengths.resize(count), some.crowd.joints.resize(count),
                some.crowd.targets.resize(count);
            EXPECT_EQ(difference(solve_limited(some).answer, widest.answer), "") << count << " chains";
        }
    }
}

TEST(SolveManyWithinLimits, FallbacksAreTheScalarSolversAnswer) {
    Random random(54);
    LimitedCrowd all = limited_crowd(60, 4, ArmKind::Human, random);
    for (std::size_t i = 0; i < all.crowd.size(); i += 2) {  // out of reach
        all.crowd.targets[i] =
            all.crowd.joints[i].front() + some_direction(random) * (2.0f * all.arm.reach());
    }
    const LimitedAnswer many = solve_limited(all);
    for (std::size_t i = 0; i < all.crowd.size(); i += 2) expect_fallback_is_scalar(all, many, i);
    const ManyOptions every{.max_iterations = 5, .every_iteration = true};
    const LimitedAnswer forced = solve_limited(all, every);
    for (std::size_t i = 0; i < all.crowd.size(); ++i) expect_fallback_is_scalar(all, forced, i, every);
    all.arm.limits[1] = Limit::of(ik::JointKind::Suture);
    all.arm.limits[1].axis = some_axis(random, all.arm.rest[1]);
    const LimitedAnswer flat = solve_limited(all);
    EXPECT_EQ(flat.summary.scalar_fallbacks, all.crowd.size());
    for (std::size_t i = 1; i < all.crowd.size(); i += 9) expect_fallback_is_scalar(all, flat, i);
}

/// Two chains whose fallbacks look like one dragged chain: the scalar solver must not treat them as such.
TEST(SolveManyWithinLimits, AFallbackDoesNotDependOnTheChainBeforeIt) {
    Random random(59);
    for (int round = 0; round < 20; ++round) {
        LimitedCrowd all = limited_crowd(1, 4, ArmKind::Human, random);
        all.crowd.targets[0] =
            all.crowd.joints[0].front() - some_tip(all.arm, random);  // behind: mostly forbidden
        for (int i = 0; i < 8; ++i)
            all.crowd.add(all.crowd.lengths[0], all.crowd.joints[0],
                          all.crowd.targets[0] + random.point(0.01f));
        const LimitedAnswer many = solve_limited(all);
        for (std::size_t i = 0; i < all.crowd.size(); ++i) {
            if (many.answer.reports[i].scalar_fallback) expect_fallback_is_scalar(all, many, i);
        }
    }
}

TEST(SolveManyWithinLimits, AChainThatHasArrivedStaysBitForBit) {
    Random random(55);
    const LimitedCrowd all = limited_crowd(300, 6, ArmKind::Human, random);
    Batch batch = batch_of(all);
    const LimitedAnswer first = solve(batch, all.crowd), second = solve(batch, all.crowd);
    for (std::size_t i = 0; i < all.crowd.size(); ++i) {
        const ManyReport& report = first.answer.reports[i];
        if (report.status != Status::Converged || report.scalar_fallback) continue;
        EXPECT_TRUE(same_bits(first.answer.joints[i], second.answer.joints[i])) << "chain " << i;
        EXPECT_EQ(second.answer.reports[i].iterations, 0) << "chain " << i;
    }
}

TEST(SolveManyWithinLimits, RotationsFollowJointsThatNeedNotMove) {
    Random random(58);
    Arm arm;
    for (int i = 0; i < 4; ++i) {
        arm.lengths.push_back(1.0f);
        arm.rest.emplace_back(1, 0, 0);
        Limit limit = Limit::of(ik::JointKind::BallAndSocket);
        limit.up = limit.down = limit.left = limit.right = 1.5f;
        arm.limits.push_back(limit);
    }
    LimitedCrowd all{arm, {}};
    for (int i = 0; i < 100; ++i) all.crowd.add(arm.lengths, arm.at_rest(), some_tip(arm, random));
    const LimitedAnswer bent = solve_limited(all);
    for (std::size_t i = 0; i < all.crowd.size(); ++i) {
        all.crowd.joints[i] = bent.answer.joints[i];
        all.crowd.targets[i] = bent.answer.joints[i].back();
    }
    const LimitedAnswer stays = solve_limited(all);  // starting from rotations at rest
    int stayed = 0;
    for (std::size_t i = 0; i < all.crowd.size(); ++i) {
        if (stays.answer.reports[i].scalar_fallback || stays.answer.reports[i].iterations > 0) continue;
        ++stayed;
        EXPECT_TRUE(same_bits(stays.answer.joints[i], bent.answer.joints[i])) << "chain " << i;
        EXPECT_TRUE(WithinLimits(all.arm, stays.answer.joints[i], stays.of(i))) << "chain " << i;
    }
    EXPECT_GT(stayed, 10);
}

TEST(SolveManyWithinLimits, ARestoredBatchContinuesWithTheSameBits) {
    Random random(56);
    const LimitedCrowd all = limited_crowd(200, 5, ArmKind::Cones, random);
    Batch batch = batch_of(all);
    std::vector<std::vector<glm::vec3>> path(30, all.crowd.targets);
    for (std::size_t tick = 1; tick < path.size(); ++tick)
        for (std::size_t i = 0; i < all.crowd.size(); ++i)
            path[tick][i] = path[tick - 1][i] + random.point(0.02f);
    ik::solve_many(batch, path.front());
    Joints before(all.crowd.size() * 6), first(before.size()), second(before.size());
    Rotations turned(all.crowd.size() * 5), once(turned.size()), again(turned.size());
    ASSERT_TRUE(batch.copy_joints(before));
    ASSERT_TRUE(batch.copy_rotations(turned));
    for (const auto& targets : path) ik::solve_many(batch, targets);
    ASSERT_TRUE(batch.copy_joints(first));
    ASSERT_TRUE(batch.copy_rotations(once));
    ASSERT_TRUE(batch.set_joints(before));
    ASSERT_TRUE(batch.set_rotations(turned));
    for (const auto& targets : path) ik::solve_many(batch, targets);
    ASSERT_TRUE(batch.copy_joints(second));
    ASSERT_TRUE(batch.copy_rotations(again));
    EXPECT_TRUE(same_bits(first, second));
    EXPECT_EQ(once, again);
}

TEST(SolveManyWithinLimits, BadTargetsAndMovedJointsHarmNoOtherChain) {
    Random random(57);
    LimitedCrowd all = limited_crowd(300, 5, ArmKind::Human, random);
    for (std::size_t i = 0; i < all.crowd.size(); ++i) {
        if (i % 3 == 0) all.crowd.targets[i].y = nan;
        if (i % 3 == 1) all.crowd.joints[i] = some_pose(all.arm.lengths, random, all.crowd.joints[i].front());
        if (i % 9 == 1) all.crowd.joints[i][2] = all.crowd.joints[i][1];
    }
    const LimitedAnswer many = solve_limited(all);
    EXPECT_EQ(many.summary.invalid, 100u);
    for (std::size_t i = 0; i < all.crowd.size(); ++i) {
        if (i % 3 == 0) {
            EXPECT_EQ(many.answer.reports[i], refused_chain);
            EXPECT_TRUE(same_bits(many.answer.joints[i], all.crowd.joints[i]));
        } else {
            EXPECT_TRUE(WithinLimits(all.arm, many.answer.joints[i], many.of(i))) << "chain " << i;
            EXPECT_TRUE(Holds(many.answer.joints[i], all.crowd.lengths[i])) << "chain " << i;
        }
    }
}

TEST(Batch, RefusesInvalidLimits) {
    Batch batch = *Batch::make(3, 2);
    Rotations rotations(6, glm::quat(1, 0, 0, 0));
    EXPECT_EQ(batch.set_rotations(rotations).code(), ErrorCode::NotFound);
    EXPECT_EQ(batch.copy_rotations(rotations).code(), ErrorCode::NotFound);
    const std::vector<Limit> elbow(2, Limit::of(ik::JointKind::Hinge));
    const auto invalid = [](const Result& result) { return result.code() == ErrorCode::InvalidArgument; };
    EXPECT_TRUE(invalid(batch.set_limits(std::span(elbow).first(1))));
    EXPECT_TRUE(invalid(batch.set_limits(elbow, Joints{{1, 0, 0}})));
    EXPECT_TRUE(invalid(batch.set_limits(elbow, Joints{{1, 0, 0}, {2, 0, 0}})));
    EXPECT_TRUE(invalid(batch.set_limits(elbow, Joints{{1, 0, 0}, {0, 0, 1}})));  // along the hinge's axis
    EXPECT_EQ(batch.set_rotations(rotations).code(), ErrorCode::NotFound);
    ASSERT_TRUE(batch.set_limits(elbow));
    ASSERT_TRUE(batch.set_rotations(rotations));
    rotations[4].x = 3.0f;
    EXPECT_TRUE(invalid(batch.set_rotations(rotations)));
    EXPECT_TRUE(invalid(batch.set_rotations(std::span(rotations).first(5))));
    ASSERT_TRUE(batch.set_limits({}));
    EXPECT_EQ(batch.copy_rotations(rotations).code(), ErrorCode::NotFound);
}

TEST(SolveManyWithinLimits, LimitsWithOtherRestDirectionsStartOver) {
    std::vector<ik::Limit> limits(3,
                                  ik::Limit::of(ik::JointKind::Suture));  // flat: left to the scalar solver
    for (ik::Limit& limit : limits) limit.axis = {0, 0, 1}, limit.up = limit.down = 0.5f;
    const auto solved = [&](bool first_along_x) {
        ik::Batch batch = ik::Batch::make(1, 3).value();
        const std::vector<glm::vec3> targets{{1.0f, 2.0f, 0.5f}};
        if (first_along_x) {
            EXPECT_TRUE(batch.set_limits(limits, std::vector<glm::vec3>(3, {1, 0, 0})));
            ik::solve_many(batch, targets);
        }
        EXPECT_TRUE(batch.set_limits(limits, std::vector<glm::vec3>(3, {0, 1, 0})));
        const Joints start = straight_joints(Lengths(3, 1.0f), {0, 1, 0});
        EXPECT_TRUE(batch.set_joints(0, start));
        ik::solve_many(batch, targets);
        Joints joints(4);
        EXPECT_TRUE(batch.copy_joints(0, joints));
        return joints;
    };
    EXPECT_TRUE(same_bits(solved(true), solved(false)));
}

TEST(SolveManyWithinLimits, StiffJointsAreTheScalarSolversBitForBit) {
    Random random(61);
    LimitedCrowd all = limited_crowd(40, 4, ArmKind::Hinges, random);
    all.arm.limits[1].stiffness = 0.8f;
    const LimitedAnswer many = solve_limited(all);
    for (std::size_t i = 0; i < all.crowd.size(); ++i) expect_fallback_is_scalar(all, many, i);
}

}  // namespace
}  // namespace tendril::test::ik_many_limits_test
