// Cutting, pinning, attaching, naming and removing: indices follow, and nothing else changes.
#include <array>
#include <limits>

#include "rope_support.hpp"
#include "tendril/rope/quasi_static.hpp"

namespace tendril::test {
namespace {

using rope::Body;
using rope::Sphere;
using rope::State;

World three_ropes() {
    World world;
    for (const char* name : {"a", "b", "c"}) {
        const float x = static_cast<float>(name[0] - 'a');
        world.add_rope(name, {.from = {x, 0, 0},
                              .to = {x, 1, 0},
                              .segments = 4,
                              .pin_start = true,
                              .pin_end = name[0] == 'c'});
    }
    return world;
}

/// Expects a valid world: its state can be loaded.
void expect_valid(const World& world) {
    EXPECT_NO_THROW(World{world.state()});
    for (const rope::Link& link : world.state().links) EXPECT_LT(std::max(link.a, link.b), world.size());
}

TEST(RopeEdit, CutSplitsARope) {
    World world = three_ropes();
    EXPECT_EQ(world.cut("b", 1), "b 2");
    const Body *first = world.find("b"), *second = world.find("b 2");
    ASSERT_TRUE(first != nullptr && second != nullptr);
    EXPECT_EQ(first->count, 2u);
    EXPECT_EQ(second->count, 3u);
    EXPECT_EQ(second->first, first->first + 2);
    EXPECT_EQ(world.size(), 15u);
    EXPECT_EQ(world.state().links.size(), 11u);
    EXPECT_NEAR(world.length(*first), 0.25, 1e-6);
    EXPECT_NEAR(world.length(*second), 0.5, 1e-6);
    EXPECT_EQ(world.find("c")->first, 10u);
    expect_valid(world);
    // The unpinned part falls; the rest still hangs.
    run(world, 0.5);
    EXPECT_NEAR(world.position(world.particle("b", 0)).y, 0.0, 1e-6);
    EXPECT_LT(world.position(world.particle("b 2", 1)).y, -0.3f);
    EXPECT_EQ(world.cut("b 2", 0), "b 2 2");
    EXPECT_EQ(world.cut("b", 0), "b 3");    // the first free name
    EXPECT_EQ(world.find("b")->count, 1u);  // a single particle is still a rope
    EXPECT_EQ(world.length(*world.find("b")), 0.0);
    run(world, 0.5);
    EXPECT_TRUE(all_finite(world));
    expect_valid(world);
}

/// The whole rope hangs on its pin; after a cut, only the remaining part.
TEST(RopeEdit, ACutUpdatesTheTension) {
    World world = world_with({.damping = 2.0f});
    world.add_rope("rope", {.from = {0, 0, 0}, .to = {0, -1, 0}, .segments = 10, .pin_start = true});
    run(world, 2.0);
    EXPECT_NEAR(world.state().links[0].tension, 0.95 * 9.81, 0.01);
    world.cut("rope", 4);
    run(world, 4.0);
    EXPECT_NEAR(world.state().links[0].tension, 0.4 * 9.81, 0.01);
}

TEST(RopeEdit, RemovingRenumbers) {
    World world = three_ropes();
    world.add_collider("ball", Sphere{{5, 0, 0}, 0.1f});
    world.attach(world.particle("c", 2), "ball");
    const State before = world.state();
    world.remove("b");
    EXPECT_EQ(world.size(), 10u);
    EXPECT_EQ(world.find("b"), nullptr);
    EXPECT_EQ(world.find("c")->first, 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(world.state().position[i], before.position[i]);
        EXPECT_EQ(world.state().position[5 + i], before.position[10 + i]);
    }
    EXPECT_TRUE(world.pinned(0) && world.pinned(5) && world.pinned(7) && world.pinned(9));
    EXPECT_EQ(world.state().pins.size(), 4u);
    EXPECT_EQ(world.state().pins[2].collider, world.collider_id("ball"));
    expect_valid(world);
    run(world, 0.25);
    EXPECT_LE(stretch(world, "c"), 1e-3);
    world.remove("a"), world.remove("c");
    EXPECT_EQ(world.size(), 0u);
    EXPECT_TRUE(world.state().links.empty() && world.state().pins.empty() && world.state().bodies.empty());
}

/// A rope moves as if the removed ropes had never existed; only its slot differs.
TEST(RopeEdit, RemovedBodiesLeaveNoTrace) {
    World with = three_ropes(), without;
    without.add_rope("c", pinned_rope({2, 0, 0}, {2, 1, 0}, 4));
    with.remove("a"), with.remove("b");
    run(with, 1.0), run(without, 1.0);
    State left = with.state();
    EXPECT_EQ(left.bodies[0].id.index, 2u);
    left.bodies[0].id = without.state().bodies[0].id;
    left.body_slots = without.state().body_slots;
    EXPECT_TRUE(same_bits(left, without.state()));
}

/// A moved body goes on as it would have in its old place: pins, velocities and tensions move with it.
TEST(RopeEdit, AMovedBodyKeepsItsMotion) {
    World world = three_ropes();
    run(world, 0.3);
    World other = world;
    const glm::dvec3 by(4.0, -0.5, 2.0);
    allow(other.move(other.id("c"), by));
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(other.state().position[i], world.state().position[i]);
    run(world, 0.5), run(other, 0.5);
    for (std::size_t i = 10; i < 15; ++i)
        EXPECT_LT(distance(other.state().position[i], world.state().position[i] + by), 1e-6);
    expect_valid(other);
    EXPECT_FALSE(other.move(other.id("c"), {2e9, 0, 0}));
    EXPECT_FALSE(other.move(other.id("c"), glm::dvec3(std::numeric_limits<double>::quiet_NaN())));
    EXPECT_FALSE(other.move({}, by));
    other.add_collider("ball", Sphere{{5, 5, 0}, 0.1f});
    other.attach(other.particle("a", 2), "ball");
    const State before = other.state();
    EXPECT_FALSE(other.move(other.id("a"), by)) << "the ball moves it";
    EXPECT_TRUE(same_bits(before, other.state()));
}

TEST(RopeEdit, APinReachesItsGoalOnTime) {
    World world = three_ropes();
    const std::size_t end = world.particle("a", 4);
    EXPECT_FALSE(world.pinned(end));
    world.pin(end, {0.5f, 0.5f, 0}, 0.5);
    EXPECT_TRUE(world.pinned(end));
    world.advance(0.25);
    EXPECT_LE(distance(world.position(end), {0.25f, 0.75f, 0}), 1e-5);  // half way
    world.advance(0.25);
    EXPECT_LE(distance(world.position(end), {0.5f, 0.5f, 0}), 1e-6);
    run(world, 1.0);
    EXPECT_LE(distance(world.position(end), {0.5f, 0.5f, 0}), 1e-6);
    world.pin(end, {0, 1, 0});  // within the next substep
    world.advance(1.0 / 240.0);
    EXPECT_EQ(world.position(end), glm::vec3(0, 1, 0));
    world.advance(0.1);  // it moved at 170 m/s: released at once, it would fly off
    world.unpin(end);
    EXPECT_FALSE(world.pinned(end));
    run(world, 1.0);
    EXPECT_LT(world.position(end).y, 0.5f);
    EXPECT_EQ(world.state().pins.size(), 4u);
}

TEST(RopeEdit, AttachedParticlesMoveWithTheirCollider) {
    World world = three_ropes();
    world.add_collider("ball", Sphere{{0, 2, 0}, 0.1f});
    const std::size_t end = world.particle("a", 4);
    world.attach(end, "ball");
    world.move_collider("ball", {0.25f, 1.75f, 0}, 0.5);
    run(world, 0.5);
    EXPECT_LE(distance(world.position(end), {0.25f, 0.75f, 0}), 1e-5);
    world.set_collider("ball", Sphere{{0, 1.5f, 0}, 0.2f});
    world.advance(1.0 / 240.0);
    EXPECT_LE(distance(world.position(end), {0, 0.5f, 0}), 1e-5);
    world.remove_collider("ball");
    EXPECT_FALSE(world.pinned(end));  // released
    expect_valid(world);
    run(world, 0.5);
    EXPECT_TRUE(all_finite(world));
}

/// A handle read from the world's own state is accepted.
TEST(RopeEdit, HandlesMayComeFromTheWorldItself) {
    World named = three_ropes();
    rope::World& world = named.core();
    const rope::State& state = world.state();
    named.add_collider("a ball", Sphere{{5, 0, 0}, 0.1f});
    allow(world.attach(1, state.colliders[0].id));
    for (std::size_t i = 2; i < 12; ++i) allow(world.attach(i, state.pins[1].collider));
    for (std::size_t i = 1; i < 12; ++i) EXPECT_EQ(state.pins[i].collider, state.colliders[0].id);
    allow(world.move_collider(state.colliders[0].id, {6, 0, 0}));
    EXPECT_TRUE(world.cut(state.bodies[0].id, 1));
    allow(world.remove(state.bodies[0].id));
    allow(world.remove_collider(state.colliders[0].id));
    EXPECT_TRUE(state.colliders.empty());
    expect_valid(named);
}

/// The handle of a removed body finds nothing, although its slot is reused.
TEST(RopeEdit, OldHandlesFindNothing) {
    rope::World world;
    const rope::BodyId first = *world.add_rope({}), second = *world.add_rope({});
    EXPECT_FALSE(world.find(rope::BodyId{}));
    EXPECT_FALSE(rope::BodyId{});
    allow(world.remove(first));
    const rope::BodyId third = *world.add_cloth({});
    EXPECT_EQ(third.index, first.index);
    EXPECT_FALSE(world.find(first));
    EXPECT_EQ(world.remove(first).code(), ErrorCode::OutOfRange);
    EXPECT_STREQ(world.remove(first).message(), "remove: body was removed (slot 0)");
    EXPECT_STREQ(world.move({}, {}).message(), "move: body is an empty handle");
    EXPECT_STREQ(world.untie({7, 1}).message(), "untie: tie is not a handle of this world (slot 7)");
    EXPECT_EQ(world.find(second)->first, 0u);
    EXPECT_EQ(world.find(third)->kind, Body::Kind::Cloth);
    // A copy knows the same handles; a restored state does not know handles created since.
    const rope::World copy = world;
    const rope::BodyId fourth = *world.add_rope({});
    EXPECT_EQ(copy.find(third)->count, 576u);
    EXPECT_FALSE(copy.find(fourth));
    world.clear();
    EXPECT_FALSE(world.find(second));
    EXPECT_FALSE(*world.add_rope({}) == second);
    const rope::ColliderId ball = *world.add_collider(Sphere{});
    allow(world.remove_collider(ball));
    EXPECT_TRUE(world.add_collider(Sphere{}));
    EXPECT_FALSE(world.find(ball));
    EXPECT_STREQ(world.remove_collider(ball).message(), "remove_collider: collider was removed (slot 0)");
}

/// All materials of a body can change while it hangs.
TEST(RopeEdit, MaterialsChangeInPlace) {
    World named = world_with({.damping = 2.0f});
    named.add_rope("rope", {.from = {0, 0, 0}, .to = {0, -1, 0}, .segments = 10, .pin_start = true});
    named.add_cloth("cloth",
                    {.corner = {3, 0, 0}, .columns = 5, .rows = 5, .pins = rope::ClothShape::Pins::Row});
    rope::World& world = named.core();
    const rope::BodyId rope = named.id("rope"), cloth = named.id("cloth");
    const double mass = world.mass(*world.find(rope));
    allow(world.set_length(rope, 2.0f));
    allow(world.set_mass(rope, 2.0 * mass));
    allow(world.set_radius(rope, 0.125f));
    allow(world.set_compliance(cloth, rope::Link::Kind::Bend, 0.5f));
    allow(world.set_tear(cloth, 0.25f));
    EXPECT_EQ(world.find(rope)->radius, 0.125f);
    EXPECT_NEAR(world.length(*world.find(rope)), 2.0, 1e-6);
    run(named, 4.0);
    EXPECT_NEAR(named.position(10).y, -2.0f, 1e-3);  // twice as long, under twice the tension
    EXPECT_NEAR(world.state().links[0].tension, 2.0 * 9.81 * mass * 0.95, 0.1);
    for (const rope::Link& link : world.state().links)
        EXPECT_EQ(link.compliance, link.kind == rope::Link::Kind::Bend    ? 0.5f
                                   : link.kind == rope::Link::Kind::Shear ? 0.3f
                                                                          : 0.0f);
    allow(world.set_length(cloth, 1e-3f));  // shrunk at once, it tears
    const std::size_t links = world.state().links.size();
    run(named, 0.5);
    EXPECT_LT(world.state().links.size(), links);
    expect_valid(named);
}

/// Also where segments are not equal.
TEST(RopeEdit, ALongerRopeKeepsTheWeightsOnIt) {
    World named = world_with({});
    named.add_rope("rope", {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 4, .density = 2.0f});
    rope::State state = named.state();
    state.links[0].rest = 0.5f, state.mass[0] = 0.5, state.mass[1] = 0.75 + 0.1, state.mass[4] += 3.0;
    rope::World world = allowed(rope::World::from_state(state));
    allow(world.set_length(named.id("rope"), 2.5f));
    const double expected[] = {1.0, 1.5 + 0.1, 1.0, 1.0, 0.5 + 3.0};
    for (std::size_t i = 0; i < std::size(expected); ++i)
        EXPECT_NEAR(world.state().mass[i], expected[i], 1e-6) << i;
}

TEST(RopeEdit, ClearLeavesOnlySettings) {
    World world = three_ropes();
    rope::Settings settings;
    settings.iterations = 3;
    world.set_settings(settings);
    world.add_collider("ball", Sphere{});
    run(world, 0.5);
    world.clear();
    EXPECT_EQ(world.size(), 0u);
    EXPECT_TRUE(world.state().colliders.empty());
    EXPECT_EQ(world.settings(), settings);
    EXPECT_EQ(world.state().substeps, 0u);
    run(world, 0.5);
    EXPECT_EQ(world.add_rope({}), "rope");
}

/// Several pins dragged while the simulation is paused: all arrive, or none moves.
TEST(RopeEdit, DragPinsMovesAllOrNone) {
    World world = three_ropes();
    rope::Workspace workspace;
    const std::array<rope::PinPlace, 2> places{{{0, {0.1, -0.1, 0.0}}, {12, {2.1, 0.4, 0.1}}}};
    ASSERT_TRUE(rope::drag_pins(world, workspace, places));
    for (const rope::PinPlace& each : places) {
        EXPECT_TRUE(world.pinned(each.particle));
        EXPECT_LE(glm::length(world.state().position[each.particle] - each.to), 1e-9) << each.particle;
    }
    const State before = world.state();
    ASSERT_TRUE(rope::drag_pins(world, workspace, {}));
    EXPECT_EQ(before, world.state());
    const auto refused = [&](const rope::PinPlace& second, const char* word) {
        const std::array<rope::PinPlace, 2> bad{{{0, {0, 0, 0}}, second}};
        const Result result = rope::drag_pins(world, workspace, bad);
        ASSERT_FALSE(result);
        EXPECT_NE(std::string(result.message()).find(word), std::string::npos) << result.message();
        EXPECT_EQ(before, world.state()) << word;
    };
    refused({0, {1, 1, 1}}, "pins");
    refused({15, {1, 1, 1}}, "15");
    refused({12, {1, nan, 1}}, "nan");
}

}  // namespace
}  // namespace tendril::test
