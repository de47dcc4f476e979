// Solves and steps through the C interface: the library's own bits.
#include <tendril/ik/two_bone.hpp>
#include <tendril/signal/smoothing.hpp>
#include <tendril/signal/spring.hpp>

#include "arm.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

constexpr float pi = 3.14159265f;

std::vector<float> some_lengths(Random& random) {
    std::vector<float> lengths(2 + random.below(7));
    for (float& length : lengths) length = 0.1f + 0.4f * random.part();
    return lengths;
}

TEST(CSolve, GivesTheLibrarysBits) {
    Random random(1);
    for (int round = 0; round < rounds(200); ++round) {
        SCOPED_TRACE(round);
        TwinArm arm(some_lengths(random));
        const auto method = ik::all_methods[random.below(6)];
        ik::Options options;
        tendril_ik_options c_options = tendril_ik_options_default();
        std::vector<ik::Limit> limits;
        std::vector<tendril_ik_limit> c_limits;
        std::vector<ik::AngleLimit> angles;
        std::vector<tendril_ik_angle_limit> c_angles;
        tendril_ik_chain_plane c_plane = tendril_ik_chain_plane_default();
        if (random.chance(3)) {
            for (std::size_t i = 0; i < arm.lengths.size(); ++i) {
                limits.push_back(ik::Limit::of(static_cast<ik::JointKind>(random.below(7))));
                limits.back().axis = {0.0f, 0.3f, 1.0f};
                c_limits.push_back(to_c(limits.back()));
            }
            options.limits = limits;
            c_options.limits = c_limits.data(), c_options.limits_count = c_limits.size();
        } else if (random.chance(2)) {
            for (std::size_t i = 0; i < arm.lengths.size(); ++i) {
                angles.push_back({-pi * random.part(), pi * random.part(), ik::AngleFrom::Bone});
                tendril_ik_angle_limit c = tendril_ik_angle_limit_default();
                c.min = angles.back().min, c.max = angles.back().max;
                c_angles.push_back(c);
            }
            options.plane = ik::Plane{{0.1f, 0.2f, 1.0f}, ik::Side::Right, angles};
            c_plane.normal = {0.1f, 0.2f, 1.0f};
            c_plane.bend = TENDRIL_IK_SIDE_RIGHT;
            c_plane.limits = c_angles.data(), c_plane.limits_count = c_angles.size();
            c_options.plane = &c_plane;
        }
        if (random.chance(2)) {
            options.pole = random.point(2.0f);
            c_options.pole = to_c(*options.pole);
        }
        if (random.chance(4)) options.weight = c_options.weight = random.part();
        if (random.chance(4)) options.soft_zone = c_options.soft_zone = 0.2f;
        if (random.chance(4)) options.restarts = 2, c_options.restarts = 2;
        options.rotations = true, c_options.rotations = 1;
        glm::vec3 target = random.point(2.0f);
        for (int frame = 0; frame < 30 && !HasFailure(); ++frame) {
            arm.solve(target, options, c_options, method);
            target += random.point(0.1f);
        }
        ASSERT_FALSE(HasFailure());
    }
}

TEST(CSolve, TakesNoOptionsForTheDefaults) {
    TwinArm one({0.5f, 0.4f, 0.3f}), other({0.5f, 0.4f, 0.3f});
    const tendril_ik_options defaults = tendril_ik_options_default();
    EXPECT_EQ(one.solve_c({0.3f, 0.6f, 0.0f}, nullptr), TENDRIL_OK);
    EXPECT_EQ(other.solve_c({0.3f, 0.6f, 0.0f}, &defaults), TENDRIL_OK);
    EXPECT_TRUE(same_bytes(one.c_joints, other.c_joints));
    EXPECT_TRUE(same_bytes(one.c_state, other.c_state));
}

TEST(CSolve, RefusesInTheLibrarysWordsAndChangesNothing) {
    TwinArm arm({0.5f, 0.4f});
    const auto joints = arm.c_joints;
    const auto state = arm.c_state;
    EXPECT_EQ(arm.solve_c({NAN, 0.0f, 0.0f}, nullptr), TENDRIL_INVALID_ARGUMENT);
    EXPECT_STREQ(
        arm.error.message,
        arm.solver.solve(ik::Method::Fabrik, arm.joints, arm.state, {NAN, 0.0f, 0.0f}).accepted.message());
    tendril_ik_options options = tendril_ik_options_default();
    options.snap_back = 7.0f;
    EXPECT_EQ(arm.solve_c({0.5f, 0.5f, 0.0f}, &options), TENDRIL_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(arm.error.message, "snap_back"), nullptr) << arm.error.message;
    EXPECT_TRUE(same_bytes(joints, arm.c_joints));
    EXPECT_TRUE(same_bytes(state, arm.c_state));
}

