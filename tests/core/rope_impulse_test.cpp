// The impulses that bodies give colliders, for the engine whose bodies they are.
#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using rope::Solver;

/// Sums the impulses on a collider while time passes.
struct Felt {
    glm::dvec3 linear{0.0}, angular{0.0};

    void add(rope::ColliderId collider, const rope::Advance& done) {
        for (const rope::ColliderImpulse& each : done.impulses)
            if (each.collider == collider) linear += each.linear, angular += each.angular;
    }
};
/// The mean force and torque on a collider over `seconds`.
Felt force_on(World& world, const char* collider, double seconds) {
    Felt felt;
    const double frame = 1.0 / 60.0;
    const int frames = static_cast<int>(std::lround(seconds / frame));
    for (int i = 0; i < frames; ++i) felt.add(world.find_collider(collider)->id, world.advance(frame));
    return {felt.linear / (frame * frames), felt.angular / (frame * frames)};
}

/// A rope, a cloth, two tied ropes, or a cloth tied to a rope, above the ground or a box.
World resting_on(int kind, Solver solver, bool box) {
    World world = world_with({.solver = solver, .damping = 2.0f, .friction = 0.5f});
    if (box)
        world.add_collider("ground", rope::Box{{0, -0.5f, 0}, {2, 0.5f, 2}});
    else
        world.add_collider("ground", rope::Plane{});
    if (kind == 1 || kind == 3)
        world.add_cloth("cloth", square_cloth({0, 0.05f, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}, 8));
    else
        world.add_rope(
            "a",
            {.from = {0, 0.05f, 0}, .to = {1, 0.05f, 0}, .segments = 12, .bending = kind == 4 ? 0.1f : 0.0f});
    if (kind == 2 || kind == 3)
        world.add_rope("b", {.from = {0, 0.05f, 0}, .to = {-0.6f, 0.05f, 0}, .segments = 9});
    if (kind == 2 || kind == 3) allowed(world.core().tie(0, world.find("b")->first));
    return world;
}

TEST(RopeImpulse, EqualsTheWeightAtRest) {
    for (const Solver solver : all_solvers)
        for (const bool box : {false, true})
            for (int kind = 0; kind < 5; ++kind) {
                World world = resting_on(kind, solver, box);
                run(world, 3.0);
                const Felt felt = force_on(world, "ground", 1.0);
                EXPECT_NEAR(felt.linear.y / weight(world), -1.0, 0.01) << name(solver) << ' ' << kind << box;
                EXPECT_LT(std::hypot(felt.linear.x, felt.linear.z), 0.01 * weight(world))
                    << name(solver) << ' ' << kind << box;
            }
}

/// A rope hangs over a bar, a longer side on the left: its weight turns the bar by its lever.
TEST(RopeImpulse, TurnsABarByItsLever) {
    World world = world_with({.damping = 2.0f, .friction = 2.0f});
    world.add_collider("bar", rope::Capsule{{0, 0, -1}, {0, 0, 1}, 0.1f});
    world.add_rope("rope", {.from = {-0.9f, 0.12f, 0}, .to = {0.7f, 0.12f, 0}, .segments = 64});
    run(world, 5.0);
    const Felt felt = force_on(world, "bar", 1.0);
    double torque = 0.0;
    for (std::size_t i = 0; i < world.size(); ++i)
        torque -= 9.81 * world.state().mass[i] * world.state().position[i].x;
    EXPECT_NEAR(felt.linear.y / weight(world), -1.0, 0.01);
    EXPECT_GT(torque, 0.01 * weight(world));
    EXPECT_NEAR(felt.angular.z / torque, 1.0, 0.03);
}

