
#include <complex>

#include "signal_support.hpp"

namespace tendril::test {
namespace {

using signal::Spring;
using signal::SpringState;

/// The textbook solution by complex exponentials, for a target at 0.
std::pair<double, double> solved(double strength, double damping, double place, double velocity, double t) {
    using Complex = std::complex<double>;
    const double w = turn * strength;
    const Complex root = std::sqrt(Complex(damping * damping - 1.0));
    const Complex first = -w * (damping + root), second = -w * (damping - root);
    const Complex a = (velocity - second * place) / (first - second), b = place - a;
    const Complex x = a * std::exp(first * t) + b * std::exp(second * t);
    const Complex v = a * first * std::exp(first * t) + b * second * std::exp(second * t);
    return {x.real(), v.real()};
}

SpringState<> moving(double place, double velocity) {
    return {.value = place, .velocity = velocity, .previous_target = 0.0, .started = true};
}

TEST(SignalSpring, MatchesTheClosedForm) {
    Random random(1);
    for (int i = 0; i < 20'000; ++i) {
        const double strength = std::exp2(around(random, 5.0)), t = std::exp2(around(random, 8.0)) / strength;
        const double damping = random.chance(3) ? between(random, 0.0, 0.99) : between(random, 1.01, 20.0);
        const double place = around(random, 2.0), velocity = around(random, 2.0) * turn * strength;
        SpringState<> state = moving(place, velocity);
        signal::step(Spring<>{.strength = strength, .critical_damping = damping}, state, 0.0, t);
        const auto [x, v] = solved(strength, damping, place, velocity, t);
        EXPECT_NEAR(state.value, x, 1e-9) << strength << " " << damping << " " << t;
        EXPECT_NEAR(state.velocity, v, 1e-9 * turn * strength) << strength << " " << damping << " " << t;
    }
}

TEST(SignalSpring, IsContinuousAcrossCriticalDamping) {
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const double strength = between(random, 0.1, 10.0), t = std::exp2(around(random, 8.0));
        const double place = around(random, 2.0), velocity = around(random, 20.0);
        const auto at = [&](double damping) {
            SpringState<> state = moving(place, velocity);
            signal::step(Spring<>{.strength = strength, .critical_damping = damping}, state, 0.0, t);
            return state;
        };
        const SpringState<> critical = at(1.0);
        for (const double near : {1e-4, 1e-7, 1e-10, 1e-13})
            for (const double damping : {1.0 - near, 1.0 + near}) {
                EXPECT_NEAR(at(damping).value, critical.value, 30.0 * near + 1e-12);
                EXPECT_NEAR(at(damping).velocity, critical.velocity, 1000.0 * near + 1e-10);
            }
        EXPECT_NEAR(at(1.0 - 1e-4).value, at(1.0 + 1e-4).value, 1e-3);
    }
}

TEST(SignalSpring, DoesNotDependOnTheDivisionOfTime) {
    for (const double damping : {0.0, 0.05, 0.4, 0.9999, 1.0, 1.0001, 1.3, 5.0, 100.0})
        for (const double strength : {0.0, 0.2, 1.0, 8.0}) {
            const Spring<> spring{.strength = strength, .critical_damping = damping};
            SpringState<> whole = moving(3.0, -20.0), cut = whole;
            signal::step(spring, whole, 0.0, 0.5);
            for (int i = 0; i < 500; ++i) signal::step(spring, cut, 0.0, 0.001);
            EXPECT_NEAR(whole.value, cut.value, 1e-4) << strength << " " << damping;
            EXPECT_NEAR(whole.velocity, cut.velocity, 1e-4) << strength << " " << damping;
            SpringState<float> coarse{3.0f, -20.0f, 0.0f, true};
            signal::step(Spring<float>{.strength = strength, .critical_damping = damping}, coarse, 0.0f, 0.5);
            EXPECT_NEAR(static_cast<double>(coarse.value), whole.value, 1e-5);
        }
}

TEST(SignalSpring, LagsBehindSteadyMotionByTheFormula) {
    for (const double damping : {0.3, 1.0, 2.0})
        for (const double amount : {0.0, 0.5, 1.0}) {
            const Spring<> spring{
                .strength = 2.0, .critical_damping = damping, .target_velocity_amount = amount};
            for (const double hz : {30.0, 240.0}) {
                SpringState<> state;
                const double speed = 3.0;
                double target = 0.0;
                for (int i = 0; i < static_cast<int>(20 * hz); ++i) {
                    target = speed * i / hz;
                    signal::step(spring, state, target, 1.0 / hz);
                }
                const double lag = (target - state.value) / speed;
                EXPECT_NEAR(lag, 2.0 * damping * (1.0 - amount) / (turn * 2.0) - 0.5 / hz, 5e-5)
                    << damping << " " << amount << " at " << hz;
            }
        }
}

TEST(SignalSpring, StartsOnItsTargetAtRest) {
    SpringState<> state;
    const double shift = 5.0 / (turn * turn);
    EXPECT_EQ(signal::step(Spring<>{.strength = 1.0, .force = 5.0}, state, 2.0, 0.1), 2.0 + shift);
    EXPECT_EQ(state.velocity, 0.0);
    EXPECT_TRUE(state.started);
    for (int i = 0; i < 10; ++i) signal::step(Spring<>{.strength = 1.0, .force = 5.0}, state, 2.0, 0.1);
    EXPECT_NEAR(state.value, 2.0 + shift, 1e-12) << "there it rests";
}

TEST(SignalSpring, WithoutStrengthItDriftsAndTheForceAccelerates) {
    SpringState<> state = moving(1.0, 2.0);
    signal::step(Spring<>{.strength = 0.0, .critical_damping = 3.0}, state, 7.0, 0.5);
    EXPECT_EQ(state.value, 2.0);
    EXPECT_EQ(state.velocity, 2.0) << "no damping";
    signal::step(Spring<>{.strength = 0.0, .force = 4.0, .target_velocity_amount = 1.0}, state, 9.0, 0.5);
    EXPECT_EQ(state.velocity, 4.0);
    EXPECT_EQ(state.value, 4.0);
}

TEST(SignalSpring, VectorsEqualThreeNumbers) {
    Random random(4);
    const glm::dvec3 force(1, -2, 3);
    for (const double damping : {0.2, 1.0, 1.7}) {
        const Spring<glm::dvec3> spring{1.5, damping, force, 0.4};
        const Spring<glm::vec3> coarse_spring{1.5, damping, glm::vec3(force), 0.4};
        SpringState<glm::dvec3> state;
        SpringState<glm::vec3> coarse;
        SpringState<> alone[3];
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 target(random.point(4.0f));
            const double dt = between(random, 0.001, 0.1);
            signal::step(spring, state, target, dt);
            signal::step(coarse_spring, coarse, glm::vec3(target), dt);
            for (int axis = 0; axis < 3; ++axis) {
                signal::step(Spring<>{1.5, damping, force[axis], 0.4}, alone[axis], target[axis], dt);
                EXPECT_EQ(state.value[axis], alone[axis].value);
                EXPECT_EQ(state.velocity[axis], alone[axis].velocity);
                EXPECT_NEAR(static_cast<double>(coarse.value[axis]), state.value[axis], 2e-5);
            }
        }
    }
}

