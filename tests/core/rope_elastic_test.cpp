// A soft rope has its material's stiffness, independent of iterations, substep and number of segments.
#include "rope_support.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using rope::Settings;
using rope::Solver;

constexpr double gravity = 9.81;

Settings soft(Solver solver, float compliance, int iterations) {
    return {.iterations = iterations, .solver = solver, .damping = 2.0f, .compliance = compliance};
}

/// Hangs a rope of 1 m and 1 kg/m straight down from one end. Returns by how much it gets longer, metres.
double elongation(const Settings& settings, int segments) {
    World world = world_with(settings);
    world.add_rope("rope", {.from = {0, 0, 0}, .to = {0, -1, 0}, .segments = segments, .pin_start = true});
    run(world, 12.0);
    return -lowest(world) - 1.0;
}

/// As of a continuous rope, C m g / 2, with any number of segments: the last particle has half a link's mass.
double theory(float compliance) {
    return static_cast<double>(compliance) * gravity / 2.0;
}

LABEL(slow, "RopeElastic.*");

TEST(RopeElastic, StretchesUnderItsOwnWeight) {
    for (const int segments : {1, 8, 32, 100}) {
        for (const float compliance : {1e-3f, 1e-2f, 5e-2f}) {
            const double expected = theory(compliance);
            EXPECT_NEAR(elongation(soft(Solver::Direct, compliance, 16), segments) / expected, 1.0, 1e-3)
                << segments << " segments, " << compliance;
        }
    }
}

TEST(RopeElastic, XpbdMatchesGivenEnoughIterations) {
    for (const int segments : {1, 8, 16}) {
        const double expected = theory(1e-2f);
        EXPECT_NEAR(elongation(soft(Solver::Xpbd, 1e-2f, 200), segments) / expected, 1.0, 0.01) << segments;
    }
}

TEST(RopeElastic, NeitherIterationsNorTheSubstepMatter) {
    for (const auto& [iterations, substep] :
         {std::pair(1, 1.0 / 240.0), {64, 1.0 / 240.0}, {16, 1.0 / 60.0}, {16, 1.0 / 1000.0}}) {
        Settings settings = soft(Solver::Direct, 1e-2f, iterations);
        settings.substep = substep;
        EXPECT_NEAR(elongation(settings, 16) / theory(1e-2f), 1.0, 1e-3) << iterations << ' ' << substep;
    }
}

/// Between two pins: the same curve for any number of segments, deeper for softer ropes.
TEST(RopeElastic, SagDoesNotDependOnTheNumberOfSegments) {
    const auto sag = [](float compliance, int segments) {
        World world = world_with(soft(Solver::Direct, compliance, 16));
        hang_between(world, 1.0f, 1.1f, segments);
        run(world, 12.0);
        return -lowest(world);
    };
    const double fine = sag(2e-2f, 128), coarse = sag(2e-2f, 32);
    EXPECT_NEAR(coarse / fine, 1.0, 0.002);
    EXPECT_GT(fine, sag(2e-3f, 64) * 1.02);
    EXPECT_NEAR(sag(1e-7f, 64) / sag(0.0f, 64), 1.0,
                1e-4);  // no jump from stiff to inextensible
}

/// The tension of link k, in newtons, is the weight of the rope below its middle.
TEST(RopeElastic, TensionIsTheWeightBelow) {
    for (const Solver solver : {Solver::Xpbd, Solver::Direct}) {
        for (const float compliance : {0.0f, 1e-3f}) {
            World world = world_with(soft(solver, compliance, solver == Solver::Xpbd ? 400 : 16));
            world.add_rope(
                "rope",
                {.from = {0, 0, 0}, .to = {0, -1, 0}, .segments = 10, .density = 3.0f, .pin_start = true});
            run(world, 8.0);
            for (std::size_t k = 0; k < 10; ++k) {
                const double expected = 0.3 * gravity * (9.5 - static_cast<double>(k));
                EXPECT_NEAR(world.state().links[k].tension / expected, 1.0, 0.01)
                    << name(solver) << ' ' << compliance << ", link " << k;
            }
        }
    }
}

