// Ropes and single colliders: resting on them, starting inside, moved by them, and keeping their lengths.
#include <array>
#include <glm/gtc/quaternion.hpp>

#include "rope_support.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;
using rope::Box;
using rope::Capsule;
using rope::Plane;
using rope::Shape;
using rope::Solver;
using rope::Sphere;

/// The depth of the deepest free particle of any body inside any collider, metres.
double deepest(const World& world) {
    double most = 0.0;
    for (const rope::Body& body : world.state().bodies)
        for (std::size_t i = body.first; i < body.first + body.count; ++i) {
            if (world.pinned(i)) continue;
            for (const rope::Collider& collider : world.state().colliders) {
                const double off = surface_distance(collider.shape, world.state().position[i]).distance;
                most = std::max(most, body.radius - off);
            }
        }
    return most;
}

/// Distance of a point from the axis of a rope, metres.
double nearest_segment(const World& world, const dvec3& point) {
    double least = 1e9;
    for (const rope::Link& link : world.state().links) {
        const dvec3 a = world.state().position[link.a], by = world.state().position[link.b] - a;
        const double t = std::clamp(glm::dot(point - a, by) / glm::dot(by, by), 0.0, 1.0);
        least = std::min(least, glm::length(a + t * by - point));
    }
    return least;
}

struct Still {
    const char* what;
    Shape shape;
};
const Still still_shapes[] = {
    {"sphere", Sphere{{0, 0, 0}, 0.3f}},
    {"capsule", Capsule{{-0.5f, 0, 0}, {0.5f, 0.1f, 0}, 0.2f}},
    {"plane", Plane{{0, 0, 0}, {0.1f, 1, 0}}},
    {"box", Box{{0, 0, 0}, {0.4f, 0.2f, 0.3f}, glm::quat(0.9f, 0.1f, 0.2f, 0.3f)}},
    {"sphere of no size", Sphere{{0, 0, 0}, 0.0f}},
    {"capsule of no length", Capsule{{0, 0, 0}, {0, 0, 0}, 0.2f}},
    {"capsule of no thickness", Capsule{{-0.5f, 0, 0}, {0.5f, 0, 0}, 0.0f}},
    {"box of no size", Box{{0, 0, 0}, {0, 0, 0}, glm::quat(1, 0, 0, 0)}},
    {"box of no thickness", Box{{0, 0, 0}, {0.5f, 0, 0.5f}, glm::quat(1, 0, 0, 0)}},
};

/// Ropes dropped onto a collider, or with the middle inside it and particles on the centre, the axis and the
/// edges; with and without a radius.
TEST(RopeContact, NothingStaysInsideAnyShape) {
    for (const Solver solver : all_solvers)
        for (const Still& still : still_shapes)
            for (const float height : {0.8f, 0.0f})
                for (const float radius : {0.02f, 0.0f}) {
                    World world = world_with({.solver = solver});
                    world.add_collider("it", still.shape);
                    world.add_rope("rope", {.from = {-0.8f, height, 0},
                                            .to = {0.8f, height, 0},
                                            .segments = 20,
                                            .radius = radius});
                    double worst = 0.0;
                    run_substeps(world, 120, [&] { worst = std::max(worst, deepest(world)); });
                    EXPECT_LE(worst, 1e-4)
                        << name(solver) << ' ' << still.what << ' ' << height << ' ' << radius;
                    EXPECT_TRUE(all_finite(world)) << name(solver) << ' ' << still.what;
                }
}

TEST(RopeContact, LiesOnTheGround) {
    for (const Solver solver : all_solvers) {
        World world = world_with({.solver = solver, .damping = 0.5f});
        world.add_collider("ground", Plane{});
        world.add_rope("rope", {.from = {0, 0.3f, 0}, .to = {1, 0.5f, 0}, .segments = 32, .radius = 0.03f});
        run(world, 6.0);
        for (std::size_t i = 0; i < world.size(); ++i) {
            EXPECT_NEAR(world.position(i).y, 0.03, 1e-3) << name(solver);
            EXPECT_LE(glm::length(glm::dvec3(world.velocity(i))), 5e-3) << name(solver);
        }
        // The solver leaves no error; depenetration and friction add only a little.
        EXPECT_LE(world.find("rope")->stretch, 1e-3) << name(solver);
        EXPECT_LE(stretch(world), 5e-3) << name(solver);
    }
}

