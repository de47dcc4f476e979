// Ropes that collide with each other and with themselves: they never pass, keep their thickness at rest, and
// gain no energy. Invariants of knots and links, not distances, show whether something passed.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <tendril/rope/edit.hpp>
#include <vector>

#include "random.hpp"
#include "rope_cloth_collision.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;

constexpr float radius = 0.01f;
const char* const below = "rope";  // its name in the test's World
const char* const on_top = "rope 2";

/// A rope with weights at its ends, dropped across another one.
World crossed(int segments, double weight = 1.0) {
    World world;
    world.add_rope(below, pinned_rope({-0.5f, 1, 0}, {0.5f, 1, 0}, segments, 1.05f, radius));
    world.add_rope(on_top, {.from = {0.003f, 1.05f, -0.4f},
                            .to = {0, 1.05f, 0.4f},
                            .segments = segments,
                            .length = 0.8f,
                            .radius = radius});
    collide(world, below, on_top);
    const rope::Body upper = *world.find(on_top);
    rope::State state = world.state();
    state.mass[upper.first] = state.mass[upper.first + upper.count - 1] = weight;
    return World(std::move(state));
}

/// Closes a rope by a detour far up or down.
std::vector<dvec3> closed(std::vector<dvec3> points, double height) {
    const dvec3 first = points.front(), last = points.back();
    points.push_back({last.x, height, last.z});
    points.push_back({first.x, height, first.z});
    points.push_back(first);
    return points;
}
/// The linking number if the lower rope is closed far above and the upper one far below.
int linked(const World& world) {
    return static_cast<int>(std::lround(
        gauss_integral(closed(points_of(world, below), 100), closed(points_of(world, on_top), -100))));
}

void expect_stay_linked(int segments, double seconds, int frames_a_look) {
    World world = crossed(segments);
    const int before = linked(world);
    ASSERT_NE(before, 0);
    std::uint64_t unconverged = 0;
    for (int frame = 0; frame < static_cast<int>(60.0 * seconds); ++frame) {
        unconverged += world.advance(1.0 / 60.0).unconverged;
        if (frame % frames_a_look != 0) continue;
        ASSERT_EQ(linked(world), before) << "frame " << frame;
        ASSERT_LT(world.length_error(), 0.01) << "frame " << frame;
    }
    EXPECT_TRUE(all_finite(world));
    EXPECT_LE(unconverged, static_cast<std::uint64_t>(10.0 * seconds));
    EXPECT_EQ(linked(world), before);
}

TEST(RopeCollision, CrossedRopesUnderTensionNeverPass) {
    expect_stay_linked(64, 60.0, 20);
}

TEST(RopeCollision, CrossedRopesOfManySegmentsNeverPass) {
    expect_stay_linked(1024, 1.0, 30);
}

TEST(RopeCollision, WithoutCollisionTheyPass) {
    World world = crossed(64);
    const int before = linked(world);
    allow(world.set_collides(world.id(below), world.id(on_top), false));
    run(world, 2.0);
    EXPECT_NE(linked(world), before);
    EXPECT_TRUE(world.state().contacts.empty());
}

TEST(RopeCollision, AtRestTheyKeepTheirThickness) {
    World world = crossed(64, 0.2);
    rope::Settings settings = world.settings();
    settings.damping = 2.0f;
    world.set_settings(settings);
    run(world, 10.0);
    EXPECT_LT(top_speed(world), 0.05);
    const double apart = distance_between(world, below, on_top);
    EXPECT_GT(apart, 0.98 * 2 * radius);
    EXPECT_LT(apart, 1.02 * 2 * radius);
    ASSERT_FALSE(world.state().contacts.empty());
    EXPECT_LT(stretch(world, on_top), 1e-3);
    // The contacts carry the upper rope's weight.
    dvec3 force(0.0);
    for (const rope::BodyContact& contact : world.state().contacts) force += contact.force;
    double mass = 0.0;
    const rope::Body& upper = *world.find(on_top);
    for (std::size_t i = upper.first; i < upper.first + upper.count; ++i) mass += world.state().mass[i];
    EXPECT_NEAR(force.y, 9.81 * mass, 0.05 * 9.81 * mass);
}

