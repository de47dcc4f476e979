// solve_many over the caller's joints: bitwise equal to a solve of the batch's own, which stay unchanged.
#include "ik_limit_support.hpp"
#include "ik_many_support.hpp"

namespace tendril::test::ik_many_joints_test {
namespace {

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
                    EXPECT_EQ(many.reports[i], (ManyReport{.status = Status::InvalidInput}));
                    EXPECT_TRUE(same_bits(many.joints[i], crowd.joints[i])) << "chain " << i;
                }
            }
        }
    }
}

TEST(SolveManyJoints, AWrongNumberIsRefused) {
    Random random(64);
    const Crowd crowd = some_crowd(5, 3, random);
    Batch batch = batch_of_lengths(crowd);
    for (const std::size_t count : {0u, 5u, 15u, 19u, 21u}) {
        Joints joints(count, glm::vec3(1.0f));
        std::vector<ManyReport> reports(5);
        EXPECT_EQ(ik::solve_many(batch, joints, crowd.targets, reports).invalid, 5u);
        for (const ManyReport& report : reports) EXPECT_EQ(report.status, Status::InvalidInput);
        EXPECT_EQ(joints, Joints(count, glm::vec3(1.0f)));
    }
}

}  // namespace
}  // namespace tendril::test::ik_many_joints_test
