// A cloth that was dragged about hangs as before once released, and falls freely once unpinned.
// TENDRIL_GESTURES=200 drags more often.
#include <cmath>

#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using rope::ClothShape;

double mean_height(const World& world) {
    double sum = 0.0;
    for (const glm::dvec3& each : world.state().position) sum += each.y;
    return sum / static_cast<double>(world.size());
}

World hung(int side, const rope::ClothMaterial& material) {
    World world = world_with({.damping = 0.5f});
    world.add_cloth("cloth", {.corner = {-0.5f, 2, 0},
                              .along = {1, 0, 0},
                              .down = {0, -1, 0},
                              .columns = side,
                              .rows = side,
                              .density = material.density,
                              .shear = material.shear,
                              .bend = material.bend,
                              .pins = ClothShape::Pins::Corners});
    return world;
}

void pull_about(World& world, Random& random) {
    const std::size_t held = world.size() / 2 + random.below(world.size() / 2);
    for (int i = 0; i < 8; ++i) {
        world.pin(held, glm::vec3(0, 1.7f, 0) + random.point(0.9f), 0.4);
        run(world, 0.5);
    }
    world.unpin(held);
}

/// Relative deviation from a stone's fall, in half a second without pins.
double free_fall_error(World world) {
    world.set_settings({.damping = 0.0f});
    for (std::size_t i = 0; i < world.size(); ++i)
        if (world.pinned(i)) world.unpin(i);
    const double h = world.settings().substep, seconds = 0.5, before = mean_height(world);
    double speed = 0.0;
    for (const glm::dvec3& each : world.state().displacement) speed += each.y / h;
    speed /= static_cast<double>(world.size());
    run(world, seconds);
    const double fall = 0.5 * 9.81 * seconds * (seconds + h);
    return std::abs((before + speed * seconds - mean_height(world)) / fall - 1.0);
}

LABEL(slow, "RopeGesture.AClothHangsAgainAndFallsAsAStoneDoes");

TEST(RopeGesture, AClothHangsAgainAndFallsAsAStoneDoes) {
    const int gestures = rounds(3);
    for (const rope::ClothMaterial& material : rope::cloth_materials) {
        // Each takes seconds: by day the small cloths, once each.
        const bool first = &material == std::begin(rope::cloth_materials);
        for (const int side : {12, 18, 24}) {
            if (side > (first ? 18 : 12) && !is_thorough()) continue;
            const std::string what = std::string(material.name) + ' ' + std::to_string(side);
            World calm = hung(side, material);
            run(calm, 10.0);
            const double hanging = mean_height(calm);
            double worst = 0.0;
            const bool repeats = is_thorough() || (first && side == 12);
            // A different gesture for each size.
            const int from = repeats ? 1 : side / 6 - 1, to = repeats ? gestures : from;
            for (int seed = from; seed <= to; ++seed) {
                Random random(static_cast<std::uint64_t>(seed));
                World world = hung(side, material);
                pull_about(world, random);
                run(world, 5.0);
                const double off = std::abs(mean_height(world) - hanging) / hanging;
                worst = std::max(worst, off);
                // Relative to its height: some fold in another way and rest 3.4 % off; it once was 3 to 23 %.
                EXPECT_LE(off, 0.035) << what << ' ' << seed;
                EXPECT_LE(free_fall_error(world), 0.02) << what << ' ' << seed;
            }
            if (is_thorough()) std::printf("%s: off by %.2f %% at most\n", what.c_str(), 100.0 * worst);
        }
    }
}

}  // namespace
}  // namespace tendril::test