/// A rope of 3 m with a loose overhand knot, its ends pinned.
World knotted(int segments, float thickness) {
    const auto trefoil = [](double t) {
        return 0.08 *
               dvec3(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t));
    };
    const double opened = 0.15, begin = pi / 3 + opened, end = pi / 3 + 2 * pi - opened;
    const dvec3 out = glm::normalize(trefoil(begin) - trefoil(begin + 0.01)),
                far = glm::normalize(trefoil(end) - trefoil(end - 0.01));
    std::vector<dvec3> path;
    for (int i = 400; i > 0; --i) path.push_back(trefoil(begin) + 0.001 * i * out);
    for (int i = 0; i <= 4000; ++i) path.push_back(trefoil(begin + (end - begin) * i / 4000));
    for (int i = 1; i <= 400; ++i) path.push_back(trefoil(end) + 0.001 * i * far);
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) length += glm::length(path[i + 1] - path[i]);

    World world;
    world.add_rope("rope",
                   pinned_rope({0, 0, 0}, {1, 0, 0}, segments, static_cast<float>(length), thickness));
    rope::State state = world.state();
    state.settings.gravity = {0, 0, 0};
    double along = 0.0;
    std::size_t next = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double step = glm::length(path[i + 1] - path[i]);
        for (; next < state.position.size(); ++next) {
            const double wanted = length * static_cast<double>(next) / segments;
            if (wanted > along + step && i + 2 < path.size()) break;
            state.position[next] = path[i] + (wanted - along) / step * (path[i + 1] - path[i]);
        }
        along += step;
    }
    for (rope::Link& link : state.links)
        link.rest = static_cast<float>(glm::length(state.position[link.b] - state.position[link.a]));
    for (rope::Pin& pin : state.pins) pin.goal = state.position[pin.particle];
    World tied(std::move(state));
    collide(tied, "rope", "rope");
    const dvec3 middle = 0.5 * (tied.core().position(0) + tied.core().position(tied.size() - 1));
    allow(tied.core().pin(0, middle + 0.44 * length * out, 3.0));
    allow(tied.core().pin(tied.size() - 1, middle + 0.44 * length * far, 3.0));
    return tied;
}

TEST(RopeCollision, AKnotPulledTightStaysOne) {
    for (const int segments : {48, 128}) {
        World world = knotted(segments, 0.015f);
        ASSERT_EQ(knot_determinant(points_of(world, "rope")), 3) << segments;
        for (int frame = 0; frame < 600; ++frame) {
            world.advance(1.0 / 60.0);
            ASSERT_EQ(knot_determinant(points_of(world, "rope")), 3) << segments << ", frame " << frame;
        }
        EXPECT_LT(world.length_error(), 1e-3) << segments;
    }
}

TEST(RopeCollision, WithoutCollisionTheKnotComesUndone) {
    World world = knotted(128, 0.015f);
    allow(world.set_collides(world.id("rope"), world.id("rope"), false));
    run(world, 8.0);
    EXPECT_EQ(knot_determinant(points_of(world, "rope")), 1);
}

TEST(RopeCollision, ContactNeverAddsEnergy) {
    for (const int segments : {16, 64}) {
        World world = crossed(segments, 0.3);
        rope::Settings settings = world.settings();
        settings.damping = 0.0f;
        settings.friction = 0.0f;
        world.set_settings(settings);
        const double before = world.energy(), fall = weight(world) * 1.0;
        double highest = before;
        for (int frame = 0; frame < 1200; ++frame) {
            world.advance(1.0 / 60.0);
            highest = std::max(highest, world.energy());
        }
        EXPECT_LT(highest - before, 0.01 * fall) << segments;
    }
}

