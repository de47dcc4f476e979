// Many chains at once through the C interface: the library's own bits.
#include <tendril/ik/many.hpp>

#include "arm.hpp"

namespace tendril::test {
namespace {

constexpr std::size_t chains = 100, bones = 5;

std::vector<glm::vec3> some_targets(std::uint64_t seed) {
    Random random(seed);
    std::vector<glm::vec3> targets(chains);
    for (glm::vec3& target : targets) target = random.point(4.0f);
    return targets;
}
const tendril_vec3f* c_points(const std::vector<glm::vec3>& points) {
    return reinterpret_cast<const tendril_vec3f*>(points.data());
}

class CMany : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_DONE(tendril_ik_batch_make(chains, bones, 4, &c_batch, &error));
        const float lengths[bones] = {1.0f, 0.8f, 0.7f, 0.5f, 0.2f};
        ASSERT_TRUE(batch.set_lengths(lengths));
        ASSERT_DONE(tendril_ik_batch_set_lengths(c_batch, lengths, bones, &error));
    }
    void TearDown() override { EXPECT_EQ(tendril_ik_batch_destroy(c_batch), TENDRIL_OK); }

    void expect_same_joints() {
        std::vector<glm::vec3> joints(chains * (bones + 1));
        std::vector<tendril_vec3f> c_joints(joints.size());
        ASSERT_TRUE(batch.copy_joints(joints));
        ASSERT_DONE(tendril_ik_batch_joints(c_batch, c_joints.data(), c_joints.size(), &error));
        EXPECT_TRUE(same_bytes(joints, c_joints));
    }

    ik::Batch batch = *ik::Batch::make(chains, bones, 4);
    tendril_ik_batch c_batch{};
    tendril_ik_many_summary summary = tendril_ik_many_summary_default();
    tendril_error error{};
};

TEST_F(CMany, SolvesToTheLibrarysBits) {
    std::vector<ik::ManyReport> reports(chains);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        auto targets = some_targets(seed);
        targets[7].x = NAN;
        const ik::ManySummary expected = solve_many(batch, targets, reports);
        ASSERT_DONE(
            tendril_ik_batch_solve(c_batch, c_points(targets), chains, nullptr, nullptr, &summary, &error));
        EXPECT_EQ(summary.invalid, 1u);
        EXPECT_EQ(summary.first_invalid, 7u);
        EXPECT_EQ(summary.scalar_fallbacks, expected.scalar_fallbacks);
        ASSERT_NO_FATAL_FAILURE(expect_same_joints());
        for (std::size_t i = 0; i < chains; ++i) {
            tendril_ik_many_report report = tendril_ik_many_report_default();
            ASSERT_DONE(tendril_ik_batch_report(c_batch, i, &report, &error));
            EXPECT_EQ(static_cast<int>(report.status), static_cast<int>(reports[i].status));
            EXPECT_EQ(report.iterations, reports[i].iterations);
            EXPECT_EQ(report.residual, reports[i].residual);
        }
    }
    tendril_ik_many_report report = tendril_ik_many_report_default();
    EXPECT_EQ(tendril_ik_batch_report(c_batch, chains, &report, &error), TENDRIL_OUT_OF_RANGE);
}

TEST_F(CMany, SolvesJointsOfTheCallerWithinLimits) {
    std::vector<ik::Limit> limits(bones, ik::Limit::of(ik::JointKind::BallAndSocket));
    std::vector<tendril_ik_limit> c_limits;
    for (const ik::Limit& limit : limits) c_limits.push_back(to_c(limit));
    ASSERT_TRUE(batch.set_limits(limits));
    ASSERT_DONE(tendril_ik_batch_set_limits(c_batch, c_limits.data(), bones, nullptr, 0, &error));
    std::vector<glm::vec3> joints(chains * (bones + 1));
    ASSERT_TRUE(batch.copy_joints(joints));
    auto c_joints = joints;
    const auto targets = some_targets(11);
    solve_many(batch, joints, targets, {}, {.max_iterations = 50});
    tendril_ik_many_options options = tendril_ik_many_options_default();
    options.max_iterations = 50;
    ASSERT_DONE(tendril_ik_batch_solve_joints(c_batch, reinterpret_cast<tendril_vec3f*>(c_joints.data()),
                                              c_joints.size(), c_points(targets), chains, &options, nullptr,
                                              nullptr, &error));
    EXPECT_EQ(joints, c_joints);
    std::vector<glm::quat> turns(chains * bones);
    std::vector<tendril_quatf> c_turns(turns.size());
    ASSERT_TRUE(batch.copy_rotations(turns));
    ASSERT_DONE(tendril_ik_batch_rotations(c_batch, c_turns.data(), c_turns.size(), &error));
    EXPECT_TRUE(same_bytes(turns, c_turns));
}

TEST_F(CMany, RunsOnTheProgramsJobsWithTheSameBits) {
    tendril_ik_batch large{};
    ASSERT_DONE(tendril_ik_batch_make(20'000, bones, 4, &large, &error));
    const std::size_t count = 20'000 * (bones + 1);
    std::vector<tendril_vec3f> targets(20'000), joints[2];
    for (std::size_t i = 0; i < targets.size(); ++i)
        targets[i] = {2.0f, 0.0001f * static_cast<float>(i), 1.0f};
    std::vector<tendril_vec3f> straight(count);
    ASSERT_DONE(tendril_ik_batch_joints(large, straight.data(), count, &error));
    int calls = 0;
    const auto run = [](void* user, void (*task)(void*, uint32_t), void* context, uint32_t pieces) {
        ++*static_cast<int*>(user);
        for (std::uint32_t i = pieces; i-- > 0;) task(context, i);
    };
    const tendril_tasks tasks{run, &calls};
    for (const bool ours : {false, true}) {
        joints[ours] = straight;
        ASSERT_DONE(tendril_ik_batch_solve_joints(large, joints[ours].data(), count, targets.data(), 20'000,
                                                  nullptr, ours ? &tasks : nullptr, nullptr, &error));
    }
    EXPECT_GT(calls, 0);
    EXPECT_TRUE(same_bytes(joints[0], joints[1]));
    EXPECT_EQ(tendril_ik_batch_destroy(large), TENDRIL_OK);
}

TEST_F(CMany, RefusesAndKeepsThePose) {
    const auto targets = some_targets(3);
    EXPECT_EQ(
        tendril_ik_batch_solve(c_batch, c_points(targets), chains - 1, nullptr, nullptr, &summary, &error),
        TENDRIL_INVALID_ARGUMENT);
    EXPECT_EQ(summary.invalid, 0u) << "a failed call writes nothing";
    tendril_ik_many_options options = tendril_ik_many_options_default();
    options.max_iterations = 0;
    EXPECT_EQ(tendril_ik_batch_solve(c_batch, c_points(targets), chains, &options, nullptr, &summary, &error),
              TENDRIL_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(error.message, "max_iterations"), nullptr) << error.message;
    EXPECT_EQ(tendril_ik_batch_solve(c_batch, nullptr, chains, nullptr, nullptr, &summary, &error),
              TENDRIL_NULL_ARGUMENT);
    EXPECT_EQ(tendril_ik_batch_solve({}, c_points(targets), chains, nullptr, nullptr, &summary, &error),
              TENDRIL_STALE_HANDLE);
    expect_same_joints();
    tendril_ik_batch made{};
    EXPECT_EQ(tendril_ik_batch_make(0, 3, 0, &made, &error), TENDRIL_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace tendril::test
