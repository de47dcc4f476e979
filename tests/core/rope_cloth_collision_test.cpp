// Cloth that collides with itself, with ropes and with other cloth: nothing passes through it, and layers
// keep their thickness. Segments that pierce triangles show whether something passed.
#include <gtest/gtest.h>

#include <cmath>

#include "rope_cloth_collision.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;

/// Folds a cloth at 0: layers `gap` apart with half a circle between them. Sets `at` to the position along
/// the layers and returns the height above the lower one.
double fold(double& at, double gap) {
    const double quarter = 0.25 * pi * gap;
    if (std::abs(at) >= quarter) {
        const bool upper = at > 0.0;
        at = quarter - std::abs(at);
        return upper ? gap : 0.0;
    }
    const double turned = 2.0 * at / gap;
    at = 0.5 * gap * std::cos(turned);
    return 0.5 * gap * (1.0 + std::sin(turned));
}

/// A cloth folded in four, lying on the ground.
World folded(int size, float radius) {
    World world;
    world.add_collider("ground", rope::Plane{{0, 0, 0}, {0, 1, 0}});
    const float side = 0.03f * static_cast<float>(size - 1);
    world.add_cloth("cloth", {.corner = {-0.5f * side, 0, -0.5f * side},
                              .along = {side, 0, 0},
                              .down = {0, 0, side},
                              .columns = size,
                              .rows = size,
                              .radius = radius});
    rope::State state = world.state();
    const double apart = 2.1 * radius;
    for (dvec3& p : state.position) {
        const double inner = fold(p.x, apart), outer = fold(p.z, 3.0 * apart - 2.0 * inner);
        p.y = 0.5 * apart + inner + outer;
    }
    World made(std::move(state));
    collide(made, "cloth", "cloth");
    return made;
}

LABEL(slow, "RopeClothCollision.FoldedInFour*");
LABEL(slow, "RopeClothCollision.ARope*");

TEST(RopeClothCollision, FoldedInFourItKeepsTheThicknessOfItsLayers) {
    constexpr int size = 16;
    constexpr float radius = 0.006f;
    World world = folded(size, radius);
    ASSERT_EQ(pierced(world), 0);
    const double before = world.energy(), all = weight(world);
    std::vector<dvec3> were;
    for (int second = 1; second <= (is_thorough() ? 30 : 12); ++second) {
        were = world.state().position;
        run(world, 1.0);
        // Four particles above each other, far from the creases.
        const auto height = [&](int column, int row) {
            return world.core().position(static_cast<std::size_t>(row * size + column)).y / (2.0 * radius);
        };
        const double lowest = height(3, 3), second_layer = height(size - 4, 3),
                     third = height(size - 4, size - 4), top = height(3, size - 4);
        EXPECT_NEAR(lowest, 0.5, 0.1) << second;
        EXPECT_GT(second_layer - lowest, 0.8) << second;
        EXPECT_GT(third - second_layer, 0.8) << second;
        EXPECT_GT(top - third, 0.8) << second;
        ASSERT_EQ(pierced(world), 0) << second;
        EXPECT_LT(world.energy() - before, 0.03 * all) << second;
    }
    EXPECT_LT(world.length_error(), 5e-4);
    EXPECT_LT(top_speed(world), 0.01);
    for (std::size_t i = 0; i < were.size(); ++i)
        EXPECT_LT(glm::length(world.state().position[i] - were[i]), 2e-3) << "it creeps at " << i;
}

TEST(RopeClothCollision, WithoutCollisionTheLayersFallThroughEachOther) {
    World world = folded(16, 0.006f);
    allow(world.set_collides(world.id("cloth"), world.id("cloth"), false));
    run(world, 2.0);
    EXPECT_GT(pierced(world), 0);
}

/// A cloth held by its four corners, and a rope and a smaller cloth above it.
World hammock() {
    World world;
    world.add_cloth("hammock", {.corner = {-0.4f, 1, -0.4f},
                                .along = {0.8f, 0, 0},
                                .down = {0, 0, 0.8f},
                                .columns = 14,
                                .rows = 14,
                                .radius = 0.008f,
                                .pins = rope::ClothShape::Pins::Corners});
    for (const std::size_t corner : {13u * 14u, 14u * 14u - 1u})
        allow(world.core().pin(corner, world.core().position(corner)));
    world.add_rope("rope",
                   {.from = {-0.15f, 1.1f, 0.05f}, .to = {0.2f, 1.1f, 0}, .segments = 12, .radius = 0.01f});
    world.add_cloth("small", {.corner = {-0.1f, 1.2f, -0.15f},
                              .along = {0.3f, 0, 0.02f},
                              .down = {0, 0, 0.3f},
                              .columns = 7,
                              .rows = 7,
                              .radius = 0.008f});
    for (const char* each : {"rope", "small"}) collide(world, "hammock", each);
    collide(world, "rope", "small");
    return world;
}

TEST(RopeClothCollision, ARopeAndAClothRestOnACloth) {
    World world = hammock();
    for (int frame = 0; frame < 240; ++frame) {
        if (frame == 10) {
            EXPECT_NEAR(points_of(world, "small")[24].y, 1.2 - 0.136, 0.02) << "it falls freely";
        }
        world.advance(1.0 / 60.0);
        ASSERT_EQ(pierced(world), 0) << frame;
    }
    EXPECT_TRUE(all_finite(world));
    for (const char* each : {"rope", "small"})
        for (const dvec3& p : points_of(world, each)) EXPECT_GT(p.y, 0.6) << each;
    EXPECT_LT(world.length_error(),
              0.025);  // contacts and lengths are projected in turns, which leaves 2.2 %
    // Both load it: without them it sags less.
    const double loaded = lowest(world);
    world.remove("rope");
    world.remove("small");
    run(world, 3.0);
    EXPECT_GT(lowest(world), loaded + 0.003);
}

TEST(RopeClothCollision, ThreadsAndCopiesGiveTheSameBits) {
    World world = hammock();
    world.add_cloth("apart", {.corner = {3, 1, 0}, .columns = 6, .rows = 6});
    World copy(world.state());
    rope::World shared = world.core();
    rope::Workspace workspace;
    Jobs jobs;
    allow(workspace.use_threads(3, {run_on_jobs, &jobs}));
    for (int frame = 0; frame < 40; ++frame) {
        world.advance(1.0 / 60.0);
        shared.advance(1.0 / 60.0, workspace);
        copy = World(copy.state());
        copy.advance(1.0 / 60.0);
    }
    EXPECT_TRUE(same_bits(world.state(), shared.state()));
    EXPECT_TRUE(same_bits(world.state(), copy.state()));
}

}  // namespace
}  // namespace tendril::test
