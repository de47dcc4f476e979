// Calls that no program should make: an error each, never a crash. Worth most under the sanitizers.
#include <array>
#include <atomic>
#include <limits>
#include <thread>

#include "arm.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

constexpr std::size_t huge = std::size_t{1} << 63;

/// Makes random calls with handles that others may have destroyed, and arguments of every bad kind.
class Caller {
  public:
    Caller(std::uint64_t seed, std::array<std::atomic<std::uint64_t>, 16>& shared)
        : random_(seed), shared_(shared) {}

    void call() {
        ++calls;
        error_.code = TENDRIL_OK;
        std::strcpy(error_.message, "untouched");
        const tendril_code code = some_call();
        if (code == TENDRIL_OK) {
            ++accepted;
            return;
        }
        if (!with_error_) return;
        ASSERT_EQ(error_.code, code);
        ASSERT_STRNE(error_.message, "untouched") << tendril_code_name(code);
        ASSERT_LT(std::strlen(error_.message), sizeof error_.message);
    }
    int calls = 0, accepted = 0;

  private:
    // A C program may pass any number for an enumeration.
    __attribute__((no_sanitize("enum"))) tendril_code some_call() {
        tendril_error* const error = error_or_null();
        switch (random_.below(14)) {
            case 0: {
                tendril_ik_solver made{};
                const std::size_t bones = some_count(3);
                const tendril_code code = tendril_ik_solver_make(
                    or_null(lengths_), bones, random_.chance(4) ? joints_ : nullptr,
                    random_.chance(2) ? 0 : bones, random_.chance(20) ? nullptr : &made, error);
                if (code == TENDRIL_OK) keep(made);
                return code;
            }
            case 1:
                with_error_ = false;
                return tendril_ik_solver_destroy(some_handle());
            case 2:
                return tendril_ik_state_init(some_handle(), some_state(), some_size(), error);
            case 3:
            case 4:
            case 5: {
                fill_numbers();
                tendril_ik_options options = some_options();
                tendril_ik_report report = tendril_ik_report_default();
                spoil(report.size);
                const int method = static_cast<int>(random_.below(9)) - 1;
                tendril_ik_method chosen;
                std::memcpy(&chosen, &method, sizeof chosen);
                return tendril_ik_solve(some_handle(), chosen, or_null(joints_), some_count(4), some_state(),
                                        some_size(), some_point(), random_.chance(3) ? nullptr : &options,
                                        random_.chance(20) ? nullptr : &report, error);
            }
            case 6: {
                fill_numbers();
                tendril_ik_options options = some_options();
                tendril_ik_active_limit limit = tendril_ik_active_limit_default();
                spoil(limit.size);
                int32_t found = 0;
                return tendril_ik_explain(some_handle(), or_null(joints_), some_count(4), some_state(),
                                          some_size(), some_point(), &options, &limit,
                                          random_.chance(20) ? nullptr : &found, error);
            }
            case 7:
                return tendril_ik_state_rotations(some_handle(), some_state(), some_size(), or_null(turns_),
                                                  some_count(3), or_null(turns_), some_count(3), error);
            case 8: {
                tendril_ik_two_bone_limb limb = tendril_ik_two_bone_limb_default();
                limb.mid = some_point(), limb.tip = some_point(), limb.upper = some_number();
                spoil(limb.size);
                tendril_ik_two_bone_result result = tendril_ik_two_bone_result_default();
                spoil(result.size);
                return tendril_ik_two_bone(random_.chance(20) ? nullptr : &limb, some_point(), nullptr,
                                           &result, error);
            }
            case 9: {
                tendril_signal_spring spring = tendril_signal_spring_default();
                spring.strength = static_cast<double>(some_number());
                tendril_signal_spring_state state = tendril_signal_spring_state_default();
                state.value = static_cast<double>(some_number());
                spoil(state.size);
                double value;
                return tendril_signal_spring_step(&spring, random_.chance(20) ? nullptr : &state,
                                                  static_cast<double>(some_number()),
                                                  static_cast<double>(some_number()), &value, error);
            }
            case 10: {
                tendril_ik_options options = some_options();
                double values[4] = {static_cast<double>(some_number()), 0, 0, 1};
                const char* const names[] = {"damping",         "pole",  "",        "limits",
                                             "tip_orientation", nullptr, "restarts"};
                return tendril_set(some_kind(), random_.chance(9) ? nullptr : &options,
                                   names[random_.below(7)], random_.chance(9) ? nullptr : values, error);
            }
            case 11: {
                tendril_ik_options options = some_options();
                double values[4];
                return random_.chance(2) ? tendril_check(some_kind(), &options, error)
                                         : tendril_get(some_kind(), &options, "weight", values, error);
            }
            case 12: {
                tendril_field field;
                return tendril_field_at(some_kind(), random_.chance(9) ? huge : random_.below(20), &field,
                                        error);
            }
            default:
                return random_.chance(2)
                           ? tendril_save(some_kind(), some_state(),
                                          random_.chance(5) ? huge : random_.below(sizeof bytes_), saved_,
                                          random_.below(sizeof saved_), error)
                           : tendril_load(some_kind(), some_state(), some_size(), saved_,
                                          random_.below(sizeof saved_), error);
        }
    }

