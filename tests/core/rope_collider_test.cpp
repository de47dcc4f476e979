// The four shapes of colliders: distances, normals, and no NaN.
#include <glm/gtc/quaternion.hpp>
#include <tendril/rope/world.hpp>

#include "rope_support.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;
using rope::Box;
using rope::Capsule;
using rope::Plane;
using rope::Shape;
using rope::Sphere;
using rope::SurfaceDistance;

void expect_surface(const Shape& shape, const dvec3& point, double distance, const dvec3& normal) {
    const SurfaceDistance surface = surface_distance(shape, point);
    EXPECT_NEAR(surface.distance, distance, 1e-6);
    EXPECT_LE(glm::length(surface.normal - normal), 1e-6);
}

TEST(RopeCollider, DistanceAndNormalOfEachShape) {
    expect_surface(Sphere{{1, 0, 0}, 0.5f}, {3, 0, 0}, 1.5, {1, 0, 0});
    expect_surface(Sphere{{1, 0, 0}, 0.5f}, {1, -0.1, 0}, -0.4, {0, -1, 0});
    expect_surface(Capsule{{0, 0, 0}, {0, 2, 0}, 0.25f}, {1, 1, 0}, 0.75, {1, 0, 0});
    expect_surface(Capsule{{0, 0, 0}, {0, 2, 0}, 0.25f}, {0, 3, 0}, 0.75, {0, 1, 0});
    expect_surface(Plane{{0, 1, 0}, {0, 5, 0}}, {7, 3, 7}, 2.0, {0, 1, 0});
    expect_surface(Plane{{0, 1, 0}, {0, 5, 0}}, {7, 0, 7}, -1.0, {0, 1, 0});
    const Box box{{0, 0, 0}, {1, 2, 3}, glm::quat(1, 0, 0, 0)};
    expect_surface(box, {2, 0, 0}, 1.0, {1, 0, 0});
    expect_surface(box, {0.9, 0, 0}, -0.1, {1, 0, 0});
    expect_surface(box, {0, -1.9, 0}, -0.1, {0, -1, 0});
    expect_surface(box, {4, 6, 0}, 5.0, {0.6, 0.8, 0});  // 3, 4, 5 from an edge
    // A quarter turn about z: x and y are swapped.
    const Box turned{{0, 0, 0}, {1, 2, 3}, glm::angleAxis(static_cast<float>(pi) / 2, glm::vec3(0, 0, 1))};
    expect_surface(turned, {3, 0, 0}, 1.0, {1, 0, 0});
    expect_surface(turned, {0, 2, 0}, 1.0, {0, 1, 0});
}

/// Degenerate shapes of every kind: no size, no length, no unit rotation.
std::vector<Shape> thin_shapes() {
    return {Sphere{{1, 2, 3}, 0.0f},
            Capsule{{1, 2, 3}, {1, 2, 3}, 0.0f},
            Capsule{{1, 2, 3}, {1, 2, 3}, 0.5f},
            Capsule{{1, 2, 3}, {1, 3, 3}, 0.0f},
            Box{{1, 2, 3}, {0, 0, 0}, glm::quat(1, 0, 0, 0)},
            Box{{1, 2, 3}, {1, 0, 1}, glm::quat(0.1f, 0.2f, 0.3f, 0.4f)},
            Plane{{1, 2, 3}, {1e-6f, 0, 0}}};
}

TEST(RopeCollider, DegenerateShapesStillGiveANormal) {
    for (const Shape& shape : thin_shapes()) {
        const dvec3 middle(centre(shape));
        for (const dvec3& off :
             {dvec3(0.0), dvec3(1e-300, 0, 0), dvec3(0, 1e-13, 0), dvec3(0, 0, -1e-9), dvec3(0, 0.5, 0)}) {
            const SurfaceDistance surface = surface_distance(shape, middle + off);
            EXPECT_TRUE(std::isfinite(surface.distance)) << kind(shape);
            EXPECT_NEAR(glm::length(surface.normal), 1.0, 1e-9) << kind(shape);
        }
    }
}

/// From the centre, the axis, an edge or a corner: the distance along the normal leads to the surface.
TEST(RopeCollider, DistanceAndNormalLeadToTheSurface) {
    const Shape shapes[] = {Sphere{{0, 0, 0}, 0.5f}, Capsule{{-1, 0, 0}, {1, 0.5f, 0}, 0.3f},
                            Box{{0, 0, 0}, {0.5f, 0.5f, 0.5f}, glm::quat(0.9f, 0.1f, 0.2f, 0.3f)},
                            Plane{{0, 0.1f, 0}, {1, 2, 3}}};
    Random random(61);
    for (const Shape& shape : shapes) {
        for (int i = 0; i < 500; ++i) {
            dvec3 point = i == 0 ? dvec3(centre(shape)) : dvec3(random.point(1.5f));
            if (i % 5 == 1) point = dvec3(0.5, 0.5, 0.5) * static_cast<double>(random.around(1.0f));
            const SurfaceDistance surface = surface_distance(shape, point);
            const dvec3 on = point - surface.distance * surface.normal;
            EXPECT_NEAR(surface_distance(shape, on).distance, 0.0, 1e-7) << kind(shape);
            // No direction leads closer than the distance.
            const dvec3 aside = point + dvec3(random.point(1.0f)) * (0.5 * std::abs(surface.distance));
            EXPECT_LE(std::abs(surface_distance(shape, aside).distance - surface.distance),
                      glm::length(aside - point) + 1e-9)
                << kind(shape);
        }
    }
}

TEST(RopeCollider, MovesWithItsCentre) {
    Random random(62);
    for (const Shape& shape : thin_shapes()) {
        const glm::vec3 to = random.point(4.0f);
        EXPECT_LE(distance(centre(moved(shape, to)), to), 1e-6) << kind(shape);
        EXPECT_EQ(size(moved(shape, to)), size(shape));
        EXPECT_EQ(moved(shape, to).index(), shape.index());
    }
    EXPECT_EQ(size(Box{{0, 0, 0}, {3, 1, 2}, {}}), 1.0f);
    EXPECT_EQ(size(Plane{}), 1.0f);
}

// Capsules whose ends move along separate lines.

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
