// States of C: bytes and structs that can be copied, saved and loaded.
#include "arm.hpp"

namespace tendril::test {
namespace {

/// An arm that has been dragged, with everything that a state remembers.
void drag(TwinArm& arm, int frames) {
    tendril_ik_options options = tendril_ik_options_default();
    options.pole = {0.0f, 1.0f, 0.0f};
    for (int i = 0; i < frames; ++i) {
        const float at = 0.02f * static_cast<float>(i);
        ASSERT_EQ(arm.solve_c({0.8f - at, 0.3f + at, 0.1f}, &options), TENDRIL_OK) << arm.error.message;
    }
}

TEST(CState, PutBackGivesTheSameBitsAgain) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    drag(arm, 5);
    const auto state = arm.c_state;
    const auto joints = arm.c_joints;
    drag(arm, 20);
    const auto ended = arm.c_joints;
    const auto ended_state = arm.c_state;
    arm.c_state = state, arm.c_joints = joints;
    drag(arm, 20);
    EXPECT_TRUE(same_bytes(arm.c_joints, ended));
    EXPECT_TRUE(same_bytes(arm.c_state, ended_state));
}

TEST(CState, SavedAndLoadedIsTheSame) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    tendril_error& error = arm.error;
    drag(arm, 5);
    std::vector<std::byte> saved(TENDRIL_SAVED_BYTES(arm.c_state.size())), loaded(arm.c_state.size());
    ASSERT_DONE(tendril_save(TENDRIL_STRUCT_IK_STATE, arm.c_state.data(), arm.c_state.size(), saved.data(),
                             saved.size(), &error));
    ASSERT_DONE(tendril_load(TENDRIL_STRUCT_IK_STATE, loaded.data(), loaded.size(), saved.data(),
                             saved.size(), &error));
    EXPECT_TRUE(same_bytes(loaded, arm.c_state));
    EXPECT_EQ(tendril_load(TENDRIL_STRUCT_SIGNAL_SPRING_STATE, loaded.data(), loaded.size(), saved.data(),
                           saved.size(), &error),
              TENDRIL_INVALID_ARGUMENT);
    EXPECT_EQ(tendril_save(TENDRIL_STRUCT_IK_OPTIONS, arm.c_state.data(), arm.c_state.size(), saved.data(),
                           saved.size(), &error),
              TENDRIL_INVALID_ARGUMENT)
        << "options have pointers";
}

TEST(CState, DamagedIsRefused) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    drag(arm, 5);
    std::vector<std::byte> saved(TENDRIL_SAVED_BYTES(arm.c_state.size())), loaded(arm.c_state.size());
    ASSERT_EQ(tendril_save(TENDRIL_STRUCT_IK_STATE, arm.c_state.data(), arm.c_state.size(), saved.data(),
                           saved.size(), nullptr),
              TENDRIL_OK);
    const auto loads = [&](const std::vector<std::byte>& bytes) {
        return tendril_load(TENDRIL_STRUCT_IK_STATE, loaded.data(), loaded.size(), bytes.data(), bytes.size(),
                            nullptr) == TENDRIL_OK;
    };
    for (std::size_t size = 0; size < saved.size(); ++size)
        EXPECT_FALSE(loads({saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(size)}))
            << size << " bytes";
    for (std::size_t bit = 0; bit < saved.size() * 8; ++bit) {
        auto flipped = saved;
        flipped[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
        EXPECT_FALSE(loads(flipped)) << "bit " << bit;
    }
}

TEST(CState, WithAWrongBitIsRefusedOrHarmless) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    drag(arm, 5);
    Random random(3);
    const auto state = arm.c_state;
    const auto joints = arm.c_joints;
    for (int round = 0; round < 10'000; ++round) {
        arm.c_state = state, arm.c_joints = joints;
        const std::size_t bit = random.below(state.size() * 8);
        arm.c_state[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
        const auto given = arm.c_state;
        if (arm.solve_c({0.4f, 0.6f, 0.0f}, nullptr) != TENDRIL_OK) {
            EXPECT_TRUE(same_bytes(arm.c_state, given)) << "a refused solve changes nothing";
            EXPECT_TRUE(same_bytes(arm.c_joints, joints));
        }
        for (const tendril_vec3f joint : arm.c_joints)
            ASSERT_TRUE(std::isfinite(joint.x + joint.y + joint.z)) << bit;
    }
}

TEST(CState, ThatIsNoStateGivesNoRotations) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    std::vector<tendril_quatf> turns(3);
    const float nan = NAN;
    std::memcpy(arm.c_state.data() + 8, &nan, sizeof nan);  // in the first rotation
    EXPECT_EQ(tendril_ik_state_rotations(arm.c_solver, arm.c_state.data(), arm.c_state.size(), turns.data(),
                                         turns.size(), nullptr, 0, &arm.error),
              TENDRIL_INVALID_ARGUMENT);
    EXPECT_EQ(turns[0].w, 0.0f);
}

TEST(CState, OfAnotherArmIsRefused) {
    TwinArm arm({0.5f, 0.4f, 0.3f}), longer({0.5f, 0.4f, 0.3f, 0.2f});
    EXPECT_EQ(
        tendril_ik_solve(arm.c_solver, TENDRIL_IK_METHOD_CCD, arm.c_joints.data(), 4, longer.c_state.data(),
                         longer.c_state.size(), {0, 1, 0}, nullptr, &arm.c_report, &arm.error),
        TENDRIL_INVALID_ARGUMENT)
        << arm.error.message;
    EXPECT_EQ(tendril_ik_solve(longer.c_solver, TENDRIL_IK_METHOD_CCD, longer.c_joints.data(), 5,
                               arm.c_state.data(), arm.c_state.size(), {0, 1, 0}, nullptr, &arm.c_report,
                               &arm.error),
              TENDRIL_SHORT_BUFFER);
    EXPECT_STREQ(arm.error.message, "ik_solve: state has 156 bytes; it takes 184");
}

}  // namespace
}  // namespace tendril::test
