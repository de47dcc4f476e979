// Capsules whose ends move along separate lines.
#include <tendril/rope/world.hpp>

#include "rope_support.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;
using rope::Capsule;

const Capsule& capsule_of(const rope::World& world, rope::ColliderId id) {
    return std::get<Capsule>(world.find(id)->shape);
}

TEST(RopeCapsule, EndsMoveEvenlyToTheirGoals) {
    rope::World world;
    rope::Workspace workspace;
    const Capsule from{{0, 0, 0}, {0, 1, 0}, 0.1f}, to{{0.4f, 0, 0}, {0.4f, 0.2f, 0.8f}, 0.2f};
    const rope::ColliderId id = *world.add_collider(from);
    const double h = world.settings().substep;
    ASSERT_TRUE(world.move_capsule(id, to, 4.0 * h));
    for (int i = 1; i <= 4; ++i) {
        world.advance(h, workspace);
        const float part = 0.25f * static_cast<float>(i);
        EXPECT_LE(glm::length(capsule_of(world, id).a - (from.a + part * (to.a - from.a))), 1e-6f);
        EXPECT_LE(glm::length(capsule_of(world, id).b - (from.b + part * (to.b - from.b))), 1e-6f);
    }
    EXPECT_EQ(capsule_of(world, id).radius, to.radius);
    EXPECT_FALSE(world.find(id)->half_goal) << "it is there";
    const Capsule there = capsule_of(world, id);
    world.advance(4.0 * h, workspace);
    EXPECT_EQ(capsule_of(world, id), there) << "and stays";
}

/// A figure at rest sends its capsules to the same place in every tick. The smallest motion would lift the
/// bound on the energy of what hangs on them.
TEST(RopeCapsule, OneSentToWhereItIsStaysToTheBit) {
    Random random(1);
    rope::World world;
    rope::Workspace workspace;
    const double h = world.settings().substep;
    const rope::ColliderId id = *world.add_collider(Capsule{});
    for (int round = 0; round < 200; ++round) {
        const Capsule to{random.point(2.0f), random.point(2.0f), 0.1f};
        ASSERT_TRUE(world.move_capsule(id, to, 3.0 * h));
        world.advance(3.0 * h, workspace);
        EXPECT_EQ(capsule_of(world, id), to);
        ASSERT_TRUE(world.move_capsule(id, to, 3.0 * h));
        for (int i = 0; i < 3; ++i) {
            world.advance(h, workspace);
            EXPECT_EQ(capsule_of(world, id), to);
        }
    }
}

TEST(RopeCapsule, ATranslatedCapsuleEqualsAMovedCollider) {
    rope::World moved, turned;
    rope::Workspace workspace;
    const Capsule from{{-1, 0, 0}, {1, 0, 0}, 0.1f};
    for (rope::World* world : {&moved, &turned}) {
        (void)*world->add_collider(from);
        (void)*world->add_rope({.from = {0, 0.5f, -1}, .to = {0, 0.5f, 1}, .radius = 0.02f});
    }
    const rope::ColliderId id = moved.state().colliders[0].id;
    ASSERT_TRUE(moved.move_collider(id, {0, 1, 0}, 0.2));
    ASSERT_TRUE(turned.move_capsule(id, {{-1, 1, 0}, {1, 1, 0}, 0.1f}, 0.2));
    moved.advance(0.2, workspace);
    turned.advance(0.2, workspace);
    for (std::size_t i = 0; i < moved.size(); ++i)
        EXPECT_LE(glm::length(moved.position(i) - turned.position(i)), 1e-6) << i;
}

/// A bar that swings through a fast quarter turn pushes a rope in its path, at any thickness.
TEST(RopeCapsule, ATurningCapsulePushesARope) {
    rope::World world;
    rope::Workspace workspace;
    const Capsule from{{0, 0, 0}, {1, 0, 0}, 0.02f}, to{{0, 0, 0}, {0, 0, 1}, 0.02f};
    const rope::ColliderId id = *world.add_collider(from);
    // Its end moves along a line: half way it reaches 0.71 m; the rope hangs at 0.57 m.
    const rope::BodyId line = *world.add_rope({.from = {0.4f, 1, 0.4f},
                                               .to = {0.4f, -0.5f, 0.4f},
                                               .segments = 30,
                                               .radius = 0.01f,
                                               .pin_start = true});
    ASSERT_TRUE(world.move_capsule(id, to, 0.1));
    double deepest = 0.0;
    const std::size_t first = world.find(line)->first, count = world.find(line)->count;
    for (int i = 0; i < 36; ++i) {
        world.advance(world.settings().substep, workspace);
        for (std::size_t p = first; p < first + count; ++p)
            deepest =
                std::max(deepest, 0.01 - surface_distance(world.find(id)->shape, world.position(p)).distance);
    }
    EXPECT_LT(deepest, 1e-4);
    // The bar pushed the rope along: at the height of the bar, none of it is behind the bar.
    for (std::size_t p = first; p < first + count; ++p)
        if (std::abs(world.position(p).y) < 0.05) {
            EXPECT_LT(world.position(p).x, 0.1) << p;
        }
}

/// Friction moves a body with the surface point below it, and not where the surface is at rest.
TEST(RopeCapsule, CarriesABodyAsFarAsThePointBelowItMoves) {
    rope::World world;
    rope::Workspace workspace;
    rope::Settings settings;
    settings.friction = 2.0f;
    ASSERT_TRUE(world.set_settings(settings));
    const rope::ColliderId id = *world.add_collider(Capsule{{0, 0, 0}, {2, 0, 0}, 0.1f});
    rope::BodyId lying[2];
    for (int i = 0; i < 2; ++i) {
        const float x = i == 0 ? 0.1f : 1.9f;
        lying[i] = *world.add_rope(
            {.from = {x - 0.05f, 0.11f, 0}, .to = {x + 0.05f, 0.11f, 0}, .segments = 2, .radius = 0.01f});
    }
    // End b moves sideways, end a is fixed.
    ASSERT_TRUE(world.move_capsule(id, {{0, 0, 0}, {2, 0, 0.3f}, 0.1f}, 0.5));
    world.advance(0.25, workspace);
    world.advance(0.25, workspace);
    EXPECT_NEAR(world.position(*world.particle(lying[0], 1)).z, 0.015, 0.01);
    EXPECT_NEAR(world.position(*world.particle(lying[1], 1)).z, 0.285, 0.03);
}

TEST(RopeCapsule, RefusesInvalidMoves) {
    rope::World world;
    const rope::ColliderId ball = *world.add_collider(rope::Sphere{});
    const rope::ColliderId bar = *world.add_collider(Capsule{});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string said = world.move_capsule(ball, {}).message();
    EXPECT_NE(said.find("a capsule, got sphere"), std::string::npos) << said;
    EXPECT_FALSE(world.move_capsule({}, {}));
    EXPECT_FALSE(world.move_capsule(bar, {{nan, 0, 0}, {0, 1, 0}, 0.1f}));
    EXPECT_FALSE(world.move_capsule(bar, {}, -1.0));
    rope::State state = world.state();
    state.colliders[0].half_goal = dvec3(1.0);
    const std::string bad = rope::World::from_state(state).message();
    EXPECT_NE(bad.find("colliders[0].half_goal"), std::string::npos) << bad;
    state.colliders[0].half_goal.reset();
    state.colliders[1].half_goal = dvec3(nan);
    EXPECT_FALSE(rope::World::from_state(state));
}

}  // namespace
}  // namespace tendril::test