glm::dquat turned(double angle) {
    return glm::angleAxis(angle, glm::dvec3(0, 0, 1));
}

TEST(SignalSpring, RotationsAboutOneAxisEqualNumbers) {
    const Spring<glm::dquat> spring{1.5, 0.4, {0, 0, 2.0}, 0.5};
    const Spring<glm::quat> coarse_spring{1.5, 0.4, {0, 0, 2.0f}, 0.5};
    const Spring<> flat{1.5, 0.4, 2.0, 0.5};
    SpringState<glm::dquat> state;
    SpringState<glm::quat> coarse;
    SpringState<> angle;
    for (int i = 0; i < 200; ++i) {
        const double target = 0.5 * std::sin(0.03 * i), sign = i % 3 == 0 ? -1.0 : 1.0;
        signal::step(spring, state, turned(target) * sign, 0.02);
        signal::step(coarse_spring, coarse, glm::quat(turned(target)), 0.02);
        signal::step(flat, angle, target, 0.02);
        const double dot = glm::dot(state.value, turned(angle.value));
        EXPECT_NEAR(std::abs(dot), 1.0, 1e-12) << i;
        EXPECT_NEAR(state.velocity.z, angle.velocity, 1e-9);
        EXPECT_NEAR(std::abs(glm::dot(glm::dquat(coarse.value), state.value)), 1.0, 1e-6);
    }
}