/// Two pins that are too far apart pull with 4e8 N; once one is gone, only weight and swing do.
TEST(RopeElastic, TensionOfAnOverpulledRopeFallsWhenItIsLetGo) {
    World world;
    hang_between(world, 1.2f, 1.7f, 48);
    allow(world.core().set_length(world.find("rope")->id, 0.5f));
    run(world, 1.0);
    const auto strongest = [&] {
        return std::ranges::max(world.state().links, {}, &rope::Link::tension).tension;
    };
    ASSERT_GT(strongest(), 1e8f);
    world.unpin(48);
    run(world, 0.25);
    EXPECT_LT(strongest(), 20.0 * weight(world));
}

/// A weight on a spring: a period of 2 pi sqrt(m C L).
TEST(RopeElastic, BouncesWithThePeriodOfASpring) {
    const float compliance = 2e-2f;
    Settings settings = soft(Solver::Direct, compliance, 16);
    settings.damping = 0.0f;
    settings.substep = 1.0 / 960.0;
    World world = world_with(settings);
    world.add_rope("rope", {.from = {0, 0, 0}, .to = {0, -1, 0}, .segments = 1, .pin_start = true});
    const double rest = -1.0 - theory(compliance),
                 expected = 2.0 * pi * std::sqrt(world.state().mass[1] * static_cast<double>(compliance));
    double before = -1.0, first = -1.0, last = 0.0, time = 0.0;
    int swings = -1;
    run_substeps(world, 2400, [&] {
        time += settings.substep;
        const double now = world.state().position[1].y;
        if (before > rest && now <= rest) {
            if (first < 0.0) first = time;
            last = time, ++swings;
        }
        before = now;
    });
    ASSERT_GT(swings, 1);
    EXPECT_NEAR((last - first) / swings / expected, 1.0, 0.01);
}

/// Relaxation ignores compliance.
TEST(RopeElastic, RelaxationDoesNotChange) {
    EXPECT_EQ(elongation(soft(Solver::Relaxation, 0.0f, 16), 8),
              elongation(soft(Solver::Relaxation, 0.1f, 16), 8));
}

// Ropes that resist bending, against closed forms of elastic rods.

/// A rod of 1 m with `density` kg/m, clamped at the origin; it points along `way`. Two pinned particles clamp
/// it in the middle of the link between them. Its tip has `tip` kg more.
World clamped(int segments, const glm::vec3& way, float bending, float density, double tip, double substep) {
    World world = world_with({.substep = substep, .damping = 3.0f});
    const float length = static_cast<float>(segments) / (static_cast<float>(segments) - 0.5f);
    world.add_rope("rod", {.to = length * way,
                           .segments = segments,
                           .density = density,
                           .bending = bending,
                           .pin_start = true});
    allow(world.core().pin(1, world.core().position(1)));
    rope::State state = world.state();
    state.mass.back() += tip;
    return World(state);
}

TEST(RopeBendingTest, ACantileverDeflectsByItsClosedForm) {
    constexpr double tip = 0.01, stiffness = 1.0;
    constexpr float density = 1e-3f;
    const double wanted = gravity * (tip / (3.0 * stiffness) + density / (8.0 * stiffness));
    const struct {
        int segments;
        double substep;
    } cases[] = {{16, 1.0 / 60.0}, {64, 1.0 / 60.0}, {256, 1.0 / 60.0}, {16, 1.0 / 960.0}};
    for (const auto& [segments, substep] : cases) {
        World world = clamped(segments, {1, 0, 0}, 1.0f, density, tip, substep);
        run(world, 3.0);
        EXPECT_NEAR(-world.state().position.back().y, wanted, 0.01 * wanted)
            << segments << " segments, substep " << substep;
    }
}

/// A column of length L under its own weight q per metre buckles at q L^3 / EI = 7.837 (A. Greenhill, 1881).
TEST(RopeBendingTest, AColumnBucklesUnderItsOwnWeight) {
    for (const int segments : {16, 256})
        for (const double load : {0.95, 1.05}) {
            const auto bending = static_cast<float>(9.81 / (7.837 * load));
            rope::State state = clamped(segments, {0, 1, 0}, bending, 1.0f, 0.0, 1.0 / 60.0).state();
            for (std::size_t i = 2; i < state.position.size(); ++i)
                state.position[i].x = 1e-3 * std::pow(static_cast<double>(i) / segments, 2.0);
            World world(state);
            run(world, 20.0);
            const double aside = world.state().position.back().x;
            if (load < 1.0)
                EXPECT_LT(std::abs(aside), 1e-4) << segments;
            else
                EXPECT_GT(std::abs(aside), 0.05) << segments;
        }
}

