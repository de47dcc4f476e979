// Driven grounds and boxes: friction carries the bodies on them.
#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;

std::string lay(World& world, bool cloth, dvec3 at) {
    const glm::vec3 from(at);
    if (cloth) return world.add_cloth("on it", square_cloth(from, {0.5f, 0, 0}, {0, 0, 0.5f}, 8));
    return world.add_rope("on it", {.from = from, .to = from + glm::vec3(0.5f, 0, 0), .segments = 8});
}

const dvec3& place(const World& world, std::size_t particle) {
    return world.state().position[particle];
}

dvec3 mean_velocity(const World& world) {
    dvec3 sum(0.0);
    for (std::size_t i = 0; i < world.size(); ++i) sum += dvec3(world.velocity(i));
    return sum / static_cast<double>(world.size());
}

LABEL(slow, "RopeDrive.AMovingGroundCarriesBodies");

/// The body accelerates by friction times gravity, up to the speed of the ground.
TEST(RopeDrive, AMovingGroundCarriesBodies) {
    for (const rope::Solver solver : all_solvers) {
        for (const bool cloth : {false, true}) {
            World world = world_with({.solver = solver, .damping = 0.0f, .friction = 0.2f});
            world.add_collider("ground", rope::Plane{});
            allow(world.drive_collider(world.state().colliders[0].id, {.velocity = {3, 5, 0}}));
            lay(world, cloth, {0, cloth ? 0.01 : 0.02, 0});
            const std::string which = std::string(name(solver)) + (cloth ? ", cloth" : ", rope");
            run(world, 0.5);
            EXPECT_NEAR(mean_velocity(world).x, 0.2 * 9.81 * 0.5, 0.15) << which;
            run(world, 3.0);
            EXPECT_NEAR(mean_velocity(world).x, 3.0, 0.05) << which;
            EXPECT_NEAR(mean_velocity(world).y, 0.0, 0.01) << which << ": only along itself";
            EXPECT_EQ(rope::centre(world.state().colliders[0].shape), glm::vec3(0.0f)) << "the plane stays";
            allow(world.drive_collider(world.state().colliders[0].id, {}));
            run(world, 4.0);
            EXPECT_LT(top_speed(world), 0.02) << which;
        }
    }
}

/// A turntable: a rope near its middle rotates with it.
TEST(RopeDrive, ATurntableRotatesARope) {
    World world = world_with({.friction = 1.0f});
    world.add_collider("table", rope::Plane{});
    allow(world.drive_collider(world.state().colliders[0].id, {.spin = 1.0f}));
    lay(world, false, {-0.25, 0.02, 0});
    run(world, 2.0);
    const dvec3 along = place(world, 8) - place(world, 0);
    EXPECT_NEAR(std::atan2(-along.z, along.x), 2.0, 0.15);
    EXPECT_LT(glm::length(0.5 * (place(world, 0) + place(world, 8)) - dvec3(0, 0.02, 0)), 0.03);
}

/// A moving and turning box carries a rope and a cloth that lie on it.
TEST(RopeDrive, ATurningBoxCarries) {
    for (const bool cloth : {false, true}) {
        World world = world_with({.friction = 1.0f});
        world.add_collider("box", rope::Box{{0, 0.5f, 0}, {1, 0.5f, 1}});
        allow(world.drive_collider(world.state().colliders[0].id,
                                   {.velocity = {0.5f, 0.25f, 0}, .spin = 0.8f}));
        lay(world, cloth, {-0.25, cloth ? 1.01 : 1.02, cloth ? -0.25 : 0.0});
        run(world, 2.0);
        const auto& box = std::get<rope::Box>(world.state().colliders[0].shape);
        EXPECT_LT(glm::distance(box.centre, glm::vec3(1.0f, 1.0f, 0)), 1e-3f);
        EXPECT_NEAR(2.0f * std::acos(box.rotation.w), 1.6f, 1e-3f);
        const std::size_t last = cloth ? 7 : 8;
        const dvec3 along = place(world, last) - place(world, 0);
        EXPECT_NEAR(std::atan2(-along.z, along.x), 1.6, 0.1) << cloth;
        for (const dvec3& at : world.state().position) {
            EXPECT_LT(std::hypot(at.x - 1.0, at.z), 0.45) << cloth << ": it has not slid off";
            EXPECT_GT(rope::surface_distance(box, at).distance, (cloth ? 0.01 : 0.02) - 1e-3);
        }
    }
}

/// A capsule that turns pushes a rope out of its way.
TEST(RopeDrive, ABeamSweepsARope) {
    World world = world_with({});
    world.add_collider("beam", rope::Capsule{{-1, 0.5f, 0}, {1, 0.5f, 0}, 0.1f});
    allow(world.drive_collider(world.state().colliders[0].id, {.spin = 1.0f}));
    world.add_rope("rope",
                   {.from = {0.6f, 2, -0.3f}, .to = {0.6f, 0, -0.3f}, .segments = 32, .pin_start = true});
    const rope::Body& rope = *world.find("rope");
    const double before = place(world, rope.first + rope.count - 1).x;
    double deepest = 0.0;
    run_substeps(world, 480, [&] {
        for (std::size_t i = rope.first; i < rope.first + rope.count; ++i)
            deepest = std::min(
                deepest,
                rope::surface_distance(world.state().colliders[0].shape, place(world, i)).distance - 0.02);
    });
    EXPECT_GT(deepest, -2e-3);
    EXPECT_GT(std::abs(place(world, rope.first + rope.count - 1).x - before), 0.1);
}

/// A particle attached to a driven ball rotates with it.
TEST(RopeDrive, RotatesAttachedParticles) {
    World world = world_with({});
    world.add_collider("ball", rope::Sphere{{0, 1, 0}, 0.3f});
    world.add_rope("line", {.from = {0.3f, 1, 0}, .to = {0.3f, 0, 0}, .segments = 8});
    allow(world.rope::World::attach(0, world.state().colliders[0].id));
    allow(world.drive_collider(world.state().colliders[0].id, {.spin = 1.0f}));
    for (int i = 1; i <= 100; ++i) {
        world.advance(1.0 / 90.0);
        const double angle = i / 90.0;
        dvec3 at(0.0);
        world.pose({&at, 1});
        EXPECT_LT(glm::distance(at, dvec3(0.3 * std::cos(angle), 1.0, -0.3 * std::sin(angle))), 1e-4) << i;
    }
}

TEST(RopeDrive, IsPartOfTheStateAndOfThePose) {
    World world = world_with({});
    world.add_collider("box", rope::Box{});
    const rope::ColliderId box = world.state().colliders[0].id;
    allow(world.drive_collider(box, {.velocity = {1, 0, 0}, .axis = {0, 0, 3}, .spin = 2.0f}));
    lay(world, false, {0, 0.6, 0});
    for (int i = 1; i <= 60; ++i) {
        world.advance(1.0 / 144.0);
        const auto shown = std::get<rope::Box>(world.pose(world.state().colliders[0]));
        EXPECT_NEAR(shown.centre.x, i / 144.0, 1e-5);
        EXPECT_NEAR(2.0f * std::asin(shown.rotation.z), 2.0 * i / 144.0, 1e-4);
    }
    World again(world.state());
    run(world, 0.5);
    run(again, 0.5);
    EXPECT_TRUE(same_bits(world.state(), again.state()));
    EXPECT_FALSE(world.drive_collider(box, {.velocity = {2e4f, 0, 0}}));
    EXPECT_FALSE(world.drive_collider({}, {}));
}

}  // namespace
}  // namespace tendril::test