TEST(CSolve, ExplainsTheLimitThatStopsTheTip) {
    TwinArm arm({1.0f, 1.0f});
    std::vector<ik::Limit> limits{ik::Limit::hinge({0, 0, 1}, -0.5f, 0.5f),
                                  ik::Limit::hinge({0, 0, 1}, 0.0f, 0.5f)};
    std::vector<tendril_ik_limit> c_limits{to_c(limits[0]), to_c(limits[1])};
    ik::Options options;
    options.limits = limits;
    tendril_ik_options c_options = tendril_ik_options_default();
    c_options.limits = c_limits.data(), c_options.limits_count = c_limits.size();
    const glm::vec3 target{0.2f, 1.4f, 0.0f};
    arm.solve(target, options, c_options);
    ASSERT_EQ(arm.c_report.status, TENDRIL_IK_STATUS_LIMITED);
    const std::optional<ik::ActiveLimit> expected =
        arm.solver.explain(arm.joints, arm.state, target, options);
    ASSERT_TRUE(expected);
    tendril_ik_active_limit limit = tendril_ik_active_limit_default();
    int32_t found = 0;
    tendril_error& error = arm.error;
    ASSERT_DONE(tendril_ik_explain(arm.c_solver, arm.c_joints.data(), arm.c_joints.size(), arm.c_state.data(),
                                   arm.c_state.size(), to_c(target), &c_options, &limit, &found, &error));
    EXPECT_EQ(found, 1);
    EXPECT_EQ(limit.joint, expected->joint);
    EXPECT_EQ(static_cast<int>(limit.bound), static_cast<int>(expected->bound));
    EXPECT_EQ(limit.limit, expected->limit);
    EXPECT_EQ(limit.needed, expected->needed);
}

TEST(CSolve, KnowsTheLimitsOfTheKinds) {
    for (int kind = 0; kind < 7; ++kind) {
        tendril_error error;
        tendril_ik_limit limit = tendril_ik_limit_default();
        EXPECT_DONE(tendril_ik_limit_of(static_cast<tendril_ik_joint_kind>(kind), &limit, &error));
        const tendril_ik_limit expected = to_c(ik::Limit::of(static_cast<ik::JointKind>(kind)));
        EXPECT_EQ(std::memcmp(&limit, &expected, sizeof limit), 0) << kind;
    }
}

TEST(CSolve, BendsTwoBones) {
    tendril_error error;
    tendril_ik_two_bone_limb limb = tendril_ik_two_bone_limb_default();
    limb.mid = {1.0f, 0.0f, 0.0f}, limb.tip = {2.0f, 0.0f, 0.0f};
    limb.upper = limb.lower = 1.0f;
    tendril_ik_two_bone_options options = tendril_ik_two_bone_options_default();
    options.pole = {0.0f, 1.0f, 0.5f};
    tendril_ik_two_bone_result result = tendril_ik_two_bone_result_default();
    ASSERT_DONE(tendril_ik_two_bone(&limb, {1.2f, 0.4f, 0.1f}, &options, &result, &error));
    const ik::TwoBoneResult expected =
        ik::two_bone({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 1.0f, 1.0f}, {1.2f, 0.4f, 0.1f},
                     {.pole = glm::vec3(0.0f, 1.0f, 0.5f)});
    EXPECT_EQ(std::memcmp(&result.mid, &expected.mid, sizeof result.mid), 0);
    EXPECT_EQ(std::memcmp(&result.tip, &expected.tip, sizeof result.tip), 0);
    limb.upper = -1.0f;
    EXPECT_EQ(tendril_ik_two_bone(&limb, {1, 0, 0}, nullptr, &result, &error), TENDRIL_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(error.message, "limb.upper"), nullptr) << error.message;
}

TEST(CSignal, StepsGiveTheLibrarysBits) {
    Random random(2);
    tendril_error error;
    tendril_signal_spring c_spring = tendril_signal_spring_default();
    tendril_signal_spring_state c_state = tendril_signal_spring_state_default();
    tendril_signal_one_euro c_euro = tendril_signal_one_euro_default();
    tendril_signal_motion_state c_motion = tendril_signal_motion_state_default();
    c_spring.strength = 3.0, c_spring.critical_damping = 0.4;
    c_euro.beta = 0.3;
    const signal::Spring<> spring{.strength = 3.0, .critical_damping = 0.4};
    const signal::OneEuro euro{.beta = 0.3};
    signal::SpringState<> state;
    signal::MotionState motion;
    for (int frame = 0; frame < 300; ++frame) {
        const double input = static_cast<double>(random.around(2.0f)), dt = 1.0 / 60.0;
        double value = 0.0, smooth = 0.0;
        ASSERT_DONE(tendril_signal_spring_step(&c_spring, &c_state, input, dt, &value, &error));
        ASSERT_DONE(tendril_signal_one_euro_step(&c_euro, &c_motion, input, dt, &smooth, &error));
        ASSERT_EQ(value, signal::step(spring, state, input, dt));
        ASSERT_EQ(smooth, signal::step(euro, motion, input, dt));
    }
    double value = 0.0;
    EXPECT_EQ(tendril_signal_spring_step(&c_spring, &c_state, NAN, 0.1, &value, &error),
              TENDRIL_INVALID_ARGUMENT);
    EXPECT_EQ(tendril_signal_spring_step(&c_spring, &c_state, 1.0, -0.1, &value, &error),
              TENDRIL_INVALID_ARGUMENT);
    c_spring.strength = -1.0;
    EXPECT_EQ(tendril_signal_spring_step(&c_spring, &c_state, 1.0, 0.1, &value, &error),
              TENDRIL_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(error.message, "spring.strength"), nullptr) << error.message;
}

}  // namespace
}  // namespace tendril::test