/// Thrown at a collider, without gravity, bodies give it the momentum that they lose. Cloth tied to a rope,
/// which the bound on energy slows, falls too: then it gives what it loses within a quarter.
TEST(RopeImpulse, IsTheMomentumThatBodiesLose) {
    for (const Solver solver : all_solvers)
        for (int kind = 0; kind < 5; ++kind)
            for (const bool ball : {false, true}) {
                World world = resting_on(kind, solver, true);
                const glm::vec3 gravity(0, kind == 3 ? -9.81f : 0.0f, 0);
                world.set_settings({.solver = solver, .damping = 0.0f, .gravity = gravity, .friction = 0.5f});
                world.remove_collider("ground");
                if (ball)
                    world.add_collider("ground", rope::Sphere{{0.3f, -0.4f, 0.2f}, 0.3f});
                else
                    world.add_collider("ground", rope::Plane{});
                throw_all(world, [](std::size_t) { return glm::dvec3(0.5, -2.0, 0.2); });
                Felt felt;
                const glm::dvec3 before = momentum(world);
                for (int i = 0; i < 60; ++i)
                    felt.add(world.state().colliders[0].id, world.advance(1.0 / 60.0));
                const glm::dvec3 fall = weight(world) / 9.81 * glm::dvec3(gravity);
                const glm::dvec3 lost = before + fall - momentum(world);
                EXPECT_GT(glm::length(lost), 0.1 * glm::length(before)) << name(solver) << kind << ball;
                EXPECT_LT(glm::distance(felt.linear, lost), (kind == 3 ? 0.25 : 0.02) * glm::length(lost))
                    << name(solver) << ' ' << kind << ball;
            }
}

/// A limp rope that hangs from a ball, and a stiff one that the ball clamps.
TEST(RopeImpulse, EqualsTheWeightOfARopeThatHangsFromACollider) {
    for (const float bending : {0.0f, 0.05f})
        for (const Solver solver : all_solvers) {
            World world = world_with({.solver = solver, .damping = 2.0f});
            world.add_collider("ball", rope::Sphere{{0, 1, 0}, 0.05f});
            world.add_rope("rope",
                           {.from = {0.1f, 1, 0}, .to = {0.6f, 0.4f, 0}, .segments = 16, .bending = bending});
            allow(world.core().attach(0, world.find_collider("ball")->id));
            if (bending > 0.0f) allow(world.core().attach(1, world.find_collider("ball")->id));
            run(world, 10.0);
            const Felt felt = force_on(world, "ball", 1.0);
            EXPECT_NEAR(felt.linear.y / weight(world), -1.0, 0.01) << name(solver) << bending;
            if (bending > 0.0f) continue;
            EXPECT_NEAR(felt.angular.z / (0.1 * weight(world)), -1.0, 0.02) << name(solver);
        }
}

LABEL(slow, "RopeImpulse.OnAllThatHoldABodySumsToItsWeight");
LABEL(slow, "RopeImpulse.EqualsTheWeightAtRest");

/// Held by colliders alone, a body at rest pulls and presses them by its weight: a rope over thin bars, which
/// touch it between its particles, in a groove, and squeezed between a ball and the ground.
TEST(RopeImpulse, OnAllThatHoldABodySumsToItsWeight) {
    for (const Solver solver : all_solvers)
        for (const int bars : {0, 1, 2, 3, 4}) {
            World world = world_with({.solver = solver, .damping = 3.0f, .friction = 0.3f});
            world.add_collider("left", rope::Sphere{{-0.6f, 1, 0}, 0.01f});
            world.add_collider("right", rope::Sphere{{0.6f, 1, 0}, 0.01f});
            world.add_rope("rope",
                           {.from = {-0.5f, 1, 0}, .to = {0.5f, 1, 0}, .segments = 16, .length = 1.3f});
            allow(world.core().attach(0, world.find_collider("left")->id));
            allow(world.core().attach(16, world.find_collider("right")->id));
            if (bars == 1 || bars == 2)
                for (const float x : {-0.12f, 0.17f}) {
                    const float radius = bars == 1 ? 0.005f : 0.2f;
                    const rope::Capsule bar{{x, 0.2f, -1}, {x, 0.2f, 1}, radius};
                    const rope::ColliderId lifted = allowed(world.core().add_collider(bar));
                    allow(world.core().move_collider(lifted, {x, 0.8f, 0}, 2.0));
                }
            if (bars == 3)  // a groove
                for (const float x : {-1.0f, 1.0f})
                    allow(world.core().add_collider(rope::Plane{{0, 0.6f, 0}, {x, 1.5f, 0}}).error());
            if (bars == 4) {
                allow(world.core().add_collider(rope::Plane{{0, 0.7f, 0}, {0, 1, 0}}).error());
                allow(world.core().add_collider(rope::Sphere{{0, 0.83f, 0}, 0.12f}).error());
            }
            if (bars == 4 && solver != Solver::Direct) continue;  // it never rests there
            run(world, 10.0);
            glm::dvec3 sum(0.0);
            for (int i = 0; i < 60; ++i)
                for (const rope::ColliderImpulse& each : world.advance(1.0 / 60.0).impulses)
                    sum += each.linear;
            EXPECT_NEAR(sum.y / weight(world), -1.0, 0.02) << name(solver) << ' ' << bars;
            EXPECT_LT(std::hypot(sum.x, sum.z), 0.02 * weight(world)) << name(solver) << ' ' << bars;
        }
}

