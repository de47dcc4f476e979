// Coulomb's law, and the capstan equation (Euler-Eytelwein) for a rope around a post.
#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;
using rope::Capsule;
using rope::Plane;
using rope::Solver;

/// Puts a rope on a slope of `angle` radians; returns how far it slides in `seconds`.
double slides(Solver solver, float friction, double angle, double seconds, bool across = false) {
    World world = world_with({.solver = solver, .damping = 0.0f, .friction = friction});
    const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
    const glm::vec3 up{-s, c, 0}, along = across ? glm::vec3(0, 0, 1) : glm::vec3(c, s, 0);
    world.add_collider("slope", Plane{{0, 0, 0}, up});
    const glm::vec3 from = 0.02f * up;
    world.add_rope("rope", {.from = from, .to = from + along, .segments = 16});
    const glm::vec3 start = world.position(8);
    run(world, seconds);
    return distance(world.position(8), start);
}

TEST(RopeFriction, HoldsOnASlopeUpToItsTangent) {
    for (const Solver solver : all_solvers)
        for (const bool across : {false, true})
            for (const float friction : {0.2f, 0.5f, 1.0f}) {
                const double angle = std::atan(static_cast<double>(friction));
                EXPECT_LE(slides(solver, friction, angle - 0.02, 2.0, across), 0.002)
                    << name(solver) << ' ' << friction;
            }
}

/// Beyond that angle, it slides with the rest of its weight: g (sin - mu cos) t^2 / 2.
TEST(RopeFriction, SlidesBeyondTheTangent) {
    for (const Solver solver : all_solvers)
        for (const bool across : {false, true})
            for (const float friction : {0.0f, 0.2f, 0.5f}) {
                const double angle = std::atan(static_cast<double>(friction)) + 0.1;
                const double expected = 0.5 * 9.81 * (std::sin(angle) - friction * std::cos(angle));
                EXPECT_NEAR(slides(solver, friction, angle, 1.0, across) / expected, 1.0, 0.03)
                    << name(solver) << ' ' << friction << (across ? " across" : " along");
            }
}

/// A stiff stick on two bars, where links touch between their ends and slide over them.
TEST(RopeFriction, AStickOnTwoBarsObeysCoulomb) {
    for (const int segments : {1, 2, 4, 16})
        for (const float friction : {0.1f, 0.3f, 0.8f})
            for (const double beyond : {-0.02, 0.1}) {
                const double angle = std::atan(static_cast<double>(friction)) + beyond;
                const glm::vec3 down(std::sin(angle), std::cos(angle), 0);
                World world = world_with({.damping = 0.0f, .gravity = -9.81f * down, .friction = friction});
                for (const float x : {-0.45f, 0.4f})
                    world.add_collider(x < 0 ? "lower" : "upper",
                                       Capsule{{x, -0.05f, -1}, {x, -0.05f, 1}, 0.03f});
                world.add_rope(
                    "stick", {.from = {-1, 0, 0}, .to = {1, 0, 0}, .segments = segments, .bending = 1000.0f});
                const double before = world.energy(), mu = static_cast<double>(friction);
                const double expected = 0.5 * 0.25 * 9.81 * (std::sin(angle) - mu * std::cos(angle));
                run(world, 0.5);
                EXPECT_NEAR(-1.0 - world.state().position[0].x, std::max(0.0, expected),
                            beyond < 0.0 ? 1e-4 : 0.1 * expected)
                    << segments << ' ' << friction;
                EXPECT_LT(world.energy() - before, 1e-3 * weight(world)) << segments << ' ' << friction;
            }
}

/// A rope sliding on level ground stops after v^2 / (2 mu g).
TEST(RopeFriction, ASlidingRopeStops) {
    for (const Solver solver : all_solvers) {
        World world = world_with({.solver = solver, .damping = 0.0f, .friction = 0.4f});
        world.add_collider("ground", Plane{});
        world.add_rope("rope", {.from = {0, 0.02f, 0}, .to = {1, 0.02f, 0}, .segments = 16});
        throw_all(world, [](std::size_t) { return glm::dvec3(2, 0, 0); });
        run(world, 2.0);
        EXPECT_NEAR((world.position(0).x) / (4.0 / (2.0 * 0.4 * 9.81)), 1.0, 0.03) << name(solver);
    }
}

/// A moving collider carries a body as far as friction allows; without friction, not at all.
TEST(RopeFriction, AMovingColliderCarriesARope) {
    for (const float friction : {0.8f, 0.0f}) {
        World world = world_with({.damping = 0.0f, .friction = friction});
        world.add_collider("plank", rope::Box{{0, -0.1f, 0}, {2, 0.1f, 1}, {1, 0, 0, 0}});
        world.add_rope("rope", {.from = {-0.5f, 0.02f, 0}, .to = {0.5f, 0.02f, 0}, .segments = 16});
        run(world, 0.25);
        world.move_collider("plank", {1.0f, -0.1f, 0}, 1.0);
        run(world, 1.0);
        // The plank moves at 1 m/s at once: until the rope is as fast, it slips by v^2 / (2 mu g).
        const double carried = friction > 0.0f ? 1.0 - 1.0 / (2.0 * 0.8 * 9.81) : 0.0;
        EXPECT_NEAR(world.position(8).x, carried, 0.01) << friction;
    }
}