TEST(RopeContact, DrapesOverASphere) {
    World world = world_with({.damping = 0.5f});
    world.add_collider("ball", Sphere{{0, 0, 0}, 0.4f});
    world.add_rope("rope", {.from = {-1, 0.45f, 0}, .to = {1, 0.45f, 0}, .segments = 64});
    run(world, 8.0);
    EXPECT_LE(deepest(world), 1e-4);
    EXPECT_LE(world.find("rope")->stretch, 1e-3);
    EXPECT_LE(stretch(world), 5e-3);
    EXPECT_NEAR(world.position(32).y, 0.42, 5e-3);           // over the top
    EXPECT_NEAR(std::abs(world.position(0).x), 0.42, 0.05);  // hanging down on both sides
    EXPECT_NEAR(std::abs(world.position(64).x), 0.42, 0.05);
}

/// Half the sphere's radius per substep: the spec requires a taut rope to be carried up to this speed.
TEST(RopeContact, AFastSphereCarriesATautRope) {
    const float radius = 0.3f;
    for (const Solver solver : all_solvers)
        for (const float speed : {0.05f, 0.25f, 0.5f}) {
            World world = world_with({.solver = solver});
            world.add_rope("rope", pinned_rope({-1, 0, 0}, {1, 0, 0}, 32));
            world.add_collider("ball", Sphere{{0, 0, 2.0f}, radius});
            const double h = world.settings().substep;
            const int steps = static_cast<int>(std::lround(2.6 / static_cast<double>(speed * radius)));
            world.move_collider("ball", {0, 0, 2.0f - speed * radius * static_cast<float>(steps)}, h * steps);
            double worst = 0.0;
            bool through = false;
            run_substeps(world, steps + 60, [&] {
                worst = std::max(worst, deepest(world));
                const double z = centre(world.find_collider("ball")->shape).z;
                through = through || (z < -0.35 && world.state().position[16].z > z);
            });
            EXPECT_FALSE(through) << name(solver) << ' ' << speed;
            EXPECT_LE(worst, 3e-4) << name(solver) << ' ' << speed;
            EXPECT_TRUE(all_finite(world));
        }
}

/// A loose rope is also carried along.
TEST(RopeContact, AFastSphereCarriesALooseRope) {
    World world = world_with({.gravity = {0, 0, 0}});
    world.add_rope("rope", {.from = {-0.5f, 0, 0}, .to = {0.5f, 0, 0}, .segments = 32});
    world.add_collider("ball", Sphere{{0, 0, 1.0f}, 0.2f});
    world.move_collider("ball", {0, 0, -3.0f}, 40.0 / 240.0);  // 0.1 m per substep
    run_substeps(world, 40, [] {});
    EXPECT_LE(world.position(16).z, -3.2f + 1e-3f);
    EXPECT_LE(deepest(world), 2e-4);
}

/// Smaller than a segment: the whole segment is kept out, not only its two particles.
TEST(RopeContact, ASmallSphereDoesNotSlipThroughASegment) {
    for (const Solver solver : all_solvers)
        for (const float radius : {0.1f, 0.04f, 0.0f})
            for (const float aside : {0.0f, 0.1f, 0.2f}) {
                World world = world_with({.solver = solver});
                world.add_rope("rope", pinned_rope({-1, 0, 0}, {1, 0, 0}, 4, 2.2f));
                run(world, 0.5);
                const float low = static_cast<float>(lowest(world));
                // Up from below, between particles 2 and 3 (or onto the middle).
                world.add_collider("ball", Sphere{{aside, low - 0.5f, 0}, radius});
                world.move_collider("ball", {aside, low + 0.2f, 0}, 1.0);
                double nearest = 1e9;
                run_substeps(world, 300, [&] {
                    nearest = std::min(
                        nearest, nearest_segment(world, dvec3(centre(world.find_collider("ball")->shape))));
                });
                // Relaxation gives way a little: the neighbouring segments pull back.
                const double asked = static_cast<double>(radius) + 0.02;
                EXPECT_GE(nearest, asked - 0.15 * asked) << name(solver) << ' ' << radius << ' ' << aside;
                EXPECT_GT(world.position(2).y, low) << name(solver) << ' ' << radius << ' ' << aside;
            }
}

/// The same for a thin rod and a thin plank, which could slip between particles.
TEST(RopeContact, ASegmentHangsOverAThinRod) {
    const Shape thin[] = {Capsule{{0.05f, 0, -1}, {0.05f, 0, 1}, 0.02f},
                          Box{{0.05f, 0, 0}, {0.02f, 0.02f, 1.0f}, glm::quat(1, 0, 0, 0)}};
    for (const Shape& shape : thin) {
        World world = world_with({.damping = 1.0f, .friction = 5.0f});
        world.add_collider("rod", shape);
        world.add_rope("rope", {.from = {-1, 0.1f, 0}, .to = {1, 0.1f, 0}, .segments = 5});
        run(world, 4.0);
        double highest = -1e9;
        for (std::size_t i = 0; i < world.size(); ++i)
            highest = std::max(highest, world.state().position[i].y);
        EXPECT_GT(highest, -0.4) << kind(shape);  // still hanging there
    }
}