/// Of two planes that meet in a groove each bears half.
TEST(RopeImpulse, IsSharedByTheSidesOfAGroove) {
    for (const Solver solver : all_solvers) {
        World world = world_with({.solver = solver, .damping = 3.0f, .friction = 0.0f});
        for (const float x : {-0.577f, 0.577f})
            world.add_collider(x < 0 ? "right" : "left", rope::Plane{{0, 0, 0}, {x, 1, 0}});
        world.add_rope("rope", {.from = {0, 0.05f, -0.5f}, .to = {0, 0.05f, 0.5f}, .segments = 12});
        run(world, 5.0);
        World copy = world;
        const Felt right = force_on(world, "right", 1.0), left = force_on(copy, "left", 1.0);
        EXPECT_NEAR(right.linear.y / weight(world), -0.5, 0.02) << name(solver);
        EXPECT_NEAR(left.linear.y / weight(world), -0.5, 0.02) << name(solver);
    }
}

/// A ball that an engine simulates falls on a rope bridge and comes to rest there.
TEST(RopeImpulse, LetsABallRestOnABridge) {
    World world = world_with({.damping = 1.0f, .compliance = 1e-4f});
    hang_between(world, 1.0f, 1.1f, 32);
    const double mass = 0.5, frame = 1.0 / 240.0;
    glm::dvec3 at(0.5, 0.1, 0.0), velocity(0.0);
    world.add_collider("ball", rope::Sphere{glm::vec3(at), 0.08f});
    for (int i = 0; i < 240 * 10; ++i) {
        Felt felt;
        felt.add(world.find_collider("ball")->id, world.advance(frame));
        velocity += felt.linear / mass + glm::dvec3(0.0, -9.81 * frame, 0.0);
        velocity *= glm::dvec3(0.995, 0.995, 0.0);  // else it would roll off to the side
        at += frame * velocity;
        world.move_collider("ball", glm::vec3(at), frame);
    }
    EXPECT_LT(glm::length(velocity), 1e-3);
    EXPECT_NEAR(at.y, -0.121, 0.001);
    EXPECT_NEAR(force_on(world, "ball", 1.0).linear.y, 9.81 * mass, 0.01 * 9.81 * mass);
}

/// Threads take islands in any order, and the sums are the same.
TEST(RopeImpulse, IsTheSameOnAnyNumberOfThreads) {
    World start = world_with({.friction = 0.5f});
    start.add_collider("ground", rope::Plane{});
    start.add_collider("ball", rope::Sphere{{0.5f, 0, 1}, 0.3f});
    for (int i = 0; i < 40; ++i) {
        const float z = 0.05f * static_cast<float>(i);
        start.add_rope({.from = {0, 0.1f, z}, .to = {1, 0.1f + 0.01f * z, z}, .segments = 64});
    }
    std::vector<std::vector<rope::ColliderImpulse>> seen;
    for (const int threads : {1, 2, 3}) {
        rope::World world = start;
        rope::Workspace workspace;
        allow(workspace.use_threads(threads));
        seen.emplace_back();
        for (int i = 0; i < 20; ++i) {
            const auto impulses = world.advance(1.0 / 60.0, workspace, {.impulses = true}).impulses;
            seen.back().insert(seen.back().end(), impulses.begin(), impulses.end());
        }
        EXPECT_EQ(seen.back(), seen.front()) << threads;
    }
    EXPECT_GT(seen.front().size(), 20u);
}

TEST(RopeImpulse, IsNotReportedWhereNothingTouches) {
    World world;
    world.add_collider("far", rope::Sphere{{5, 0, 0}, 0.3f});
    world.add_rope("rope", {.from = {0, 1, 0}, .to = {1, 1, 0}});
    EXPECT_TRUE(world.advance(0.1).impulses.empty());
    world.add_collider("ground", rope::Plane{{0, 0.97f, 0}, {0, 1, 0}});
    EXPECT_EQ(world.advance(0.1).impulses.size(), 1u);
    EXPECT_TRUE(world.advance(0.0).impulses.empty());
}

}  // namespace
}  // namespace tendril::test
