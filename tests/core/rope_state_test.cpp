// A world is its State: invalid states are refused, and a world made from a valid one continues seamlessly.
#include "rope_support.hpp"

namespace tendril::test {
namespace {

using rope::State;

/// All fields in which two states can differ; one generation represents all handles.
TEST(RopeState, ComparisonCoversEveryField) {
    const World world = busy_world(rope::Solver::Direct);
    void (*const changes[])(State&) = {
        [](State& s) { s.settings.wind.x = 1.0f; },
        [](State& s) { s.settings.longest_frame = 1.0f; },
        [](State& s) { s.bodies[0].id.generation += 2; },
        [](State& s) { s.bodies[2].stretch += 1.0f; },
        [](State& s) { s.bodies.pop_back(); },
        [](State& s) { s.links[3].tension += 1.0f; },
        [](State& s) { s.position[5].z += 1e-15; },
        [](State& s) { s.displacement[5].x += 1e-15; },
        [](State& s) { s.mass.back() *= 2.0; },
        [](State& s) { s.pins[0].collider = s.colliders[1].id; },
        [](State& s) { s.pins.back().seconds += 1.0; },
        [](State& s) { std::get<rope::Plane>(s.colliders[1].shape).normal.x = 0.1f; },
        [](State& s) { s.colliders[0].goal.x += 1.0; },
        [](State& s) { s.colliders[0].id.generation += 2; },
        [](State& s) { s.body_slots.push_back(2); },
        [](State& s) { s.collider_slots.push_back(2); },
        [](State& s) { s.remainder += 1e-9; },
        [](State& s) { s.displaced_in += 1e-9; },
        [](State& s) { ++s.substeps; },
        [](State& s) { ++s.dropped; },
    };
    EXPECT_TRUE(same_bits(world.state(), State(world.state())));
    EXPECT_EQ(world.state(), State(world.state()));
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        State other = world.state();
        changes[i](other);
        EXPECT_FALSE(same_bits(world.state(), other)) << i;
        EXPECT_NE(world.state(), other) << i;
    }
    State other = world.state();
    other.displacement[0].x =
        -other.displacement[0].x;  // a pinned particle: the value is the same, but not its bits
    EXPECT_EQ(world.state(), other);
    EXPECT_FALSE(same_bits(world.state(), other));
}

struct Broken {
    const char* word;  ///< required in the refusal's message
    void (*how)(State&);
};

TEST(RopeState, InvalidStatesAreRefused) {
    const Broken all[] = {
        {"substep", [](State& s) { s.settings.substep = 0.0; }},
        {"as long", [](State& s) { s.displacement.pop_back(); }},
        {"as long", [](State& s) { s.mass.clear(); }},
        {"position[3]", [](State& s) { s.position[3].y = double{nan}; }},
        {"position[0]", [](State& s) { s.position[0].x = double{infinity}; }},
        {"displacement[2]", [](State& s) { s.displacement[2].z = double{nan}; }},
        {"mass[4]", [](State& s) { s.mass[4] = 0.0; }},
        {"mass[6]", [](State& s) { s.mass[6] = double{nan}; }},
        {"bodies[1].id", [](State& s) { s.bodies[1].id = s.bodies[0].id; }},
        {"bodies[0].id", [](State& s) { s.bodies[0].id = {}; }},
        {"bodies[2].id", [](State& s) { s.bodies[2].id.generation += 2; }},
        {"occupied slot", [](State& s) { s.body_slots.push_back(1); }},
        {"bodies[0].first", [](State& s) { s.bodies[0].first = 1; }},
        {"bodies[1].count", [](State& s) { s.bodies[1].count = 1000; }},
        {"bodies[2].count", [](State& s) { s.bodies[2].count = std::numeric_limits<std::size_t>::max(); }},
        {"bodies[0].count", [](State& s) { s.bodies[0].count = 0; }},
        {"].row ", [](State& s) { s.bodies[1].row = 5; }},
        {"].row ", [](State& s) { s.bodies[1].row = 0; }},
        {"kind", [](State& s) { s.bodies[0].kind = static_cast<rope::Body::Kind>(9); }},
        {"as many as the bodies", [](State& s) { s.bodies.pop_back(); }},
        {"links[2]", [](State& s) { s.links[2].a = 1'000'000; }},
        {"links[3]", [](State& s) { s.links[3].b = s.links[3].a; }},
        {"rest", [](State& s) { s.links[0].rest = nan; }},
        {"rest", [](State& s) { s.links[0].rest = -1.0f; }},
        {"compliance", [](State& s) { s.links[0].compliance = infinity; }},
        {"tension", [](State& s) { s.links[1].tension = infinity; }},
        {"links[1]", [](State& s) { s.links[1].kind = static_cast<rope::Link::Kind>(3); }},
        {"pins[1].particle", [](State& s) { std::swap(s.pins[0], s.pins[1]); }},
        {"pins", [](State& s) { s.pins[1].particle = s.pins[0].particle; }},
        {"pins", [](State& s) { s.pins.back().particle = 100'000; }},
        {"goal", [](State& s) { s.pins[0].goal.x = double{nan}; }},
        {"pins[0].seconds", [](State& s) { s.pins[0].seconds = -1.0; }},
        {"collider",
         [](State& s) {
             s.pins[0].collider = {9, 1};
         }},
        {"colliders[1].id", [](State& s) { s.colliders[1].id = s.colliders[0].id; }},
        {"colliders[0].id", [](State& s) { s.collider_slots.clear(); }},
        {"radius", [](State& s) { std::get<rope::Sphere>(s.colliders[0].shape).radius = nan; }},
        {"remainder", [](State& s) { s.remainder = -0.1; }},
        {"remainder", [](State& s) { s.remainder = double{nan}; }},
        {"displaced_in", [](State& s) { s.displaced_in = double{infinity}; }},
    };
    World good = busy_world(rope::Solver::Direct);
    good.advance(0.1);
    EXPECT_NO_THROW(World{good.state()});
    int number = 0;
    for (const Broken& each : all) {
        State state = good.state();
        each.how(state);
        const std::string message = message_of<std::invalid_argument>([&] { World{state}; });
        EXPECT_NE(message.find(each.word), std::string::npos)
            << number << ": " << message << " lacks " << each.word;
        ++number;
    }
}

/// Any graph of links: rings, stars, duplicates, and links across bodies.
TEST(RopeState, AnyGraphOfLinksWorks) {
    Random random(91);
    for (int round = 0; round < 60; ++round) {
        World world = world_with({.solver = all_solvers[random.below(3)]});
        world.add_rope("rope", {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 9, .pin_start = true});
        world.add_rope("other", {.from = {0, 0.1f, 0}, .to = {1, 0.2f, 0}, .segments = 9});
        world.add_collider("ball", rope::Sphere{{0.5f, -0.5f, 0}, 0.2f});
        State state = world.state();
        for (int i = 0; i < 12; ++i) {
            const auto a = static_cast<std::uint32_t>(random.below(20)),
                       b = static_cast<std::uint32_t>(random.below(20));
            if (a == b) continue;
            rope::Link link{.a = a, .b = b, .rest = 0.1f + 0.4f * std::abs(random.around(1.0f))};
            link.kind = static_cast<rope::Link::Kind>(random.below(3));
            state.links.insert(
                state.links.begin() + static_cast<std::ptrdiff_t>(random.below(state.links.size())), link);
        }
        world = World(state);
        for (int i = 0; i < 60; ++i) world.advance(1.0 / 60.0);
        EXPECT_TRUE(all_finite(world)) << round;
        // Nothing flies off, even with conflicting lengths.
        for (const glm::dvec3& p : world.state().position) EXPECT_LE(glm::length(p), 40.0) << round;
    }
}

/// A world accepts any state that it reached itself, however heavy, wide or tight.
TEST(RopeState, ItsOwnStateIsAccepted) {
    World tight;
    tight.add_rope("rope",
                   {.to = {1, 0, 0}, .segments = 4, .length = 1e-12f, .pin_start = true, .pin_end = true});
    World heavy;
    heavy.add_rope("rope", {.to = {1e6f, 0, 0}, .segments = 4, .density = 1e6f});
    World wide;
    wide.add_cloth("cloth", square_cloth({-9e8f, 0, 0}, {9e8f, 0, 0}, {0, 1e8f, 0}, 3));
    for (World* world : {&tight, &heavy, &wide}) {
        for (int i = 0; i < 30; ++i) world->advance(0.1);
        EXPECT_TRUE(all_finite(*world));
        EXPECT_NO_THROW(World{world->state()});
    }
}

/// Coordinates are bounded: a body that falls or is thrown past the bound stops there and can be saved.
TEST(RopeState, ItsOwnStateIsAcceptedAtTheEdgeOfTheWorld) {
    World world = world_with({.substep = 0.1, .gravity = {1e4f, -1e4f, 0}, .gravity_scale = 1e3f});
    world.add_rope("rope", {.from = {-9e8f, 9e8f, 9e8f}, .to = {-9e8f, 9e8f, 9e8f}, .segments = 5});
    world.add_cloth("cloth", {.corner = {9e8f, 0, 0}, .columns = 3, .rows = 3});
    world.add_collider("ball", rope::Sphere{{9.9e8f, 9.9e8f, 9.9e8f}, 1.0f});
    world.add_collider("rod", rope::Capsule{{1e9f, 0, 0}, {1e9f, 1e9f, 1.0f}, 1.0f});
    for (int i = 0; i < 60; ++i) {
        if (i == 20) world.attach(0, "ball");  // twice as far away as the largest coordinate
        if (i == 30) world.set_settings({.substep = 1e-5, .longest_frame = 1e-3f});
        if (i == 40) world.set_settings({.substep = 0.1});  // motion from 1e-5 s continues in 0.1 s
        if (i == 50) world.move_collider("rod", {1e9f, -5e8f, 0}, 0.5);
        world.advance(0.1);
        EXPECT_TRUE(all_finite(world)) << i;
        EXPECT_NO_THROW(World{world.state()}) << i;
    }
}

TEST(RopeState, BodiesBeyondTheEdgeAreRefused) {
    World world;
    const auto refused = [&](auto add) {
        const std::string message = message_of<std::invalid_argument>(add);
        EXPECT_NE(message.find("1e9"), std::string::npos) << message;
        EXPECT_EQ(world.size(), 0u);
        EXPECT_TRUE(world.state().links.empty() && world.state().bodies.empty());
    };
    refused([&] { world.add_rope({.from = {-1e9f, 0, 0}, .to = {1e9f, 0, 0}, .segments = 1}); });
    refused([&] { world.add_rope({.from = {0, -1e9f, 0}, .to = {1, -1e9f, 0}, .length = 1e9f}); });
    refused([&] { world.add_cloth({.corner = {9e8f, 0, 0}, .along = {9e8f, 0, 0}}); });
    refused([&] { world.add_hair({.roots = {{{0, -1e9f, 0}, {0, -1, 0}}}}); });
}

}  // namespace
}  // namespace tendril::test