TEST(RopeCollision, FrictionHoldsARopeOnAnother) {
    const auto slid = [](float friction) {
        World world = crossed(64, 0.2);
        rope::Settings settings = world.settings();
        settings.friction = friction;
        settings.damping = 1.0f;
        world.set_settings(settings);
        run(world, 4.0);
        // Unequal weights: the rope runs over the other one unless friction holds it.
        rope::State state = world.state();
        const rope::Body upper = *world.find(on_top);
        state.mass[upper.first] *= 1.5;
        World uneven(std::move(state));
        run(uneven, 2.0);
        return uneven.position(upper.first).y - uneven.position(upper.first + upper.count - 1).y;
    };
    EXPECT_LT(std::abs(slid(1.0f)), 0.1);
    EXPECT_GT(std::abs(slid(0.0f)), 0.4);
}

/// Groups of ropes that collide within the group.
World groups() {
    World world;
    for (int g = 0; g < 4; ++g) {
        const auto x = 3.0f * static_cast<float>(g);
        const std::string n = std::to_string(g);
        world.add_rope("a" + n, pinned_rope({x - 0.5f, 1, 0}, {x + 0.5f, 1, 0}, 300, 1.1f, radius));
        world.add_rope(
            "b" + n,
            {.from = {x, 1.1f, -0.4f}, .to = {x + 0.01f, 1.1f, 0.4f}, .segments = 300, .radius = radius});
        collide(world, ("a" + n).c_str(), ("b" + n).c_str());
        collide(world, ("b" + n).c_str(), ("b" + n).c_str());
    }
    return world;
}

LABEL(slow, "RopeCollision.ThreadsGiveTheSameBits");
LABEL(slow, "RopeCollision.AKnotPulledTightStaysOne");
LABEL(slow, "RopeCollision.CrossedRopesOfManySegmentsNeverPass");
LABEL(slow, "RopeCollision.CrossedRopesUnderTensionNeverPass");

TEST(RopeCollision, ThreadsGiveTheSameBits) {
    World alone = groups();
    rope::World shared = alone.core();
    run(alone, 0.75);
    ASSERT_FALSE(alone.state().contacts.empty());
    rope::Workspace workspace;
    Jobs jobs;
    jobs.backwards = true;
    allow(workspace.use_threads(3, {run_on_jobs, &jobs}));
    for (int i = 0; i < 3; ++i) shared.advance(0.25, workspace);
    EXPECT_GT(jobs.calls, 0u);
    EXPECT_TRUE(same_bits(alone.state(), shared.state()));
}

TEST(RopeCollision, ContactsDoNotDependOnTheWorkspacesMemory) {
    World world = crossed(48, 0.3);
    collide(world, on_top, on_top);
    rope::World afresh = world.core();
    for (int substep = 0; substep < 480; ++substep) {
        if (substep == 200)
            for (rope::World* each : {&world.core(), &afresh})
                allow(each->set_radius(world.id(on_top), 2.5f * radius));
        rope::Workspace fresh;
        afresh.advance(afresh.settings().substep, fresh);
        world.advance(world.settings().substep);
        ASSERT_TRUE(same_bits(world.state(), afresh.state())) << "substep " << substep;
    }
    EXPECT_FALSE(world.state().contacts.empty());
}

TEST(RopeCollision, EditsKeepThePairs) {
    World world = crossed(16);
    const rope::BodyId lower = world.id(below), upper = world.id(on_top);
    EXPECT_TRUE(world.collides(upper, lower));
    EXPECT_FALSE(world.collides(lower, lower));
    run(world, 0.5);
    const std::string rest = world.cut(on_top, 3);
    EXPECT_TRUE(world.collides(lower, world.id(rest)));
    EXPECT_FALSE(world.collides(upper, world.id(rest)));  // it did not collide with itself before
    world.remove(below);
    EXPECT_TRUE(world.state().collisions.empty());
    EXPECT_TRUE(world.state().contacts.empty());
    EXPECT_TRUE(world.set_collides(upper, upper, true));
    const std::string last = world.cut(on_top, 1);
    EXPECT_TRUE(world.collides(upper, world.id(last)));
    EXPECT_TRUE(rope::World::from_state(world.state()));
    EXPECT_TRUE(world.set_collides(upper, upper, false));
    EXPECT_FALSE(world.collides(upper, upper));
}

