#include "tendril/signal/interpolate.hpp"

#include <glm/gtc/quaternion.hpp>

#include "signal_support.hpp"

namespace tendril::test {
namespace {

using signal::interp_to;
using signal::interp_to_exact;

glm::dquat about(const glm::dvec3& axis, double angle) {
    return glm::angleAxis(angle, axis);
}
/// Radians, the shorter way.
double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat between = a * glm::conjugate(b);
    return 2.0 * std::atan2(glm::length(glm::dvec3(between.x, between.y, between.z)), std::abs(between.w));
}

TEST(SignalInterpolate, WhatIsLeftDependsOnTheFrameRateAsEnginesHaveIt) {
    const signal::Filter filter = filter_of("interp_to", {{"speed", 10.0}});
    const std::pair<double, double> left_at[] = {{15, 0.0005}, {30, 0.0023}, {60, 0.0042}, {144, 0.0056}};
    for (const auto& [hz, left] : left_at)
        EXPECT_NEAR(1.0 - reached(filter, hz, 0.5), left, 5e-5) << hz << " Hz";
}

TEST(SignalInterpolate, ExactlyItDoesNot) {
    const signal::Filter filter = filter_of("interp_to_exact", {{"speed", 10.0}});
    for (const double hz : {30.0, 60.0, 144.0}) {
        EXPECT_NEAR(1.0 - reached(filter, hz, 0.5), std::exp(-5.0), 1e-6) << hz << " Hz";
    }
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const double from = around(random, 100.0), to = around(random, 100.0);
        const double dt = between(random, 1e-4, 1.0), speed = between(random, 0.0, 20.0);
        const double whole = interp_to_exact(from, to, dt, speed);
        const double halves = interp_to_exact(interp_to_exact(from, to, dt / 2, speed), to, dt / 2, speed);
        EXPECT_NEAR(whole, halves, 1e-9 * (1.0 + std::abs(to - from)));
        const double near = to + 1e-5;  // where interp_to already snaps
        EXPECT_NEAR(interp_to_exact(interp_to_exact(near, to, dt / 2, speed), to, dt / 2, speed) - to,
                    1e-5 * std::exp(-speed * dt), 1e-12);
    }
}

TEST(SignalInterpolate, NeverOvershoots) {
    Random random(2);
    for (int i = 0; i < 10'000; ++i) {
        const double from = around(random, 1e3), to = around(random, 1e3);
        const double dt = std::exp2(around(random, 20.0)), speed = std::exp2(around(random, 10.0));
        for (const double next : {interp_to(from, to, dt, speed), interp_to_exact(from, to, dt, speed)}) {
            EXPECT_GE(next, std::min(from, to));
            EXPECT_LE(next, std::max(from, to));
        }
    }
}

TEST(SignalInterpolate, JumpsAtSpeedZeroAndArrivesExactly) {
    EXPECT_EQ(interp_to(1.0, 5.0, 0.1, 0.0), 5.0);
    EXPECT_EQ(interp_to(1.0, 5.0, 0.1, -3.0), 5.0);
    EXPECT_EQ(interp_to(1.0, 5.0, 0.1, not_a_number), 5.0);
    EXPECT_EQ(interp_to(1.0, 1.00009, 0.001, 1.0), 1.00009) << "squared distance under 1e-8";
    EXPECT_NE(interp_to(1.0, 1.00011, 0.001, 1.0), 1.00011);
    EXPECT_EQ(interp_to(1.0f, 5.0f, 0.25, 2.0), 3.0f);
    EXPECT_EQ(interp_to(glm::vec3(1, 2, 3), glm::vec3(5, 2, 1), 0.25, 2.0), glm::vec3(3, 2, 2));
    EXPECT_EQ(interp_to(glm::dvec3(1, 2, 3), glm::dvec3(5, 2, 1), 1.0, 2.0), glm::dvec3(5, 2, 1));
}

TEST(SignalInterpolate, RotationsTakeTheShortWay) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(random.point(1.0f)) + glm::dvec3(0, 0, 1.5));
        const double angle = between(random, 0.01, 3.1);
        const glm::dquat from = about({1, 0, 0}, around(random, 3.0)), to = about(axis, angle) * from;
        const double sign = random.chance(2) ? -1.0 : 1.0;  // the same rotation
        const glm::dquat mid = interp_to(from, to * sign, 0.25, 1.0);
        EXPECT_NEAR(angle_between(from, mid), 0.25 * angle, 1e-9);
        EXPECT_NEAR(angle_between(mid, to), 0.75 * angle, 1e-9);
        EXPECT_NEAR(glm::length(mid), 1.0, 1e-12);
        const glm::quat coarse = interp_to(glm::quat(from), glm::quat(to), 0.25, 1.0);
        EXPECT_NEAR(angle_between(glm::dquat(coarse), mid), 0.0, 1e-6);
    }
    const glm::quat target(0.5f, 0.5f, -0.5f, 0.5f);
    EXPECT_EQ(interp_to(glm::quat(1, 0, 0, 0), target, 1.0, 1.0), target);
    EXPECT_EQ(interp_to(-target, target, 1e-3, 1.0), target) << "they are the same rotation";
}

TEST(SignalInterpolate, BadNumbersChangeNothing) {
    for (const double bad : {not_a_number, infinity, -infinity, 1.1e9}) {
        EXPECT_EQ(interp_to(3.0, bad, 0.1, 1.0), 3.0);
        EXPECT_EQ(interp_to_exact(3.0, bad, 0.1, 1.0), 3.0);
        EXPECT_EQ(interp_to(glm::vec3(1), glm::vec3(0, static_cast<float>(bad), 0), 0.1, 1.0), glm::vec3(1));
    }
    for (const double dt : {0.0, -1.0, not_a_number, infinity, -infinity})
        EXPECT_EQ(interp_to(3.0, 4.0, dt, 0.0), 3.0) << dt;
    EXPECT_EQ(interp_to(not_a_number, 4.0, 0.1, 1.0), 4.0);
    const glm::quat good(1, 0, 0, 0), none(0, 0, 0, 0);
    EXPECT_EQ(interp_to(good, none, 0.1, 1.0), good);
    EXPECT_EQ(interp_to(none, good, 0.1, 1.0), good);
}

}  // namespace
}  // namespace tendril::test
