// The work of a substep is bounded for any settings and any position of colliders.
#include "rope_support.hpp"

namespace tendril::test {
namespace {

/// A rope and a cloth, 149 particles in all.
World bodies(const rope::Settings& settings) {
    World world = world_with(settings);
    world.add_rope({.from = {-1, 0, 0}, .to = {1, 0, 0}, .segments = 48, .radius = 0.05f});
    world.add_cloth({.corner = {-0.5f, 0.1f, 0}, .columns = 10, .rows = 10, .tear = 0.5f});
    return world;
}

TEST(RopeWork, ASubstepIsBounded) {
    const std::vector<std::vector<rope::Shape>> traps{
        // Two walls with no room between them, two that leave no point free, and a rod without end.
        {rope::Plane{{0, 0.01f, 0}, {0, -1, 0}}, rope::Plane{{0, -0.01f, 0}, {0, 1, 0}}},
        {rope::Plane{{0, 5, 0}, {0, 1, 0}}, rope::Plane{{0, -5, 0}, {0, -1, 0}}},
        {rope::Capsule{{-1e9f, 0, 0}, {1e9f, 0, 0}, 0.3f}, rope::Sphere{{0, 0, 0}, 0.5f}},
        {rope::Box{{0, 0, 0}, {1e6f, 1e6f, 0.0f}}, rope::Box{{0, 0, 0}, {0.0f, 1e6f, 1e6f}}},
        {rope::Capsule{{-1, 0, 0}, {1, 0.1f, 0}, 0.0f}, rope::Box{{0, 0, 0}, {1, 1e-6f, 1}}},
    };
    for (const rope::Solver solver : all_solvers) {
        for (const int iterations : {1, 16, 10'000}) {
            for (std::size_t trap = 0; trap < traps.size(); ++trap) {
                World world = bodies({.iterations = iterations, .solver = solver});
                for (const rope::Shape& shape : traps[trap])
                    world.add_collider("trap " + std::to_string(world.state().colliders.size()), shape);
                std::uint64_t most = 0;
                for (int i = 0; i < 6; ++i) {
                    const rope::Advance done = world.advance(world.settings().substep);
                    ASSERT_EQ(done.substeps, 1);
                    most = std::max(most, done.work);
                }
                EXPECT_LE(most, max_work(world.core())) << name(solver) << ' ' << iterations << ' ' << trap;
                EXPECT_TRUE(all_finite(world));
            }
        }
    }
}

/// Skipped work is reported.
TEST(RopeWork, SkippedWorkIsCounted) {
    World world = bodies({.iterations = 10'000, .solver = rope::Solver::Relaxation});
    EXPECT_EQ(world.advance(1.0 / 240.0).shortened, 1);
    EXPECT_EQ(world.advance(0.0).shortened, 0);
    World few = bodies({.iterations = rope::unbounded_passes, .solver = rope::Solver::Relaxation});
    EXPECT_EQ(few.advance(1.0 / 60.0).shortened, 0);
    EXPECT_EQ(few.advance(1.0 / 60.0).unresolved, 0u);
    World shut = bodies({});
    shut.add_collider("above", rope::Plane{{0, 6, 0}, {0, 1, 0}});  // every point is behind one of the two
    shut.add_collider("below", rope::Plane{{0, 5, 0}, {0, -1, 0}});
    EXPECT_EQ(shut.advance(1.0 / 240.0).unresolved, shut.size());
}

/// A ball pressed into a trough: the way out from between them is long, and most directions lead further in.
/// Each of 13 particles searches in the same substep.
TEST(RopeWork, ParticlesPressedIntoATroughGetOut) {
    Random random(10994);
    for (int i = 0; i < 200; ++i) {
        World world = world_with({.solver = all_solvers[random.below(3)]});
        const float left = random.around(0.4f), right = random.around(0.4f);
        world.add_collider("left", rope::Plane{{0, 0, 0}, {0.5f, 1.0f, left}});
        world.add_collider("right", rope::Plane{{0, 0, 0}, {-0.5f, 1.0f, right}});
        world.add_collider("ball", rope::Sphere{{0, 0.25f, 0}, 0.3f});
        const glm::vec3 from = random.point(0.05f), to = from + random.point(0.1f);
        world.add_rope({.from = from, .to = to, .segments = 12, .radius = 0.01f});
        const rope::Advance done = world.advance(world.settings().substep);
        EXPECT_EQ(done.unresolved, 0u) << i;
        for (std::size_t particle = 0; particle < world.size(); ++particle)
            for (const rope::Collider& collider : world.state().colliders)
                EXPECT_GE(surface_distance(collider.shape, world.state().position[particle]).distance,
                          0.01 - 2e-6)
                    << i << ' ' << particle;
    }
}

}  // namespace
}  // namespace tendril::test
