// A released rope may lose energy but never gains any.
#include "rope_support.hpp"

namespace tendril::test {
namespace {

using rope::Settings;

/// Weight times length: the energy scale of all percentages.
double scale(const World& world) {
    double mass = 0.0;
    for (const double each : world.state().mass) mass += each;
    return mass * 9.81 * world.length(*world.find("rope"));
}

/// Maximum energy gain over the start within `seconds`, as a fraction of scale().
double most_gained(World& world, int seconds) {
    run_substeps(world, 2, [] {});
    const double start = energy(world), of = scale(world);
    double most = -1.0;
    run_substeps(world, seconds * 240, [&] { most = std::max(most, (energy(world) - start) / of); });
    EXPECT_TRUE(all_finite(world));
    EXPECT_LE(stretch(world), 1e-3);
    return most;
}

/// A horizontal rope at rest, bent so that no part of it is in balance.
World unbalanced_rope(int segments, bool both_ends) {
    World world = world_with({.damping = 0.0f});
    world.add_rope("rope", {.from = {0, 0, 0},
                            .to = {both_ends ? 0.7f : 1.0f, 0, 0.2f},
                            .segments = segments,
                            .length = both_ends ? 1.3f : 1.05f,
                            .pin_start = true,
                            .pin_end = both_ends});
    return world;
}

class RopeEnergy : public testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(RopeEnergy, NeverGrowsInAMinute) {
    const auto [segments, both_ends] = GetParam();
    World world = unbalanced_rope(segments, both_ends);
    if (both_ends) {  // it hangs nearly still, so the wind first sets it in motion
        Settings settings = world.settings();
        settings.external = {3, 2, 4};
        world.set_settings(settings);
        run(world, 1.0);
        settings.external = {0, 0, 0};
        world.set_settings(settings);
    }
    EXPECT_LE(most_gained(world, 60), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Ropes, RopeEnergy, testing::Combine(testing::Values(16, 64, 256), testing::Bool()),
                         [](const auto& of) {
                             return std::to_string(std::get<0>(of.param)) +
                                    (std::get<1>(of.param) ? "_both_ends" : "_one_end");
                         });

/// Thrown and rotating without gravity: nothing holds it, and nothing may accelerate it.
TEST(RopeEnergyFree, AThrownRopeGainsNoEnergy) {
    World world = world_with({.damping = 0.0f, .gravity = {0, 0, 0}});
    world.add_rope("rope", {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 24, .length = 1.2f});
    Random random(43);
    throw_all(world, [&](std::size_t) { return glm::dvec3(random.point(2.0f)); });
    run_substeps(world, 240, [] {});  // the length constraints first take their part
    const double start = energy(world);
    double most = 0.0;
    run_substeps(world, 60 * 240, [&] { most = std::max(most, energy(world)); });
    EXPECT_GT(start, 0.0);
    EXPECT_LE(most / start, 1.001);
    EXPECT_LE(stretch(world), 1e-3);
}

/// Every particle is thrown in a random direction, with one end held: the rope cracks like a whip all over.
TEST(RopeEnergyFree, AThrashingRopeGainsNoEnergy) {
    for (const double substep : {1.0 / 240.0, 1.0 / 60.0}) {
        for (const int segments : {16, 256}) {
            World world = world_with({.substep = substep, .damping = 0.0f});
            world.add_rope("rope", {.from = {0, 0, 0},
                                    .to = {1, 0, 0},
                                    .segments = segments,
                                    .length = 1.2f,
                                    .pin_start = true});
            Random random(static_cast<std::uint64_t>(7 + segments));
            throw_all(world, [&](std::size_t i) {
                const glm::dvec3 velocity(random.point(4.0f));
                return i == 0 ? glm::dvec3(0.0) : velocity;
            });
            run_substeps(world, 8, [] {});
            const double start = energy(world), of = scale(world);
            double most = -1e9;
            run_substeps(world, static_cast<int>(20.0 / substep),
                         [&] { most = std::max(most, energy(world)); });
            EXPECT_LE((most - start) / of, 1e-3) << substep << ' ' << segments;
        }
    }
}

/// Without external forces, centre of mass and momentum are constant.
TEST(RopeEnergyFree, MomentumIsConserved) {
    for (const rope::Solver solver : all_solvers) {
        World world = world_with({.solver = solver, .damping = 0.0f, .gravity = {0, 0, 0}});
        world.add_rope("rope", {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 12, .length = 1.2f});
        Random random(44);
        throw_all(world, [&](std::size_t) { return glm::dvec3(random.point(1.0f)); });
        const auto sum = [](const std::vector<glm::dvec3>& all) {
            glm::dvec3 total(0.0);
            for (const glm::dvec3& each : all) total += each;
            return total;
        };
        const glm::dvec3 before = sum(world.state().displacement), from = sum(world.state().position);
        run_substeps(world, 240, [] {});
        EXPECT_LE(glm::length(sum(world.state().position) - from - 240.0 * before), 1e-3) << name(solver);
    }
}

}  // namespace
}  // namespace tendril::test