TEST(RopeCollision, RefusesBodiesThatCannotCollide) {
    World world = crossed(4);
    const rope::BodyId lower = world.id(below);
    const auto hair = world.core().add_hair({.roots = {{}}});
    ASSERT_TRUE(hair);
    EXPECT_EQ(world.set_collides(lower, *hair, true).code(), ErrorCode::InvalidArgument);
    EXPECT_EQ(world.set_collides(lower, {}, true).code(), ErrorCode::OutOfRange);
    rope::State state = world.state();
    state.collisions.push_back(state.collisions.front());
    EXPECT_FALSE(rope::World::from_state(state));
    state = world.state();
    state.contacts = {{3, 2, dvec3(0.0)}};
    EXPECT_FALSE(rope::World::from_state(state));
}

/// Ropes of a few segments and cloths thrown at each other, some tied, some pinned, any solver, among balls.
World thrown(Random& random) {
    World world;
    rope::Settings settings;
    settings.solver = all_solvers[random.below(3)];
    settings.friction = random.part();
    world.set_settings(settings);
    const auto high = [](std::size_t layer) { return glm::vec3(0, static_cast<float>(layer), 0); };
    const std::size_t ropes = 1 + random.below(3), cloths = random.below(3);
    for (std::size_t r = 0; r < ropes; ++r)
        world.add_rope({.from = random.point(0.5f) + high(r),
                        .to = random.point(0.5f) + glm::vec3(0.3f, 0, 0) + high(r),
                        .segments = static_cast<int>(1 + random.below(12)),
                        .radius = 0.002f + 0.05f * random.part(),
                        .pin_start = random.below(4) == 0,
                        .pin_end = random.below(4) == 0});
    for (std::size_t c = 0; c < cloths; ++c)
        world.add_cloth("cloth " + std::to_string(c),
                        {.corner = random.point(0.3f) + high(ropes + c) - glm::vec3(0.2f, 0.5f, 0.2f),
                         .along = {0.4f, 0.1f * random.part(), 0},
                         .down = {0, 0.1f * random.part(), 0.4f},
                         .columns = static_cast<int>(3 + random.below(4)),
                         .rows = static_cast<int>(3 + random.below(4)),
                         .radius = 0.002f + 0.018f * random.part(),
                         .pins = static_cast<rope::ClothShape::Pins>(random.below(3))});
    if (random.below(2) == 0) world.add_collider("ball", rope::Sphere{{0, -0.5f, 0}, 0.3f});
    if (random.below(2) == 0) world.add_collider("ground", rope::Plane{{0, -1, 0}, {0, 1, 0}});
    for (std::size_t ties = random.below(3); ties > 0; --ties) {
        const std::size_t a = random.below(world.size()), b = random.below(world.size());
        if (a != b) allow(world.core().tie(a, b, {.length = 0.1f}).error());
    }
    const auto& bodies = world.state().bodies;
    for (const rope::Body& a : bodies)
        for (const rope::Body& b : bodies)
            if (a.id.index <= b.id.index) allow(world.core().set_collides(a.id, b.id, true));
    return world;
}

/// Depth of the deepest point in a collider, metres.
double depth(const World& world) {
    double deepest = 0.0;
    const auto& at = world.state().position;
    for (const rope::Body& body : world.state().bodies)
        for (const rope::Link& link : world.state().links)
            for (int i = 0; body.first <= link.a && link.a < body.first + body.count && i <= 10; ++i)
                for (const rope::Collider& collider : world.state().colliders) {
                    const dvec3 point = glm::mix(at[link.a], at[link.b], 0.1 * i);
                    deepest =
                        std::max(deepest, body.radius - surface_distance(collider.shape, point).distance);
                }
    return deepest;
}