/// A fast rope that passes a ball, or the end of a long slanted bar, must not be stopped, even if it crosses
/// the bounding box.
TEST(RopeContact, AThrownRopeFliesPast) {
    const struct {
        Shape shape;
        glm::vec3 from;
        dvec3 velocity;
        int substeps, iterations;
    } cases[] = {{Sphere{{0, 0, 0}, 0.1f}, {0.1f, 0.9f, 0.1f}, {0, -144, 0}, 3, 16},
                 {Sphere{{0, 0, 0}, 0.1f}, {0.1f, 0.5f, 0.1f}, {0, -144, 0}, 3, 16},
                 {Capsule{{-1, -1, 0}, {1, 1, 0}, 0.02f}, {1.4f, 1.3f, 0}, {-120, -264, 0}, 1, 1},
                 {Capsule{{-1, -1, 0}, {1, 1, 0}, 0.02f}, {1.4f, 1.3f, 0}, {-120, -264, 0}, 1, 2},
                 {Capsule{{-1, -1, 0}, {1, 1, 0}, 0.02f}, {1.4f, 1.3f, 0}, {-120, -264, 0}, 1, 16}};
    for (const auto& [shape, from, velocity, substeps, iterations] : cases) {
        std::array<World, 2> worlds;
        for (World& world : worlds) {
            world = world_with({.iterations = iterations, .gravity = {0, 0, 0}});
            world.add_rope("rope", {.from = from, .to = from + glm::vec3(0, 0, 0.04f), .segments = 4});
            if (&world == &worlds[1]) world.add_collider("it", shape);
            throw_all(world, [thrown = velocity](std::size_t) { return thrown; });
            run_substeps(world, substeps, [] {});
        }
        for (std::size_t i = 0; i < worlds[0].size(); ++i)
            EXPECT_LE(glm::length(worlds[0].state().position[i] - worlds[1].state().position[i]), 1e-9)
                << kind(shape) << ' ' << iterations << ", " << i;
        EXPECT_LT(worlds[1].state().position[4].y, 0.5);
    }
}

/// A fast rope is stopped on the side that it came from, by a thin rod too, and whichever of them moves.
TEST(RopeContact, AThrownRopeDoesNotFlyThrough) {
    const Shape shapes[] = {Sphere{{0, 0, 0}, 0.3f}, Capsule{{0, 0, -1}, {0, 0, 1}, 0.003f},
                            Capsule{{0, 0, -1}, {0, 0, 1}, 0.01f}, Box{{0, 0, 0}, {0.003f, 0.003f, 1.0f}}};
    for (const Shape& shape : shapes)
        for (const double speed : {3.0, 10.0, 30.0})
            for (int k = 0; k < 10; ++k) {
                const double half = static_cast<double>(size(shape));
                const float aside = 0.014f * static_cast<float>(k % 5), above = size(shape) + 0.05f + aside;
                World world = world_with({.gravity = {0, 0, 0}});
                world.add_collider("it", shape);
                world.add_rope("rope", {.from = {aside - 0.5f, above, 0},
                                        .to = {aside + 0.5f, above, 0},
                                        .segments = 16,
                                        .radius = 0.01f,
                                        .density = 0.1f});
                throw_all(world, [&](std::size_t) { return dvec3(0, k < 5 ? -speed : 0.0, 0); });
                rope::State state = world.state();
                if (k >= 5) state.colliders[0].drive.velocity = {0, static_cast<float>(speed), 0};
                world = World(state);
                double lowest = 1.0;
                run_substeps(world, static_cast<int>(84.0 / speed), [&] {
                    const double middle(centre(world.state().colliders[0].shape).y);
                    for (std::size_t i = 0; i < 16; ++i) {
                        const dvec3 a = world.state().position[i], b = world.state().position[i + 1];
                        if (a.x <= 0.0 && b.x > 0.0)
                            lowest = std::min(lowest, a.y - a.x / (b.x - a.x) * (b.y - a.y) - middle);
                    }
                });
                EXPECT_GE(lowest, half) << kind(shape) << ' ' << half << ", " << speed << " m/s, " << k;
            }
}

}  // namespace
}  // namespace tendril::test
