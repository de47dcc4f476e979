// Behaviour is the same for few segments and for thousands, in the air and on colliders.
#include <array>

#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using rope::Box;
using rope::Capsule;
using rope::Sphere;

constexpr double thousandth = 1e-3;

double deepest_inside(const World& world) {
    double depth = 0.0;
    for (const rope::Body& body : world.state().bodies)
        for (std::size_t i = body.first; i < body.first + body.count; ++i)
            for (const rope::Collider& collider : world.state().colliders)
                depth =
                    std::max(depth, static_cast<double>(body.radius) -
                                        surface_distance(collider.shape, world.state().position[i]).distance);
    return depth;
}

/// Four metres of rope between points three metres apart, with balls that rise from below.
World hung_over(int segments, int balls, float radius) {
    World world;
    world.add_rope("rope", pinned_rope({0, 0, 0}, {3, 0, 0}, segments, 4.0f, 0.01f));
    for (int i = 0; i < balls; ++i) {
        const float x = 3.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(balls);
        world.add_collider("ball " + std::to_string(i), Sphere{{x, -2.2f, 0}, radius});
        world.move_collider("ball " + std::to_string(i), {x, -0.9f, 0}, 1.0);
    }
    return world;
}

LABEL(slow, "RopeResolution.KeepsItsLength*");

TEST(RopeResolution, KeepsItsLengthOverBallsWithAnyNumberOfSegments) {
    for (const int segments : {64, 1100, 4096}) {
        World world = hung_over(segments, 4, 0.2f);
        std::uint64_t unconverged = 0;
        for (int i = 0; i < 90; ++i) {
            unconverged += world.advance(1.0 / 60.0).unconverged;
            ASSERT_LE(stretch(world), thousandth) << segments << ' ' << i;
        }
        // In two of 360 substeps, links of the longest rope still turn when the steps are used up.
        EXPECT_LE(unconverged, segments > 4000 ? 2u : 0u) << segments;
        EXPECT_LE(deepest_inside(world), 1e-4) << segments;
        EXPECT_GT(world.position(static_cast<std::size_t>(segments / 2)).y, -1.2) << segments;  // held up
        while (!world.state().colliders.empty())
            ASSERT_TRUE(world.core().remove_collider(world.state().colliders.back().id));
        run(world, 0.5);
        EXPECT_LE(stretch(world), thousandth) << segments;
    }
}

/// So many balls that they overlap and each link touches several. Their motion stretches it only briefly.
TEST(RopeResolution, KeepsItsLengthOverManyBalls) {
    World world = hung_over(1024, 64, 0.05f);
    for (int i = 0; i < 120; ++i) {
        world.advance(1.0 / 60.0);
        EXPECT_LE(deepest_inside(world), 1e-4) << i;
        if (i < 90) continue;  // half a second after they stop
        ASSERT_LE(stretch(world), thousandth) << i;
    }
}

/// It falls in folds that run along it at more than a segment per substep.
TEST(RopeResolution, KeepsItsLengthFallingOnBallsAndAFloor) {
    for (const int segments : {64, 256, 1024, 4096}) {
        if (segments > 1024 && !is_thorough()) continue;
        World world;
        world.add_rope("rope",
                       {.from = {-2, 2.5f, 0}, .to = {2, 2.5f, 0}, .segments = segments, .radius = 0.01f});
        world.add_collider("floor", rope::Plane{});
        for (int i = 0; i < 15; ++i) {
            const auto n = static_cast<float>(i);
            const float high = 0.4f + 0.15f * static_cast<float>(i % 3);
            world.add_collider("ball " + std::to_string(i),
                               Sphere{{-1.8f + 0.26f * n, high, 0.03f * std::sin(n)}, 0.12f});
        }
        run_substeps(world, is_thorough() ? 960 : 300, [&] { ASSERT_LT(stretch(world), 0.01) << segments; });
    }
}

