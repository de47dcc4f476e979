// A released rope may lose energy but never gains any.
#include "rope_collision_support.hpp"
#include "rope_support.hpp"
#include "tests/labels.hpp"

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

LABEL(slow, "Ropes/RopeEnergy.NeverGrowsInAMinute/256*");

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

/// Without external forces, bodies that are thrown at each other keep their common momentum, and their
/// angular momentum, however they meet.
TEST(RopeEnergyFree, MomentumIsConserved) {
    for (int seed = 0; seed < rounds(48); ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        World world = world_with({.damping = 0.0f, .gravity = {0, 0, 0}});
        const char* const names[] = {"a", "b", "c"};
        const int bodies = 1 + seed % 3, cloths = seed / 3 % 3;
        for (int b = 0; b < bodies; ++b) {
            const glm::vec3 along = glm::normalize(glm::vec3(1, 0, 0) + random.point(0.9f)),
                            down = glm::normalize(glm::cross(along, glm::vec3(0, 1, 0) + random.point(0.3f))),
                            middle = glm::vec3(0, 0.35f * static_cast<float>(b), 0) + random.point(0.1f);
            if (b < cloths)
                world.add_cloth(names[b],
                                square_cloth(middle - 0.4f * (along + down), 0.8f * along, 0.8f * down, 12));
            else
                world.add_rope(names[b], {.from = middle - 0.5f * along,
                                          .to = middle + 0.5f * along,
                                          .segments = 8 + static_cast<int>(random.below(20)),
                                          .density = 0.2f + random.part()});
            for (int other = 0; other <= b; ++other) collide(world, names[b], names[other]);
        }
        const float closing = 0.5f + random.part();
        throw_all(world, [&](std::size_t i) {
            const std::size_t body = i < world.find("a")->count ? 0 : 1;
            return glm::dvec3(0.0, body == 0 ? closing : -closing, 0.0) + glm::dvec3(random.point(0.1f));
        });
        const glm::dvec3 before = momentum(world), turned = angular_momentum(world);
        double mass = 0.0;
        for (const double each : world.state().mass) mass += each;
        run_substeps(world, 240, [] {});
        const double size = mass * static_cast<double>(closing);  // at a metre from the axis, for the latter
        EXPECT_LE(glm::length(momentum(world) - before) / size, 1e-10)
            << seed << ": " << bodies << " bodies, " << cloths << " cloths";
        EXPECT_LE(glm::length(angular_momentum(world) - turned) / size, 1e-10)
            << seed << ": " << bodies << " bodies, " << cloths << " cloths";
    }
}

/// Pulled far too long and let go: its links snap back in steps that are cut, but its whole falls.
TEST(RopeEnergyFree, AnOverstretchedRopeThatBendsFallsFreely) {
    for (const float pulled : {1.2f, 1.5f, 3.0f}) {
        World world = world_with({.damping = 0.0f});
        world.add_rope("rope", {.bending = 1e-2f, .pin_start = true, .pin_end = true});
        const std::size_t end = world.particle("rope", 32);
        world.pin(end, {pulled, 0, 0}, 0.5);
        run_substeps(world, 180, [] {});
        world.unpin(0);
        world.unpin(end);
        const glm::dvec3 before = momentum(world);
        run_substeps(world, 120, [] {});
        const double mass = world.mass(*world.find("rope"));
        EXPECT_NEAR((momentum(world) - before).y / mass, -9.81 * 0.5, 0.01) << pulled;
    }
}

}  // namespace
}  // namespace tendril::test
