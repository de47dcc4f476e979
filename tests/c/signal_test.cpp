// Filters, springs for points and rotations, and lists of them through the C interface: the library's own
// bits.
#include <tendril/signal/batch.hpp>
#include <tendril/signal/filter.hpp>

#include "arm.hpp"

namespace tendril::test {
namespace {

constexpr double dt = 1.0 / 60.0;

std::vector<double> some_inputs() {
    Random random(4);
    std::vector<double> inputs(200);
    for (double& input : inputs) input = static_cast<double>(random.around(2.0f));
    return inputs;
}

/// Steps a filter and filters a list, both as the library does. A refused list changes nothing.
template <class Filter, class CppFilter, class State, class Step, class List>
void expect_same(const Filter& c_filter, const CppFilter& filter, State fresh, Step step, List list) {
    signal::FilterState cpp_state;
    State state = fresh;
    std::vector<double> inputs = some_inputs(), stepped(inputs.size()), listed(inputs.size());
    tendril_error error;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_DONE(step(&c_filter, &state, inputs[i], dt, &stepped[i], &error));
        ASSERT_EQ(stepped[i], signal::step(signal::Filter(filter), cpp_state, inputs[i], dt)) << i;
    }
    ASSERT_DONE(list(&c_filter, &fresh, inputs.data(), listed.data(), inputs.size(), dt, &error));
    EXPECT_EQ(stepped, listed);
    EXPECT_EQ(std::memcmp(&state, &fresh, sizeof state), 0);
    inputs[150] = NAN;
    std::fill(listed.begin(), listed.end(), 7.0);
    EXPECT_EQ(list(&c_filter, &fresh, inputs.data(), listed.data(), inputs.size(), dt, &error),
              TENDRIL_INVALID_ARGUMENT);
    EXPECT_EQ(listed[0], 7.0);
    EXPECT_EQ(std::memcmp(&state, &fresh, sizeof state), 0);
}

TEST(CSignal, FiltersHaveTheLibrarysBits) {
#define SAME(kind, Cpp, state_kind, ...)                                                                 \
    {                                                                                                    \
        SCOPED_TRACE(#kind);                                                                             \
        tendril_signal_##kind c = tendril_signal_##kind##_default();                                     \
        signal::Cpp cpp;                                                                                 \
        const auto set = [](auto& f) { __VA_ARGS__; };                                                   \
        set(c), set(cpp);                                                                                \
        expect_same(c, cpp, tendril_signal_##state_kind##_state_default(), tendril_signal_##kind##_step, \
                    tendril_signal_##kind##_filter);                                                     \
    }
    SAME(interp_to, InterpTo, output, f.speed = 7.0)
    SAME(interp_to_exact, InterpToExact, output, f.speed = 7.0)
    SAME(exponential_decay, ExponentialDecay, output, f.halflife = 0.07)
    SAME(rate_limit, RateLimit, output, f.rise = 3.0, f.fall = 2.0)
    SAME(dead_zone, DeadZone, output, f.width = 0.3)
    SAME(hysteresis, Hysteresis, output, f.low = -0.2, f.high = 0.5)
    SAME(smooth_damp, SmoothDamp, motion, f.smooth_time = 0.2, f.max_speed = 4.0)
    SAME(spring_semi_implicit, SpringSemiImplicit, motion, f.strength = 3.0)
    SAME(one_euro, OneEuro, motion, f.beta = 0.4)
    SAME(inertialize, Inertialize, inertialize, f.threshold = 0.8)
#undef SAME
    tendril_signal_scale_bias_clamp c = tendril_signal_scale_bias_clamp_default();
    signal::ScaleBiasClamp cpp;
    c.map_range = c.interp = 1, cpp.map_range = cpp.interp = true;
    c.in_range = {-1.0, 2.0}, cpp.in_range = {-1.0, 2.0};
    c.out_range.y = cpp.out_range[1] = 5.0;
    expect_same(c, cpp, tendril_signal_output_state_default(), tendril_signal_scale_bias_clamp_step,
                tendril_signal_scale_bias_clamp_filter);
}

TEST(CSignal, AWindowIsTheLibrarysMovingAverage) {
    tendril_error error;
    tendril_signal_window window{};
    ASSERT_DONE(tendril_signal_window_make(0.1, &window, &error));
    const signal::MovingAverage filter{0.1};
    signal::MovingAverageState state;
    const auto inputs = some_inputs();
    std::vector<double> stepped(inputs.size()), listed(inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        ASSERT_DONE(tendril_signal_window_step(window, inputs[i], dt, &stepped[i], &error));
        ASSERT_EQ(stepped[i], signal::step(filter, state, inputs[i], dt));
    }
    ASSERT_DONE(tendril_signal_window_reset(window, &error));
    ASSERT_DONE(
        tendril_signal_window_filter(window, inputs.data(), listed.data(), inputs.size(), dt, &error));
    EXPECT_EQ(stepped, listed);
    EXPECT_EQ(tendril_signal_window_destroy(window), TENDRIL_OK);
    EXPECT_EQ(tendril_signal_window_make(-1.0, &window, &error), TENDRIL_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(error.message, "window"), nullptr) << error.message;
}

TEST(CSignal, SpringsOfPointsAndRotationsHaveTheLibrarysBits) {
    tendril_error error;
    tendril_signal_spring spring = tendril_signal_spring_default();
    spring.strength = 2.0, spring.critical_damping = 0.3, spring.target_velocity_amount = 0.5;
    const glm::dvec3 force(0.0, -9.81, 0.0);
    const signal::Spring<glm::dvec3> points{2.0, 0.3, force, 0.5};
    const signal::Spring<glm::dquat> turns{2.0, 0.3, force, 0.5};
    signal::SpringState<glm::dvec3> point_state;
    signal::SpringState<glm::dquat> turn_state;
    tendril_signal_spring_vec3_state c_point = tendril_signal_spring_vec3_state_default();
    tendril_signal_spring_quat_state c_turn = tendril_signal_spring_quat_state_default();
    Random random(9);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 target(random.point(2.0f));
        tendril_vec3 value{};
        ASSERT_DONE(tendril_signal_spring_vec3_step(&spring, {0.0, -9.81, 0.0}, &c_point,
                                                    {target.x, target.y, target.z}, dt, &value, &error));
        ASSERT_EQ(glm::dvec3(value.x, value.y, value.z), signal::step(points, point_state, target, dt));
        const glm::dquat turn = glm::normalize(glm::dquat(1.0, target.x, target.y, target.z));
        tendril_quat turned{};
        ASSERT_DONE(tendril_signal_spring_quat_step(&spring, {0.0, -9.81, 0.0}, &c_turn,
                                                    {turn.x, turn.y, turn.z, turn.w}, dt, &turned, &error));
        ASSERT_EQ(glm::dquat(turned.w, turned.x, turned.y, turned.z),
                  signal::step(turns, turn_state, turn, dt));
    }
    tendril_vec3 value{};
    EXPECT_EQ(
        tendril_signal_spring_vec3_step(&spring, {NAN, 0.0, 0.0}, &c_point, {0, 0, 0}, dt, &value, &error),
        TENDRIL_INVALID_ARGUMENT);
}

TEST(CSignal, ListsOfSpringsHaveTheLibrarysBits) {
    constexpr std::size_t n = 37;
    std::vector<float> strength(n), damping(n), target(n), value(n), velocity(n), previous(n);
    Random random(2);
    for (std::size_t i = 0; i < n; ++i)
        strength[i] = 1.0f + random.part(), damping[i] = random.part(), target[i] = random.around(2.0f);
    auto c_value = value, c_velocity = velocity, c_previous = previous;
    const signal::SpringArrays springs{.strength = strength,
                                       .critical_damping = damping,
                                       .target = target,
                                       .value = value,
                                       .velocity = velocity,
                                       .previous_target = previous};
    tendril_error error;
    ASSERT_TRUE(signal::start_springs(springs));
    ASSERT_DONE(tendril_signal_springs_start(strength.data(), damping.data(), nullptr, nullptr, target.data(),
                                             c_value.data(), c_velocity.data(), c_previous.data(), n,
                                             &error));
    for (int i = 0; i < 20; ++i) {
        for (float& each : target) each += random.around(0.1f);
        ASSERT_TRUE(signal::step_springs(springs, dt));
        ASSERT_DONE(tendril_signal_springs_step(strength.data(), damping.data(), nullptr, nullptr,
                                                target.data(), c_value.data(), c_velocity.data(),
                                                c_previous.data(), n, dt, &error));
    }
    EXPECT_EQ(value, c_value);
    EXPECT_EQ(velocity, c_velocity);
    EXPECT_EQ(
        tendril_signal_springs_step(nullptr, damping.data(), nullptr, nullptr, target.data(), c_value.data(),
                                    c_velocity.data(), c_previous.data(), n, dt, &error),
        TENDRIL_NULL_ARGUMENT);
}

}  // namespace
}  // namespace tendril::test
