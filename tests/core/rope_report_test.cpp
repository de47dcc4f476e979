// The reports of World::advance: fallbacks, bodies that neither hang nor fall, energy lost in contact.
#include "rope_support.hpp"

namespace tendril::test {
namespace {

struct Report {
    std::uint64_t fallbacks = 0, suspended = 0;
    double contact_loss = 0.0;
};

Report report_of(World& world, double seconds) {
    Report sum;
    const int frames = static_cast<int>(std::lround(60.0 * seconds));
    for (int i = 0; i < frames; ++i) {
        const rope::Advance done = world.advance(1.0 / 60.0);
        sum.fallbacks += done.fallbacks;
        sum.suspended += done.suspended;
        sum.contact_loss += done.contact_loss;
    }
    return sum;
}

TEST(RopeReport, IsEmptyForBodiesInTheAir) {
    for (const rope::Solver solver : all_solvers) {
        for (const float damping : {0.0f, 2.0f}) {
            World world = world_with({.solver = solver, .damping = damping});
            hang_between(world, 1.0f, 1.5f, 40);
            world.add_rope("falls", {.from = {0, 0, 1}, .to = {1, 0.5f, 1}, .segments = 30});
            world.add_cloth(
                "cloth",
                {.corner = {0, 0, 2}, .columns = 8, .rows = 8, .pins = rope::ClothShape::Pins::None});
            const Report report = report_of(world, 2.0);
            EXPECT_EQ(report.suspended, 0u) << name(solver) << ' ' << damping;
            EXPECT_EQ(report.fallbacks, 0u) << name(solver) << ' ' << damping;
            EXPECT_EQ(report.contact_loss, 0.0) << name(solver) << ' ' << damping;
        }
    }
}

TEST(RopeReport, ContactTakesTheEnergyOfAFallOntoTheGround) {
    for (const rope::Solver solver : all_solvers) {
        for (const float height : {0.1f, 1.0f, 4.0f}) {
            World world = world_with({.solver = solver, .damping = 0.0f});
            world.add_collider("ground", rope::Plane{});
            world.add_rope("rope", {.from = {-0.5f, height, 0}, .to = {0.5f, height, 0}, .segments = 20});
            const Report report = report_of(world, 3.0);
            const double fall = weight(world) * static_cast<double>(height - world.state().bodies[0].radius);
            EXPECT_NEAR(report.contact_loss, fall, 0.05 * fall) << name(solver) << ' ' << height;
            EXPECT_EQ(report.suspended, 0u) << name(solver) << ' ' << height;
        }
    }
}

TEST(RopeReport, CountsParticlesThatNeitherHangNorFall) {
    for (const rope::Solver solver : all_solvers) {
        World world = world_with({.solver = solver});
        constexpr float edge = max_magnitude;
        world.add_rope("rope", {.from = {0, -edge, 0}, .to = {1, -edge, 0}, .segments = 8});
        EXPECT_GT(report_of(world, 0.5).suspended, 0u) << name(solver);
    }
}

/// A strand too short for its two pins.
TEST(RopeReport, CountsFallbacks) {
    World hair = world_with({});
    hair.add_hair("hair", {.roots = {{{0, 0, 0}, {0, -1, 0}}}, .length = 0.5f, .segments = 10});
    hair.pin(hair.size() - 1, {0, -0.8, 0});
    EXPECT_GT(report_of(hair, 0.5).fallbacks, 0u);
}

}  // namespace
}  // namespace tendril::test
