// One stiff segment that swings: its period, how long it keeps its energy, and its damping.
#include "rope_support.hpp"

namespace tendril::test {
namespace {

using rope::Settings;
using rope::Solver;

constexpr double earth_gravity = 9.81;

World pendulum(float length, float amplitude, const Settings& settings) {
    World world = world_with(settings);
    world.add_rope("rope", {.from = {0, 0, 0},
                            .to = {length * std::sin(amplitude), -length * std::cos(amplitude), 0},
                            .segments = 1,
                            .pin_start = true});
    return world;
}

/// The mean of `swings` periods, from one zero crossing.
double period(World& world, int swings) {
    double before = world.state().position[1].x, time = 0.0, first = -1.0;
    for (int seen = -1; seen < swings && time < 120.0;) {
        world.advance(world.settings().substep);
        time += world.settings().substep;
        const double now = world.state().position[1].x;
        if (before < 0.0 && now >= 0.0) {
            const double at = time - world.settings().substep * now / (now - before);
            if (first < 0.0) first = at;
            if (++seen == swings) return (at - first) / swings;
        }
        before = now;
    }
    return 0.0;
}

/// Energy above the energy at rest.
double swing(const World& world, double length) {
    return energy(world) + world.state().mass[1] * earth_gravity * length;
}

TEST(RopePendulum, HasTheTheoreticalPeriod) {
    for (const float length : {0.5f, 1.0f, 2.0f}) {
        World world = pendulum(length, 0.1f, {.damping = 0.0f});
        const double expected = 2.0 * pi * std::sqrt(length / earth_gravity);
        EXPECT_NEAR(period(world, 10) / expected, 1.0, 0.005) << length;
    }
}

/// Wider swings take longer, by a factor of 1 + a^2/16 + 11 a^4/3072.
TEST(RopePendulum, WiderSwingsTakeLonger) {
    for (const float amplitude : {0.3f, 0.5f, 1.0f}) {
        World world = pendulum(1.0f, amplitude, {.damping = 0.0f});
        const double a = amplitude, longer = 1.0 + a * a / 16.0 + 11.0 * a * a * a * a / 3072.0;
        EXPECT_NEAR(period(world, 3) / (2.0 * pi * std::sqrt(1.0 / earth_gravity)), longer, 0.002)
            << amplitude;
    }
}

TEST(RopePendulum, ThePeriodDoesNotDependOnTheSubstep) {
    for (const double substep : {1.0 / 960.0, 1.0 / 120.0, 1.0 / 60.0}) {
        World world = pendulum(1.0f, 0.1f, {.substep = substep, .damping = 0.0f});
        EXPECT_NEAR(period(world, 5) / (2.0 * pi * std::sqrt(1.0 / earth_gravity)), 1.0, 0.005) << substep;
    }
}

TEST(RopePendulum, KeepsNineTenthsOfItsEnergyForAMinute) {
    for (const float length : {0.5f, 1.0f}) {
        World world = pendulum(length, 0.5f, {.damping = 0.0f});
        run_substeps(world, 2, [] {});  // the energy reported is one substep old
        const double start = swing(world, length);
        double most = 0.0;
        run_substeps(world, 60 * 240, [&] { most = std::max(most, swing(world, length)); });
        EXPECT_GE(swing(world, length) / start, 0.9) << length;
        EXPECT_LE(most / start, 1.001) << length;
    }
}

/// Plain projection loses 92 % in a minute, as the spec says. Relaxation must stay plain.
TEST(RopePendulum, PlainRelaxationLosesMostOfIt) {
    World world = pendulum(1.0f, 0.5f, {.solver = Solver::Relaxation, .damping = 0.0f});
    run_substeps(world, 2, [] {});
    const double start = swing(world, 1.0);
    run(world, 60.0);
    EXPECT_NEAR(1.0 - swing(world, 1.0) / start, 0.92, 0.02);
}

/// Velocity decays as exp(-c t), so the amplitude as exp(-c t / 2) and its energy as exp(-c t).
TEST(RopePendulum, DampingMatchesItsRate) {
    for (const float damping : {0.1f, 0.5f, 2.0f}) {
        World free = pendulum(1.0f, 0.1f, {.damping = 0.0f});
        World damped = pendulum(1.0f, 0.1f, {.damping = damping});
        const double seconds = std::min(10.0, 3.0 / static_cast<double>(damping));
        const auto mean_swing = [&](World& world) {  // mean over one period, since only motion is damped
            double sum = 0.0;
            run_substeps(world, 480, [&] { sum += swing(world, 1.0); });
            return sum;
        };
        const double free_start = mean_swing(free), damped_start = mean_swing(damped);
        run(free, seconds), run(damped, seconds);
        const double kept = mean_swing(damped) / damped_start / (mean_swing(free) / free_start);
        EXPECT_NEAR(std::log(kept) / (-static_cast<double>(damping) * (seconds + 2.0)), 1.0, 0.03) << damping;
    }
}

/// Damping is a rate per second, not per substep.
TEST(RopePendulum, DampingDoesNotDependOnTheSubstep) {
    for (const double substep : {1.0 / 240.0, 1.0 / 1920.0}) {
        World world = world_with({.substep = substep, .damping = 2.0f, .gravity = {0, 0, 0}});
        world.add_rope("rope", {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 1});
        throw_all(world, [](std::size_t) { return glm::dvec3(0, 1, 0); });
        run(world, 1.0);
        EXPECT_NEAR(world.velocity(0).y, std::exp(-2.0), 1e-6) << substep;
    }
}

/// Gravity, its scale and wind add up to one acceleration: a pendulum swings about any direction.
TEST(RopePendulum, SwingsAboutTheDirectionOfAcceleration) {
    const Settings turned{
        .damping = 0.5f, .gravity = {0, -9.81f, 0}, .gravity_scale = 0.5f, .external = {4.905f, 0, 0}};
    World world = pendulum(1.0f, 0.1f, turned);
    run(world, 40.0);
    const glm::vec3 end = world.position(1);
    EXPECT_NEAR(end.x, std::sqrt(0.5), 1e-3);
    EXPECT_NEAR(end.y, -std::sqrt(0.5), 1e-3);
    EXPECT_NEAR(end.z, 0.0, 1e-6);
}

}  // namespace
}  // namespace tendril::test
