// A soft rope has its material's stiffness, independent of iterations, substep and number of segments.
#include "rope_support.hpp"
#include "tests/labels.hpp"

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

}  // namespace
}  // namespace tendril::test