void play_thrown(int seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    World world = thrown(random);
    if (pierced(world) != 0) return;
    const auto ropes = [&] {
        std::vector<std::vector<dvec3>> all;
        for (const rope::Body& body : world.state().bodies)
            if (body.kind == rope::Body::Kind::Rope)
                all.push_back(points_of(world, world.name(body).c_str()));
        return all;
    };
    std::vector<std::vector<dvec3>> before = ropes();
    const double energy = world.energy(), all = weight(world), deep = depth(world);
    double lifted = 0.0;
    for (int substep = 0; substep < 240; ++substep) {
        const std::vector<dvec3> were = world.state().position;
        world.advance(world.settings().substep);
        ASSERT_TRUE(all_finite(world)) << "substep " << substep;
        std::vector<std::vector<dvec3>> now = ropes();
        for (std::size_t a = 0; a < now.size(); ++a)
            for (std::size_t b = a + 1; b < now.size(); ++b) {
                // If two segments pass through each other, the integral jumps by one.
                const double change = gauss_integral(now[a], now[b]) - gauss_integral(before[a], before[b]);
                ASSERT_LT(std::abs(change), 0.6) << "substep " << substep;
            }
        before = std::move(now);
        if (substep % 4 == 3) {
            ASSERT_EQ(pierced(world), 0) << "substep " << substep;
        }
        // Closing ties do work.
        if (world.settings().solver != rope::Solver::Direct || !world.state().ties.empty()) continue;
        // Pushing bodies out of each other lifts them without velocity, and turns a short rope like a lever.
        double lift = 0.0;
        const rope::State& state = world.state();
        for (std::size_t i = 0; i < were.size(); ++i)
            lift += 9.81 * state.mass[i] * (state.position[i] - were[i] - state.displacement[i]).y;
        lifted += std::max(lift, 0.0);
        ASSERT_LT(lifted, (0.03 + 2.0 * deep) * all) << "substep " << substep;
        ASSERT_LT(world.energy() - energy - lifted, 0.005 * all) << "substep " << substep;
    }
}

TEST(RopeCollision, NothingPassesInRandomScenes) {
    for (int seed = 0, end = rounds(100); seed < end; ++seed) play_thrown(seed);
    play_thrown(14693);  // turns out of a ball
}

TEST(RopeCollision, ContactsFollowResampledRopes) {
    // The first rope takes no part, and its particles shift the indices of the others.
    World world;
    world.add_rope("first", {.from = {5, 0, 0}, .to = {6, 0, 0}, .segments = 8});
    world.add_rope(below, pinned_rope({-0.5f, 1, 0}, {0.5f, 1, 0}, 16, std::nullopt, radius));
    world.add_rope(
        on_top, {.from = {0.003f, 1.05f, -0.4f}, .to = {0, 1.05f, 0.4f}, .segments = 16, .radius = radius});
    collide(world, below, on_top);
    run(world, 1.0);
    const auto before = world.state().contacts;
    ASSERT_FALSE(before.empty());
    const auto moved = rope::resample(world, world.id("first"), {17, 1});
    ASSERT_TRUE(moved) << moved.error().message();
    const auto& after = moved->world.state().contacts;
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_EQ(after[i].a, before[i].a + 8);
        EXPECT_EQ(after[i].b, before[i].b + 8);
    }
    const auto anew = rope::resample(world, world.id(below), {33, 1});
    ASSERT_TRUE(anew) << anew.error().message();
    EXPECT_TRUE(anew->world.state().contacts.empty());
}

// Chains are sorted by island after collisions are found: a body between two that collide renumbers them.
TEST(RopeCollision, ABodyBetweenTwoOthersInTheListChangesNothing) {
    const auto fallen = [](bool between) {
        World world;
        world.add_rope(below, pinned_rope({-0.5f, 1, 0}, {0.5f, 1, 0}, 24, std::nullopt, radius));
        if (between) world.add_rope("between", {.from = {5, 0, 0}, .to = {6, 0, 0}, .segments = 5});
        world.add_rope(
            on_top,
            {.from = {0.003f, 1.05f, -0.4f}, .to = {0, 1.05f, 0.4f}, .segments = 16, .radius = radius});
        collide(world, below, on_top);
        run(world, 1.0);
        return points_of(world, on_top);
    };
    EXPECT_EQ(fallen(true), fallen(false));
}

}  // namespace
}  // namespace tendril::test