    template <class Value>
    Value* or_null(Value* values) {
        return random_.chance(15) ? nullptr : values;
    }
    tendril_error* error_or_null() {
        with_error_ = !random_.chance(10);
        return with_error_ ? &error_ : nullptr;
    }
    /// The right one, a smaller one, or one that no memory holds.
    std::size_t some_count(std::size_t right) {
        return random_.chance(12) ? huge : random_.chance(8) ? random_.below(right + 1) : right;
    }
    tendril_ik_solver some_handle() {
        tendril_ik_solver handle{};
        const std::uint64_t word =
            random_.chance(10) ? random_.bits() : shared_[random_.below(shared_.size())].load();
        if (!random_.chance(30)) std::memcpy(&handle, &word, sizeof handle);
        return handle;
    }
    void keep(tendril_ik_solver handle) {
        std::uint64_t word;
        std::memcpy(&word, &handle, sizeof word);
        word = shared_[random_.below(shared_.size())].exchange(word);
        std::memcpy(&handle, &word, sizeof handle);
        while (tendril_ik_solver_destroy(handle) == TENDRIL_BUSY) std::this_thread::yield();
    }
    /// At any address.
    void* some_state() { return random_.chance(30) ? nullptr : bytes_ + random_.below(8); }
    std::size_t some_size() {
        return random_.chance(6) ? random_.below(sizeof bytes_ - 8) : sizeof bytes_ - 8;
    }
    float some_number() {
        const float all[] = {NAN, INFINITY, -INFINITY, -1.0f, 0.0f, 1e-40f, 1e9f, 3e38f};
        return random_.chance(9) ? all[random_.below(8)] : 0.5f + random_.part();
    }
    tendril_vec3f some_point() { return {some_number(), some_number(), some_number()}; }
    void fill_numbers() {
        for (tendril_vec3f& joint : joints_) joint = some_point();
    }
    void spoil(std::uint32_t& size) {
        if (random_.chance(25))
            size = static_cast<std::uint32_t>(random_.chance(2) ? random_.below(size + 8) : random_.bits());
    }
    __attribute__((no_sanitize("enum"))) tendril_struct some_kind() {
        const int number = static_cast<int>(random_.below(18)) - 1;
        tendril_struct kind;
        std::memcpy(&kind, &number, sizeof kind);
        return random_.chance(2) ? TENDRIL_STRUCT_IK_OPTIONS : kind;
    }
    tendril_ik_options some_options() {
        tendril_ik_options options = tendril_ik_options_default();
        options.max_iterations = 20;
        if (random_.chance(4)) options.pole = some_point();
        if (random_.chance(8)) options.weight = some_number();
        if (random_.chance(3)) {
            for (tendril_ik_limit& limit : limits_) {
                limit = tendril_ik_limit_default();
                const int kind = static_cast<int>(random_.below(random_.chance(20) ? 300 : 7));
                std::memcpy(&limit.kind, &kind, sizeof kind);
                limit.axis = some_point();
                limit.up = limit.max = some_number();
                if (random_.chance(40)) spoil(limit.size);
            }
            options.limits = or_null(limits_);
            options.limits_count = some_count(3);
        }
        if (random_.chance(8)) {
            plane_ = tendril_ik_chain_plane_default();
            plane_.normal = some_point();
            options.plane = &plane_;
        }
        if (random_.chance(5)) spoil(options.size);
        return options;
    }

