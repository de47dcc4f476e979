// A copy of a world is equivalent: after any edits with any numbers, a copy and a world made from its state
// continue bitwise equal. Rollback and scene files depend on this.
#include <cmath>

#include "rope_hostile.hpp"
#include "rope_support.hpp"
#include "tendril/ik/many.hpp"

namespace tendril::test {
namespace {

using rope::State;

/// Makes `operations` random edits and frames on one world, with a new world every 400. After each, a copy
/// and a world made from its state run beside it.
void play(std::uint64_t seed, int operations) {
    HostileNumbers hostile(seed);
    rope::World world;
    rope::Workspace kept;
    const auto units = ik::vector_units();
    for (int i = 0; i < operations; ++i) {
        if (i % 400 == 0) world = rope::World();
        static_cast<void>(HostileEditor(world, kept, hostile).edit());
        rope::World copy = world;
        Expected<rope::World> again = rope::World::from_state(world.state());
        ASSERT_TRUE(again) << seed << ' ' << i << ": " << again.message();
        const double seconds = hostile.random.chance(8)
                                   ? static_cast<double>(hostile.amount(0.1f))
                                   : world.settings().substep * static_cast<double>(hostile.random.below(3));
        rope::Workspace fresh, other;
        static_cast<void>(other.use_vector_unit(units[hostile.random.below(units.size())]));
        world.advance(seconds, kept, {.max_substeps = 3});
        copy.advance(seconds, fresh, {.max_substeps = 3});
        again->advance(seconds, other, {.max_substeps = 3});
        ASSERT_TRUE(same_bits(world.state(), copy.state())) << "a copy, " << seed << ' ' << i;
        ASSERT_TRUE(same_bits(world.state(), again->state())) << "of its state, " << seed << ' ' << i;
    }
}

TEST(RopeRollback, ACopyEqualsTheOriginalAfterAnyEdits) {
    for (std::uint64_t seed = 201; seed <= 204; ++seed) play(seed, 1500);
}

/// For long manual runs: a million operations take about twenty minutes.
TEST(RopeRollback, DISABLED_AMillionOperations) {
    for (std::uint64_t seed = 100; seed < 200; ++seed) play(seed, 10'000);
}

/// Everything at once: whipping ropes, tearing cloth, hair and pins on moving colliders.
rope::World busy(rope::Solver solver) {
    World world = world_with({.solver = solver});
    world.add_rope("rope",
                   {.from = {0, 2, 0}, .to = {1, 2, 0}, .segments = 24, .length = 1.4f, .pin_start = true});
    for (int i = 0; i < 5; ++i)
        world.add_rope({.from = {0, 1, 0.1f * static_cast<float>(i)}, .to = {1, 1, 0}, .segments = 9});
    world.add_cloth("cloth", {.corner = {-0.5f, 1.8f, 0},
                              .columns = 8,
                              .rows = 8,
                              .tear = 0.03f,
                              .pins = rope::ClothShape::Pins::Corners});
    world.add_collider("ball", rope::Sphere{{0.6f, 1.4f, 0}, 0.2f});
    world.add_collider("rod", rope::Capsule{{-1, 0.8f, 0.2f}, {1, 0.8f, 0}, 0.02f});
    world.add_collider("ground", rope::Plane{});
    world.add_hair("hair",
                   {.roots = {{{0.6f, 1.6f, 0}, {0, 1, 0}}, {{0.5f, 1.6f, 0}, {0, 1, 0}}}, .segments = 6},
                   "ball");
    world.attach(world.particle("rope", 24), "ball");
    return world.core();
}

/// A hundred ticks with everything moving, starting at tick `from`.
void ticks(rope::World& world, rope::Workspace& workspace, int from) {
    for (int i = from; i < from + 100; ++i) {
        const float angle = 0.07f * static_cast<float>(i);
        const glm::vec3 at(0.6f * std::cos(angle), 1.2f + 0.3f * std::sin(2.0f * angle), 0.2f);
        for (std::size_t c = 0; c < 2; ++c)
            allow(world.move_collider(world.state().colliders[c].id, at, 1.0 / 60.0));
        allow(world.pin(0, glm::dvec3(0, 2, 0.2 * std::sin(static_cast<double>(angle))), 1.0 / 60.0));
        world.advance(1.0 / 60.0, workspace);
    }
}

TEST(RopeRollback, ARestoredStateContinuesTheSame) {
    for (const rope::Solver solver : all_solvers) {
        rope::World world = busy(solver);
        rope::Workspace workspace;
        ticks(world, workspace, 0);
        const State saved = world.state();
        ticks(world, workspace, 100);
        const State first = world.state();
        world = allowed(rope::World::from_state(saved));
        ticks(world, workspace, 100);
        EXPECT_TRUE(same_bits(first, world.state())) << name(solver);
    }
}

}  // namespace
}  // namespace tendril::test