/// Links may be much longer or much shorter than the bar is thick.
TEST(RopeResolution, KeepsItsLengthTautOverAThinBar) {
    for (const int segments : {16, 64, 256, 1024})
        for (const float friction : {0.0f, 0.5f, 1.0f}) {
            if (segments > 256 && !is_thorough()) continue;
            World world = world_with({.friction = friction});
            world.add_rope("rope", pinned_rope({-0.5f, 0, 0.01f}, {0.5f, 0, -0.01f}, segments, 1.2f, 0.01f));
            world.add_collider("bar", Capsule{{0, -1, -1}, {0, -1, 1}, 0.02f});
            run(world, 0.25);
            world.move_collider("bar", {0, 0.29f, 0}, 2.0);
            run(world, 3.0);
            EXPECT_LE(stretch(world), thousandth) << segments << ' ' << friction;
        }
}

/// Taut between two pins, no sideways force is balanced; a dragged end whips.
TEST(RopeResolution, KeepsItsLengthInTheAirTautOrDragged) {
    for (const double rate : {240.0, 960.0})
        for (const int segments : {16, 64, 256})
            for (const bool taut : {true, false}) {
                World world = world_with({.substep = 1.0 / rate});
                world.add_rope("rope", {.from = {0, 0, 0},
                                        .to = {1, 0, 0},
                                        .segments = segments,
                                        .pin_start = true,
                                        .pin_end = taut});
                double worst = 0.0;
                for (int i = 0; i < 3 * static_cast<int>(rate); ++i) {
                    const auto t = static_cast<float>(i / rate);
                    if (!taut) world.pin(0, {0.3f * std::sin(6.0f * t), 0.2f * std::sin(9.0f * t), 0.0f});
                    world.advance(world.settings().substep);
                    worst = std::max(worst, stretch(world));
                }
                EXPECT_LE(worst, 5e-4) << segments << (taut ? " taut" : " dragged") << " at 1/" << rate;
            }
}

/// A nearby collider that is not touched changes no bit.
TEST(RopeResolution, ABeamThatIsNotTouchedChangesNothing) {
    std::array<World, 2> worlds{world_with({.damping = 0.0f}), world_with({.damping = 0.0f})};
    for (World& world : worlds)
        world.add_rope("rope", {.to = {0.2f, -0.98f, 0}, .segments = 16, .radius = 0.01f, .pin_start = true});
    worlds[1].add_collider("beam", Box{{0, -0.5f, 0.118f}, {2.0f, 0.05f, 0.1f}});
    double widest = 0.0;
    for (int i = 0; i < 120; ++i) {
        for (World& world : worlds) run(world, 0.25);
        if (i >= 112) widest = std::max(widest, std::abs(worlds[1].state().position[16].x));
    }
    EXPECT_EQ(worlds[0].state().position, worlds[1].state().position);
    EXPECT_GE(widest, 0.9 * 0.2);
}

/// A ball drags a rope that is too short: it stretches smoothly, and recovers after the ball has left.
TEST(RopeResolution, StretchesIfItMustAndRecovers) {
    World world;
    world.add_rope("rope", pinned_rope({-1, 0, 0}, {1, 0, 0}, 64));
    world.add_collider("ball", Sphere{{0, 0, 0.4f}, 0.3f});
    world.move_collider("ball", {0, 0, -0.4f}, 1.0);
    double before = 0.0;
    for (int i = 0; i < 60; ++i) {
        world.advance(1.0 / 60.0);
        const double now = stretch(world);
        EXPECT_LE(std::abs(now - before), 0.02) << i;
        before = now;
    }
    EXPECT_GE(before, 0.05);
    EXPECT_LE(before, 0.6);
    EXPECT_LE(deepest_inside(world), 1e-4);
    EXPECT_TRUE(all_finite(world));
    world.move_collider("ball", {0, 0, 1.0f}, 0.5);
    run(world, 1.5);
    EXPECT_LE(stretch(world), thousandth);
}

}  // namespace
}  // namespace tendril::test