    Random random_;
    std::array<std::atomic<std::uint64_t>, 16>& shared_;
    tendril_error error_{};
    bool with_error_ = true;
    float lengths_[3] = {0.5f, 0.4f, 0.3f};
    tendril_vec3f joints_[4] = {};
    tendril_quatf turns_[3] = {};
    tendril_ik_limit limits_[3] = {};
    tendril_ik_chain_plane plane_{};
    std::byte bytes_[TENDRIL_IK_STATE_BYTES(3) + 64] = {};
    std::byte saved_[TENDRIL_SAVED_BYTES(sizeof bytes_)] = {};
};

TEST(CHostile, RandomCallsFromFourThreadsAreErrors) {
    const std::size_t before = tendril_live_objects();
    std::array<std::atomic<std::uint64_t>, 16> handles{};
    std::atomic<int> calls{0}, accepted{0};
    std::vector<std::thread> threads;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        threads.emplace_back([&, seed] {
            Caller caller(seed, handles);
            for (int i = 0; i < 25'000 && !testing::Test::HasFatalFailure(); ++i) caller.call();
            calls += caller.calls, accepted += caller.accepted;
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::atomic<std::uint64_t>& each : handles) {
        const std::uint64_t word = each.load();
        tendril_ik_solver handle;
        std::memcpy(&handle, &word, sizeof handle);
        tendril_ik_solver_destroy(handle);
    }
    EXPECT_EQ(tendril_live_objects(), before);
    EXPECT_EQ(calls, 100'000);
    EXPECT_GT(accepted, 10'000) << "mostly refused at the door: tests too little";
}

TEST(CHostile, AHandleWithAnotherBitIsStale) {
    TwinArm arm({0.5f, 0.4f});
    for (int bit = 0; bit < 32; ++bit) {
        tendril_ik_solver forged = arm.c_solver;
        forged.generation ^= 1u << bit;
        EXPECT_EQ(tendril_ik_solver_bones(forged), 0u) << bit;
    }
}

TEST(CHostile, DestroyedHandlesStayStale) {
    TwinArm arm({1.0f, 1.0f});
    tendril_ik_solver first{}, second{};
    ASSERT_EQ(tendril_ik_solver_make(arm.lengths.data(), 2, nullptr, 0, &first, nullptr), TENDRIL_OK);
    EXPECT_EQ(tendril_ik_solver_destroy(first), TENDRIL_OK);
    EXPECT_EQ(tendril_ik_solver_destroy(first), TENDRIL_STALE_HANDLE);
    ASSERT_EQ(tendril_ik_solver_make(arm.lengths.data(), 2, nullptr, 0, &second, nullptr), TENDRIL_OK);
    EXPECT_EQ(second.index, first.index) << "the slot is used again";
    EXPECT_EQ(tendril_ik_solver_destroy(first), TENDRIL_STALE_HANDLE);
    EXPECT_EQ(tendril_ik_solver_bones(first), 0u);
    EXPECT_EQ(tendril_ik_solver_bones(second), 2u);
    EXPECT_EQ(tendril_ik_solver_reach(second), 2.0f);
    EXPECT_EQ(tendril_ik_solver_destroy(second), TENDRIL_OK);
    EXPECT_EQ(tendril_ik_solver_destroy(tendril_ik_solver{}), TENDRIL_STALE_HANDLE);
}

}  // namespace
}  // namespace tendril::test