TEST(SignalSpring, RotationsTakeTheShortWay) {
    const Spring<glm::dquat> spring{.strength = 2.0, .critical_damping = 1.0};
    SpringState<glm::dquat> state;
    signal::step(spring, state, turned(3.0), 0.01);
    double way = 0.0;
    glm::dquat before = state.value;
    for (int i = 0; i < 500; ++i) {  // 3.0 to -3.0: 0.28 across half a turn, not 6 back across 0
        signal::step(spring, state, turned(-3.0), 0.01);
        way += 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(before, state.value))));
        before = state.value;
    }
    EXPECT_NEAR(way, turn - 6.0, 1e-4);
    EXPECT_NEAR(std::abs(glm::dot(state.value, turned(-3.0))), 1.0, 1e-9);
}

TEST(SignalSpring, ARefusedStepChangesNothing) {
    const Spring<> good{.strength = 2.0, .critical_damping = 0.5};
    SpringState<> state;
    signal::step(good, state, 1.0, 0.1);
    signal::step(good, state, 2.0, 0.1);
    const SpringState<> before = state;
    for (const Spring<>& bad : {Spring<>{.strength = -1.0}, Spring<>{.strength = not_a_number},
                                Spring<>{.critical_damping = 1001.0}, Spring<>{.force = infinity},
                                Spring<>{.target_velocity_amount = 1.5}})
        EXPECT_EQ(signal::step(bad, state, 5.0, 0.1), before.value);
    EXPECT_EQ(state, before);

    SpringState<glm::quat> rotation;
    EXPECT_EQ(signal::step(Spring<glm::quat>{}, rotation, glm::quat(0, 0, 0, 0), 0.1), glm::quat(0, 0, 0, 0));
    EXPECT_FALSE(rotation.started);
}

TEST(SignalSpring, AllParametrisationsGiveTheSameSpring) {
    const signal::SpringFeel feel = signal::feel_of(4.0, 0.5);
    EXPECT_DOUBLE_EQ(feel.duration, 0.25);
    EXPECT_DOUBLE_EQ(feel.bounce, 0.5);
    EXPECT_DOUBLE_EQ(feel.half_life, 2.0 * std::log(2.0) / (turn * 4.0 * 0.5));
    EXPECT_DOUBLE_EQ(signal::feel_of(1.0, 4.0).bounce, -0.75);
    EXPECT_EQ(signal::feel_of(1.0, 0.0).half_life, infinity);
    EXPECT_EQ(signal::feel_of(0.0, 1.0).duration, infinity);
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const double strength = std::exp2(around(random, 6.0)), damping = between(random, 0.01, 10.0);
        const signal::SpringFeel each = signal::feel_of(strength, damping);
        const auto by_bounce = signal::of_duration(each.duration, each.bounce);
        ASSERT_TRUE(by_bounce) << by_bounce.message();
        EXPECT_NEAR(by_bounce->strength, strength, 1e-12 * strength);
        EXPECT_NEAR(by_bounce->critical_damping, damping, 1e-11 * damping);
        const auto by_half_life = signal::of_half_life(each.half_life, damping);
        ASSERT_TRUE(by_half_life) << by_half_life.message();
        EXPECT_NEAR(by_half_life->strength, strength, 1e-12 * strength);
    }
    EXPECT_TRUE(says(signal::of_duration(0.3, 1.5).message(), "of_duration bounce -0.999 1 1.5"));
    for (const double bad : {0.0, -1.0, not_a_number, infinity, 1e-9}) {
        EXPECT_FALSE(signal::of_duration(bad, 0.0)) << bad;
        EXPECT_FALSE(signal::of_half_life(bad, 1.0)) << bad;
    }
    EXPECT_FALSE(signal::of_half_life(0.1, 0.0));
    EXPECT_FALSE(signal::of_duration(1.0, -1.0));
}

}  // namespace
}  // namespace tendril::test
