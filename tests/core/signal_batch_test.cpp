// Batches of springs and values compared with single ones.
#include "tendril/signal/batch.hpp"

#include <cstdio>
#include <cstring>

#include "signal_support.hpp"
#include "tendril/ik/many.hpp"

namespace tendril::test {
namespace {

using signal::Spring;
using signal::SpringArrays;
using signal::SpringState;
using Floats = std::vector<float>;

float single(double value) {
    return static_cast<float>(value);
}

struct Springs {
    Floats strength, damping, force, amount, target, value, velocity, previous;

    void add(double hz, double z, double pushed, double known, double to) {
        strength.push_back(single(hz)), damping.push_back(single(z)), force.push_back(single(pushed));
        amount.push_back(single(known)), target.push_back(single(to));
        value.push_back(0.0f), velocity.push_back(0.0f), previous.push_back(0.0f);
    }
    SpringArrays arrays() {
        return {.strength = strength,
                .critical_damping = damping,
                .force = force,
                .target_velocity_amount = amount,
                .target = target,
                .value = value,
                .velocity = velocity,
                .previous_target = previous};
    }
    std::size_t size() const { return value.size(); }
    Spring<> spring(std::size_t i) const {
        return {static_cast<double>(strength[i]), static_cast<double>(damping[i]),
                static_cast<double>(force[i]), static_cast<double>(amount[i])};
    }
    SpringState<> state(std::size_t i) const {
        return {static_cast<double>(value[i]), static_cast<double>(velocity[i]),
                static_cast<double>(previous[i]), true};
    }
};

bool same_bits(const Floats& a, const Floats& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

/// Springs with every kind of damping, and strengths from 0 to stiff.
Springs some_springs(std::size_t count, Random& random) {
    Springs springs;
    for (std::size_t i = 0; i < count; ++i) {
        const double odd[] = {0.0, 1.0, 1.0 - 1e-6, 1.0 + 1e-6, 0.9999, 1.0001};
        const double usual = random.chance(2) ? between(random, 0.0, 1.0) : std::exp2(around(random, 5.0));
        const double damping = random.chance(3) ? odd[random.below(6)] : usual;
        const double strength = random.chance(20) ? 0.0 : std::exp2(around(random, 4.0));
        const double force = random.chance(2) ? 0.0 : around(random, 20.0), to = around(random, 2.0);
        springs.add(strength, damping, force, random.chance(2) ? 0.0 : between(random, 0.0, 1.0), to);
    }
    return springs;
}

/// Scale of a velocity relative to a distance.
double rate_of(const Spring<>& spring, double dt) {
    return std::max(turn * spring.strength, 1.0 / dt);
}
/// Magnitude of the terms of a step, as in batch.hpp.
double size_of(const Spring<>& spring, const SpringState<>& state, double target, double dt) {
    const double w = turn * spring.strength, velocity = std::abs(target - state.previous_target) / dt;
    const double shift = w > 0.0
                             ? std::abs(spring.force) / (w * w) + 2.0 * spring.target_velocity_amount *
                                                                      spring.critical_damping * velocity / w
                             : std::abs(spring.force) * dt * dt;
    return std::abs(state.value) + std::abs(target) + shift + std::abs(state.velocity) / rate_of(spring, dt);
}

TEST(SignalBatch, SpringsMatchSingleOnes) {
    Random random(1);
    double worst = 0.0, worst_swing = 0.0;
    for (int round = 0; round < 200; ++round) {
        Springs springs = some_springs(301, random);
        ASSERT_TRUE(signal::start_springs(springs.arrays()));
        for (int turns = 0; turns < 10; ++turns) {
            for (float& to : springs.target) to = single(around(random, 2.0));
            const double dt = static_cast<double>(single(std::exp2(between(random, -9.0, 4.0))));
            const Springs before = springs;
            ASSERT_TRUE(signal::step_springs(springs.arrays(), dt));
            for (std::size_t i = 0; i < springs.size(); ++i) {
                const Spring<> spring = springs.spring(i);
                SpringState<> state = before.state(i);
                const double target = static_cast<double>(springs.target[i]);
                const double size = size_of(spring, state, target, dt), w = rate_of(spring, dt);
                signal::step(spring, state, target, dt);
                const double swings = spring.critical_damping < 1.0 ? spring.strength * dt : 0.0;
                const double off = std::abs(static_cast<double>(springs.value[i]) - state.value) / size;
                const double speed_off =
                    std::abs(static_cast<double>(springs.velocity[i]) - state.velocity) / w / size;
                const double allowed = 1e-6 + 1e-6 * swings;
                EXPECT_LE(off, allowed)
                    << spring.strength << " Hz, " << spring.critical_damping << ", " << dt;
                EXPECT_LE(speed_off, allowed)
                    << spring.strength << " Hz, " << spring.critical_damping << ", " << dt;
                worst = std::max({worst, off / (1.0 + swings), speed_off / (1.0 + swings)});
                worst_swing = std::max(worst_swing, swings);
            }
        }
    }
    std::printf("worst deviation %.2g of the size for each swing, up to %.0f swings\n", worst, worst_swing);
}

TEST(SignalBatch, AllVectorUnitsGiveTheSameBits) {
    Random random(2);
    for (const std::size_t count : {0u, 1u, 3u, 15u, 16u, 17u, 64u, 1001u}) {
        const Springs start = some_springs(count, random);
        std::vector<Springs> results;
        std::vector<Floats> interps, exacts;
        for (const std::string_view unit : ik::vector_units()) {
            Springs springs = start;
            ASSERT_TRUE(signal::start_springs(springs.arrays()));
            Floats interp = start.strength, exact = start.strength;
            for (int turns = 0; turns < 30; ++turns) {
                for (std::size_t i = 0; i < count; ++i)
                    springs.target[i] = single(std::sin(0.3 * turns + static_cast<double>(i)));
                const double dt = std::exp2(turns % 12 - 9.0);
                ASSERT_TRUE(signal::step_springs(springs.arrays(), dt, {unit}));
                ASSERT_TRUE(signal::interp_to(interp, springs.target, start.strength, dt, {unit}));
                ASSERT_TRUE(signal::interp_to_exact(exact, springs.target, start.strength, dt, {unit}));
            }
            results.push_back(springs), interps.push_back(interp), exacts.push_back(exact);
            EXPECT_TRUE(same_bits(springs.value, results[0].value)) << unit << ", " << count;
            EXPECT_TRUE(same_bits(springs.velocity, results[0].velocity)) << unit << ", " << count;
            EXPECT_TRUE(same_bits(springs.previous, results[0].previous)) << unit << ", " << count;
            EXPECT_TRUE(same_bits(interp, interps[0])) << unit << ", " << count;
            EXPECT_TRUE(same_bits(exact, exacts[0])) << unit << ", " << count;
        }
    }
}

TEST(SignalBatch, PartsMayBeSteppedSeparately) {
    Random random(3);
    Springs whole = some_springs(97, random), parts = whole;
    for (int turns = 0; turns < 5; ++turns) {
        ASSERT_TRUE(signal::step_springs(whole.arrays(), 0.02));
        const SpringArrays all = parts.arrays();
        for (std::size_t i = 0; i < 97;) {
            const std::size_t count = std::min<std::size_t>(1 + random.below(40), 97 - i);
            const SpringArrays part{
                all.strength.subspan(i, count), all.critical_damping.subspan(i, count),
                all.force.subspan(i, count),    all.target_velocity_amount.subspan(i, count),
                all.target.subspan(i, count),   all.value.subspan(i, count),
                all.velocity.subspan(i, count), all.previous_target.subspan(i, count)};
            ASSERT_TRUE(signal::step_springs(part, 0.02));
            i += count;
        }
        EXPECT_TRUE(same_bits(whole.value, parts.value));
        EXPECT_TRUE(same_bits(whole.velocity, parts.velocity));
    }
}

TEST(SignalBatch, InterpToMatchesSingleValues) {
    Random random(4);
    Floats current, target, speed;
    for (int i = 0; i < 4001; ++i) {
        const double at = around(random, 3.0),
                     to = random.chance(10) ? at + around(random, 1e-4) : around(random, 3.0);
        current.push_back(single(at)), target.push_back(single(to));
        speed.push_back(random.chance(10) ? single(around(random, 1.0))
                                          : single(std::exp2(around(random, 8.0))));
    }
    for (const double dt : {1e-4, 0.01, 0.1, 2.0, 1e6}) {
        Floats steps = current, exact = current;
        ASSERT_TRUE(signal::interp_to(steps, target, speed, dt));
        ASSERT_TRUE(signal::interp_to_exact(exact, target, speed, dt));
        for (std::size_t i = 0; i < current.size(); ++i) {
            const double v = static_cast<double>(speed[i]);
            EXPECT_NEAR(steps[i], signal::interp_to(current[i], target[i], dt, v), 1e-6f);
            EXPECT_NEAR(exact[i], signal::interp_to_exact(current[i], target[i], dt, v), 1e-6f);
        }
    }
}

TEST(SignalBatch, ValuesOutOfRangeAreLeftAlone) {
    const float bad[] = {single(not_a_number), single(infinity), -1.0f, 1.1e9f};
    for (const float each : bad) {
        Random random(5);
        Springs springs = some_springs(24, random);
        springs.strength[1] = springs.damping[3] = springs.target[5] = each;
        springs.amount[7] = each == 1.1e9f ? 1.01f : each;
        springs.force[9] = springs.previous[11] = each == -1.0f ? -1.1e9f : each;
        if (each == -1.0f) springs.target[5] = -1.1e9f;
        springs.value[13] = springs.velocity[15] = std::isfinite(each) ? 1.1e30f : each;
        const Springs before = springs;
        ASSERT_TRUE(signal::step_springs(springs.arrays(), 0.1));
        for (std::size_t i = 0; i < 16; i += 1) {
            const bool same = std::memcmp(&springs.value[i], &before.value[i], 4) == 0 &&
                              std::memcmp(&springs.velocity[i], &before.velocity[i], 4) == 0 &&
                              std::memcmp(&springs.previous[i], &before.previous[i], 4) == 0;
            EXPECT_EQ(same, i % 2 == 1) << i << " " << each;
        }
        ASSERT_TRUE(signal::start_springs(springs.arrays()));
        for (const float value : springs.value) EXPECT_TRUE(std::isfinite(value));

        Floats current{1.0f, 2.0f}, target{each == -1.0f ? -1.1e9f : each, 5.0f}, speed{1.0f, 0.0f};
        ASSERT_TRUE(signal::interp_to(current, target, speed, 0.1));
        EXPECT_EQ(current, (Floats{1.0f, 5.0f}));
        ASSERT_TRUE(signal::interp_to_exact(current, target, speed, 0.1));
        EXPECT_EQ(current, (Floats{1.0f, 5.0f}));
    }
    Random random(6);
    Springs springs = some_springs(20, random);
    const Springs before = springs;
    for (const double dt : {0.0, -1.0, not_a_number, infinity}) {
        ASSERT_TRUE(signal::step_springs(springs.arrays(), dt));
        EXPECT_TRUE(same_bits(springs.value, before.value) && same_bits(springs.previous, before.previous));
    }
}

TEST(SignalBatch, ExtremeInputsStayFinite) {
    Random random(7);
    const double dts[] = {5e-324, 1e-9, 1e-3, 1.0, 3600.0, 1e9, 1e300};
    for (int round = 0; round < 300; ++round) {
        Springs springs;
        for (int i = 0; i < 48; ++i) {
            const double strengths[] = {0.0, 9e-6, 1e-5, 1.0, 1e4},
                         dampings[] = {0.0, 1.0, 1.0000001, 7.0, 1e3};
            const double values[] = {0.0, 1e9, -1e9, 1.0, -1e-30};
            const double hz = strengths[random.below(5)], z = dampings[random.below(5)];
            const double force = values[random.below(5)], to = values[random.below(5)];
            springs.add(hz, z, force, random.chance(2) ? 1.0 : 0.0, to);
        }
        ASSERT_TRUE(signal::start_springs(springs.arrays()));
        for (int turns = 0; turns < 20; ++turns) {
            for (float& to : springs.target) to = single(random.chance(2) ? around(random, 1e9) : 0.0);
            ASSERT_TRUE(signal::step_springs(springs.arrays(), dts[random.below(7)]));
            for (std::size_t i = 0; i < springs.size(); ++i) {
                ASSERT_TRUE(std::abs(springs.value[i]) <= 1.0001e30f) << springs.strength[i];
                ASSERT_TRUE(std::abs(springs.velocity[i]) <= 1.0001e30f) << springs.strength[i];
            }
        }
    }
}

TEST(SignalBatch, WithoutDampingHoursOfSteppingGainNoEnergy) {
    Springs springs;
    for (int i = 0; i < 64; ++i) springs.add(std::exp2(0.2 * i - 3.0), 0.0, 0.0, 0.0, 0.0);
    for (float& value : springs.value) value = 1.0f;
    for (const double dt : {10.0, 3600.0, 86400.0, 1e9}) {
        ASSERT_TRUE(signal::step_springs(springs.arrays(), dt));
        for (std::size_t i = 0; i < springs.size(); ++i) {
            const double value = static_cast<double>(springs.value[i]);
            const double velocity =
                static_cast<double>(springs.velocity[i]) / (turn * springs.spring(i).strength);
            EXPECT_NEAR(value * value + velocity * velocity, 1.0, 1e-5)
                << springs.strength[i] << " Hz, " << dt;
        }
    }
}

TEST(SignalBatch, RefusesListsOfDifferentLengths) {
    Random random(8);
    Springs springs = some_springs(4, random);
    springs.damping.pop_back();
    EXPECT_TRUE(
        says(signal::step_springs(springs.arrays(), 0.1).message(), "step_springs critical_damping 4 3"));
    EXPECT_FALSE(signal::start_springs(springs.arrays()));
    springs.damping.push_back(1.0f);
    for (Floats* const list :
         std::initializer_list<Floats*>{&springs.strength, &springs.force, &springs.amount, &springs.target,
                                        &springs.value, &springs.velocity, &springs.previous}) {
        list->push_back(0.0f);
        EXPECT_EQ(signal::step_springs(springs.arrays(), 0.1).code(), ErrorCode::InvalidArgument);
        list->pop_back();
    }
    springs.force.clear(), springs.amount.clear();
    EXPECT_TRUE(signal::step_springs(springs.arrays(), 0.1)) << "these may be left out";
    EXPECT_EQ(signal::step_springs(springs.arrays(), 0.1, {"abacus"}).code(), ErrorCode::InvalidArgument);
    Floats two{1.0f, 2.0f}, three{1.0f, 2.0f, 3.0f};
    EXPECT_EQ(signal::interp_to(two, three, two, 0.1).code(), ErrorCode::InvalidArgument);
    EXPECT_EQ(signal::interp_to_exact(two, two, three, 0.1).code(), ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace tendril::test
