// The same bits with every vector unit and with none; no allocation in advance().
#include "memory.hpp"
#include "rope_support.hpp"
#include "tendril/ik/many.hpp"

namespace tendril::test {
namespace {

using rope::Solver;

/// Equal ropes side by side, so that registers are full, half full and single; whips, contacts and a cloth.
World mixed_scene(const rope::Settings& settings, float tear = 0.0f) {
    World world = world_with(settings);
    Random random(101);
    for (int i = 0; i < 19; ++i) {
        const glm::vec3 from = random.point(1.0f) + glm::vec3(0, 1.5f, 0);
        world.add_rope({.from = from,
                        .to = from + random.point(0.7f),
                        .segments = i < 13 ? 12 : 7,
                        .length = 1.3f,
                        .pin_start = !random.chance(4)});
    }
    world.add_rope("stretched", pinned_rope({2, 1, 0}, {4, 1, 0}, 9, 1.5f));
    world.add_cloth("cloth", {.corner = {0, 2, 0.5f},
                              .columns = 7,
                              .rows = 6,
                              .tear = tear,
                              .pins = rope::ClothShape::Pins::Corners});
    world.add_collider("ball", rope::Sphere{{0, 0.6f, 0}, 0.4f});
    world.add_collider("rod", rope::Capsule{{-1, 0.3f, 0.4f}, {1, 0.4f, 0.5f}, 0.1f});
    world.add_collider("box", rope::Box{{0.8f, 0.8f, -0.3f}, {0.2f, 0.3f, 0.2f}, {0.9f, 0.2f, 0.1f, 0.3f}});
    world.add_collider("ground", rope::Plane{});
    world.add_hair("hair", {.roots = {{{0, 1.0f, 0}, {0, 1, 0}}, {{0.1f, 1, 0}, {0, 1, 0}}}, .segments = 6},
                   "ball");
    return world;
}

/// Jerks pins back and forth, so that ropes crack like whips.
void jerk_pins(World& world, Random& random) {
    for (int i = 0; i < 3; ++i) {
        const std::size_t which = random.below(world.state().pins.size());
        const rope::Pin& pin = world.state().pins[which];
        if (pin.collider) continue;
        world.pin(pin.particle, world.position(pin.particle) + random.point(0.3f), 0.05);
    }
    world.move_collider("ball", random.point(0.4f) + glm::vec3(0, 0.6f, 0), 0.1);
}

TEST(RopeBits, EveryVectorUnitGivesTheSame) {
    for (const rope::Settings& settings :
         {rope::Settings{}, rope::Settings{.compliance = 1e-3f, .friction = 0.1f},
          rope::Settings{.substep = 1.0 / 60.0, .damping = 0.0f}}) {
        std::vector<World> worlds;
        std::vector<std::string> units{"", "none"};
        for (const std::string_view unit : ik::vector_units()) units.emplace_back(unit);
        for (const std::string& unit : units) {
            worlds.push_back(mixed_scene(settings));
            worlds.back().use_vector_unit(unit);
            Random random(102);
            for (int i = 0; i < 12; ++i) {
                jerk_pins(worlds.back(), random);
                worlds.back().advance(0.05);
            }
            EXPECT_TRUE(all_finite(worlds.back()));
            EXPECT_TRUE(same_bits(worlds.front().state(), worlds.back().state())) << unit;
        }
    }
}

TEST(RopeBits, ARestoredStateContinuesTheSame) {
    for (const Solver solver : all_solvers) {
        World world = mixed_scene({.solver = solver}, 0.03f);
        Random random(105);
        const auto play = [](World& it, Random draws) {
            for (int i = 0; i < 30; ++i) jerk_pins(it, draws), it.advance(0.05);
        };
        play(world, random);
        World restored = world;  // with its names
        restored.core() = allowed(rope::World::from_state(world.state()));
        play(world, random), play(restored, random);
        EXPECT_TRUE(same_bits(world.state(), restored.state())) << name(solver);
    }
}

/// A rope with all particles at one point: its system is singular, and the direct solver gets NaN.
TEST(RopeBits, ARopeAtOnePointIsFiniteInEveryUnit) {
    for (const int segments : {7, 18, 31}) {
        World first;
        first.add_rope({.from = {1, 2, 3}, .to = {1, 2, 3}, .segments = segments, .pin_start = true});
        for (const std::string_view unit : ik::vector_units()) {
            World world = first;
            world.use_vector_unit(unit);
            World widest = first;
            for (int i = 0; i < 120; ++i) {
                world.advance(1.0 / 240.0), widest.advance(1.0 / 240.0);
                ASSERT_TRUE(all_finite(world)) << unit << ' ' << segments << ' ' << i;
                ASSERT_TRUE(same_bits(world.state(), widest.state())) << unit << ' ' << segments << ' ' << i;
            }
        }
    }
}

/// After buffers have reached their size; near and far from colliders.
TEST(RopeBits, AdvancingAllocatesNothing) {
    for (const Solver solver : all_solvers) {
        World world = mixed_scene({.solver = solver});
        world.move_collider("ball", {30, 30, 30});
        world.advance(0.05);
        Random random(104);
        int substeps = 0;
        for (int i = 0; i < 20; ++i) {
            jerk_pins(world, random);
            without_memory([&] { substeps += world.advance(0.05).substeps; });
        }
        EXPECT_EQ(substeps, 240) << name(solver);
    }
}

}  // namespace
}  // namespace tendril::test