/// The maximum ratio of rope on both sides of a post of radius r, two metres in all, before it runs:
/// Euler-Eytelwein's e^(mu pi), where the weight of the rope on the post adds pressure. T' = rho g r cos + mu
/// (T + rho g r sin) around it, so long = (short + k) e^(mu pi) + k, k = 2 mu r / (1 + mu^2)
double max_ratio(double friction, double r) {
    const double euler = std::exp(friction * pi), k = 2.0 * friction * r / (1.0 + friction * friction);
    const double shorter = (2.0 - k - k * euler) / (1.0 + euler);
    return (2.0 - shorter) / shorter;
}

/// Hangs two metres over a level post, `ratio` times as much on one side. Returns how far it has run.
double runs_off(Solver solver, float friction, double ratio, int segments, double seconds) {
    World world = world_with({.iterations = 64, .solver = solver, .damping = 0.3f, .friction = friction});
    const float radius = 0.08f;
    world.add_collider("post", Capsule{{0, 0, -1}, {0, 0, 1}, radius});
    // Around the upper half at the rope's radius, straight down on both sides.
    const double r = 0.1, hanging = 2.0, round = pi * r, left = hanging / (1.0 + ratio);
    world.add_rope("rope", {.from = {0, 0, 0},
                            .to = {1, 0, 0},
                            .segments = segments,
                            .length = static_cast<float>(hanging + round),
                            .radius = 0.02f});
    rope::State state = world.state();
    for (int i = 0; i <= segments; ++i) {
        const double at = (hanging + round) * i / segments;
        glm::dvec3& p = state.position[static_cast<std::size_t>(i)];
        if (at < left) {
            p = {-r, at - left, 0};
        } else if (at < left + round) {
            const double angle = (at - left) / r;
            p = {-r * std::cos(angle), r * std::sin(angle), 0};
        } else {
            p = {r, left + round - at, 0};
        }
    }
    world = World(state);
    const double start = world.state().position[0].y;
    run(world, seconds);
    return world.state().position[0].y - start;
}

/// The rope first settles by a few millimetres: its curve becomes a polygon, which vibrates.
TEST(RopeFriction, APostHoldsUpToEulersRatio) {
    for (const float friction : {0.1f, 0.2f, 0.3f, 0.5f}) {
        const double holds = max_ratio(0.95 * friction, 0.1), slips = max_ratio(1.05 * friction, 0.1);
        EXPECT_LE(std::abs(runs_off(Solver::Direct, friction, holds, 128, 2.0)), 0.012)
            << friction << ' ' << holds;
        EXPECT_GE(std::abs(runs_off(Solver::Direct, friction, slips, 128, 2.0)), 0.05)
            << friction << ' ' << slips;
    }
}

TEST(RopeFriction, WithoutFrictionItRunsOff) {
    EXPECT_GE(runs_off(Solver::Direct, 0.0f, 1.2, 128, 1.0), 0.3);
}

/// A body with its own friction stays where the settings' friction would let it slide, with every solver.
TEST(RopeFriction, ABodyMayHaveItsOwnFriction) {
    for (const Solver solver : all_solvers) {
        World world = world_with({.solver = solver, .damping = 0.0f, .friction = 0.1f});
        const float c = std::cos(0.3f), s = std::sin(0.3f);
        const glm::vec3 up{-s, c, 0}, along(c, s, 0);
        world.add_collider("slope", Plane{{0, 0, 0}, up});
        for (const auto& [name, z] : {std::pair{"slides", 0.0f}, {"stays", 1.0f}}) {
            const glm::vec3 from = 0.02f * up + glm::vec3(0, 0, z);
            world.add_rope(name, {.from = from, .to = from + along, .segments = 16});
        }
        for (const auto& [name, z] : {std::pair{"cloth slides", 2.0f}, {"cloth stays", 4.0f}})
            world.add_cloth(name, square_cloth(0.01f * up + glm::vec3(0, 0, z), along, {0, 0, 1}, 6));
        allow(world.set_friction(world.id("stays"), 0.6f));
        allow(world.set_friction(world.id("cloth stays"), 0.6f));
        const auto middle = [&](const char* name) { return world.position(world.particle(name, 8)); };
        const glm::vec3 rope = middle("stays"), cloth = middle("cloth stays"), other = middle("slides"),
                        sheet = middle("cloth slides");
        EXPECT_TRUE(same_bits(World(world.state()).state(), world.state()));
        run(world, 1.0);
        EXPECT_LT(distance(middle("stays"), rope), 0.002) << name(solver);
        EXPECT_LT(distance(middle("cloth stays"), cloth), 0.02) << name(solver);
        EXPECT_GT(distance(middle("slides"), other), 0.5) << name(solver);
        EXPECT_GT(distance(middle("cloth slides"), sheet), 0.5) << name(solver);
        EXPECT_FALSE(world.set_friction(world.id("stays"), -1.0f));
        EXPECT_FALSE(world.set_friction(world.id("stays"), 101.0f));
        EXPECT_FALSE(world.set_friction({}, 0.5f));
        allow(world.set_friction(world.id("stays"), std::nullopt));
        run(world, 1.0);
        EXPECT_GT(distance(middle("stays"), rope), 0.5) << name(solver);
    }
}

// Driven grounds and boxes: friction carries the bodies on them.

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