/// Simply supported at both ends, a rod sags by 5 q L^4 / (384 EI). Here one end slides, tied to a long
/// thread.
TEST(RopeBendingTest, ARodHungByATieIsAsStiff) {
    World world = world_with({.damping = 3.0f});
    world.add_rope("rod", {.segments = 32, .density = 0.1f, .bending = 2.0f, .pin_start = true});
    world.add_rope("thread", {.from = {1, 20, 0}, .to = {1, 0, 0}, .segments = 2, .pin_start = true});
    allowed(world.core().tie(32, 35, {}));
    run(world, 20.0);
    const rope::State& state = world.state();
    const double sag = 0.5 * (state.position[0].y + state.position[32].y) - state.position[16].y;
    const double wanted = 5.0 * 0.1 * 9.81 / (384.0 * 2.0);
    EXPECT_NEAR(sag, wanted, 0.02 * wanted);
}

TEST(RopeBendingTest, EnergyIsBoundedForAnyStiffness) {
    for (float bending = 1e-9f; bending <= 1e9f; bending *= 1e3f) {
        World world = world_with({.damping = 0.0f});
        world.add_collider("ball", rope::Sphere{{0.5f, -0.7f, 0.0f}, 0.2f});
        world.add_rope("rod", {.segments = 24, .length = 1.2f, .bending = bending, .pin_start = true});
        double before = world.energy();
        const double fall = 1.2 * 9.81 * 1.2;
        run_substeps(world, 480, [&] {
            const double now = world.energy();
            ASSERT_TRUE(std::isfinite(now)) << bending;
            EXPECT_LT(now, before + 0.01 * fall + 1e-6 * std::abs(before)) << bending;
            before = std::min(before, now);
        });
    }
}

TEST(RopeBendingTest, AFreeRodFallsFreely) {
    World world = world_with({.damping = 0.0f});
    world.add_rope("rod", {.from = {0, 0, 0}, .to = {1, 0.3f, 0.2f}, .segments = 64, .bending = 1e6f});
    run(world, 1.0);
    for (std::size_t i = 0; i < world.size(); ++i) EXPECT_NEAR(world.velocity(i).y, -9.81, 0.05) << i;
    EXPECT_LT(world.length_error(), 1e-4);
}

/// A stiff rope over a ball stands off it on both sides; the same rope without stiffness hugs it.
TEST(RopeBendingTest, AStiffRopeSpansABall) {
    const auto end_height = [](float bending) {
        World world = world_with({.damping = 2.0f});
        world.add_collider("ball", rope::Sphere{{0.0f, 0.0f, 0.0f}, 0.1f});
        world.add_rope("rod", {.from = {-0.5f, 0.15f, 0},
                               .to = {0.5f, 0.15f, 0},
                               .segments = 40,
                               .density = 0.1f,
                               .bending = bending});
        run(world, 1.0);
        return world.state().position.front().y;
    };
    EXPECT_GT(end_height(10.0f), 0.1);
    EXPECT_LT(end_height(0.0f), 0.0);
}

TEST(RopeBendingTest, OnlyRopesHaveBendingStiffness) {
    World world;
    world.add_rope("rope", {});
    world.add_cloth("cloth", {});
    rope::State state = world.state();
    state.bodies[1].bending = 1.0f;
    EXPECT_TRUE(
        says(rope::World::from_state(state).error().message(), "bodies[1].bending 0 for all but ropes"));
    state.bodies[1].bending = 0.0f;
    state.bodies[0].bending = -1.0f;
    EXPECT_FALSE(rope::World::from_state(state));
}

TEST(RopeBendingTest, BothPiecesOfACutRopeKeepIt) {
    World world;
    world.add_rope("rope", {.segments = 8, .bending = 2.0f});
    world.cut("rope", 3);
    ASSERT_EQ(world.state().bodies.size(), 2u);
    for (const rope::Body& body : world.state().bodies) EXPECT_EQ(body.bending, 2.0f);
}

}  // namespace
}  // namespace tendril::test
