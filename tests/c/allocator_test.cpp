// Memory from the caller: all of it goes back, and a lack of it is an error.
#include <cstdlib>

#include "arm.hpp"

namespace tendril::test {
namespace {

struct Counted {
    long live = 0, allocations = 0, limit = -1;  // limit: how many more succeed; -1: all
};

void* allocate(void* user, std::size_t size, std::size_t alignment) {
    auto& counted = *static_cast<Counted*>(user);
    if (counted.limit == 0) return nullptr;
    if (counted.limit > 0) --counted.limit;
    ++counted.live, ++counted.allocations;
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
void release(void* user, void* memory, std::size_t, std::size_t) {
    --static_cast<Counted*>(user)->live;
    std::free(memory);
}

class CAllocator : public testing::Test {
  protected:
    void SetUp() override {
        const tendril_allocator allocator{allocate, release, &counted};
        tendril_error error;
        const tendril_code code = tendril_set_allocator(&allocator, &error);
        if (code == TENDRIL_INVALID_ARGUMENT) GTEST_SKIP() << error.message;
        ASSERT_EQ(code, TENDRIL_OK) << error.message;
    }
    void TearDown() override {
        EXPECT_EQ(counted.live, 0);
        static_cast<void>(tendril_set_allocator(nullptr, nullptr));
    }
    Counted counted;
};

TEST_F(CAllocator, GetsEverythingBack) {
    {
        TwinArm arm({0.5f, 0.4f, 0.3f});
        EXPECT_GT(counted.live, 0);
        EXPECT_EQ(tendril_set_allocator(nullptr, nullptr), TENDRIL_ALREADY_EXISTS);
        ASSERT_EQ(arm.solve_c({0.3f, 0.6f, 0.0f}, nullptr), TENDRIL_OK);
    }
    EXPECT_EQ(counted.live, 0);
}

TEST_F(CAllocator, SolvesAllocateNothingAfterTheFirst) {
    TwinArm arm({0.5f, 0.4f, 0.3f});
    tendril_ik_limit limits[3];
    for (tendril_ik_limit& limit : limits)
        ASSERT_EQ(tendril_ik_limit_of(TENDRIL_IK_JOINT_KIND_BALL_AND_SOCKET,
                                      (limit = tendril_ik_limit_default(), &limit), nullptr),
                  TENDRIL_OK);
    tendril_ik_options options = tendril_ik_options_default();
    options.limits = limits, options.limits_count = 3;
    for (int i = 0; i < 20; ++i) {
        ASSERT_EQ(arm.solve_c({0.3f, 0.6f - 0.02f * static_cast<float>(i), 0.0f}, &options), TENDRIL_OK)
            << arm.error.message;
        if (i == 0) counted.allocations = 0;
    }
    EXPECT_EQ(counted.allocations, 0);
}

/// Makes an arm and solves it with 0 to 80 allocations. Returns how often memory ran out, or -1 for another
/// error.
int count_lacks(Counted& counted) {
    const float lengths[] = {0.5f, 0.4f, 0.3f};
    int lacks = 0;
    for (long limit = 0; limit <= 80; ++limit) {
        tendril_ik_solver solver{};
        tendril_error error{};
        std::byte state[TENDRIL_IK_STATE_BYTES(3)];
        tendril_vec3f joints[4] = {{0, 0, 0}, {0.5f, 0, 0}, {0.9f, 0, 0}, {1.2f, 0, 0}};
        tendril_ik_report report = tendril_ik_report_default();
        counted.limit = limit;
        const bool made = tendril_ik_solver_make(lengths, 3, nullptr, 0, &solver, &error) == TENDRIL_OK;
        const bool done = made && tendril_ik_state_init(solver, state, sizeof state, &error) == TENDRIL_OK &&
                          tendril_ik_solve(solver, TENDRIL_IK_METHOD_FABRIK, joints, 4, state, sizeof state,
                                           {0.3f, 0.6f, 0}, nullptr, &report, &error) == TENDRIL_OK;
        counted.limit = -1;
        if (error.code != (done ? TENDRIL_OK : TENDRIL_NO_MEMORY)) return -1;
        if (tendril_ik_solver_destroy(solver) != (made ? TENDRIL_OK : TENDRIL_STALE_HANDLE)) return -1;
        lacks += done ? 0 : 1;
    }
    return lacks;
}

TEST_F(CAllocator, LackOfMemoryIsAnError) {
    // In a process of its own: the library is built without exceptions, and may leak where memory runs out.
    EXPECT_EXIT(
        {
            const int lacks = count_lacks(counted);
            std::_Exit(lacks > 3 && lacks < 70 ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace tendril::test
