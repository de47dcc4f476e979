// Time is simulated in fixed substeps: the division into frames has no effect, and dropped time is counted.
#include "rope_support.hpp"

namespace tendril::test {
namespace {

using rope::Advance;
using rope::Settings;
using rope::Solver;

double farthest_apart(const World& a, const World& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, glm::length(a.state().position[i] - b.state().position[i]));
    return most;
}

TEST(RopeTime, RaggedFramesGiveTheSameResult) {
    Random random(51);
    World whole = busy_world(Solver::Direct);
    for (int i = 0; i < 60; ++i) whole.advance(1.0 / 60.0);
    for (int round = 0; round < 8; ++round) {
        World ragged = busy_world(Solver::Direct);
        double left = 1.0;
        while (left > 0.0) {
            // Frames from a microsecond to a quarter of a second, and empty calls.
            double frame = std::pow(10.0, -6.0 + 5.398 * static_cast<double>(random.below(1001)) / 1000.0);
            if (random.chance(5)) frame = 0.0;
            frame = std::min(frame, left);
            left -= frame;
            ragged.advance(frame);
        }
        EXPECT_EQ(ragged.state().substeps, 240u);
        EXPECT_LE(farthest_apart(whole, ragged), 1e-6);
    }
}

/// An hour of frames of 1/60 s, which doubles cannot represent: no substep is lost or added.
TEST(RopeTime, AnHourHasAllItsSubsteps) {
    World world;
    for (int i = 0; i < 3600 * 60; ++i) world.advance(1.0 / 60.0);
    EXPECT_EQ(world.state().substeps, 3600u * 240u);
    EXPECT_EQ(world.state().dropped, 0u);
}

TEST(RopeTime, ASubstepIsDueWithinAMillionthOfItsLength) {
    const double h = 1.0 / 240.0;
    World world;
    EXPECT_EQ(world.advance(h * (1.0 - 2e-6)).substeps, 0);
    EXPECT_EQ(world.advance(h * 1.5e-6).substeps, 1);
    EXPECT_EQ(world.advance(h * 0.5).substeps, 0);
    EXPECT_EQ(world.advance(h * (0.5 - 0.5e-6)).substeps, 1);
}

TEST(RopeTime, TimeBeyondTheLongestFrameIsDroppedAndCounted) {
    World world;
    const Advance ten = world.advance(10.0);
    EXPECT_EQ(ten.substeps, 60);  // a quarter of a second
    EXPECT_EQ(ten.dropped, 9u * 240u + 180u);
    EXPECT_EQ(world.state().substeps, 60u);
    EXPECT_EQ(world.state().dropped, 2340u);
    const Advance fits = world.advance(0.25);
    EXPECT_EQ(fits.substeps, 60);
    EXPECT_EQ(fits.dropped, 0u);

    Settings settings;
    settings.longest_frame = 1.0f;
    world.set_settings(settings);
    EXPECT_EQ(world.advance(1.5).dropped, 120u);
    EXPECT_EQ(world.state().dropped, 2460u);
}

TEST(RopeTime, TimeBeyondTheMaximumSubstepsIsDroppedAndCounted) {
    World some = busy_world(Solver::Direct), all = busy_world(Solver::Direct);
    const Advance cut = some.advance(0.1 + 0.3 / 240.0, 10);
    EXPECT_EQ(cut.substeps, 10);
    EXPECT_EQ(cut.dropped, 14u);
    EXPECT_EQ(some.advance(0.7 / 240.0, 10).substeps, 1) << "what is less than a substep was kept";
    all.advance(11.0 / 240.0);
    EXPECT_EQ(farthest_apart(some, all), 0.0);
    EXPECT_EQ(some.state().dropped, 14u);
    EXPECT_EQ(some.advance(1.0, 0).dropped, 240u) << "those over the longest frame and these, each once";
    EXPECT_EQ(some.advance(0.05).substeps, 12);
}

/// Less than a substep dropped in each of many frames adds up: it is simulated or counted.
TEST(RopeTime, AllTimeIsSimulatedOrCounted) {
    World world;
    const double over = 0.4 / 240.0;
    for (int i = 0; i < 1000; ++i) world.advance(0.25 + over);
    EXPECT_NEAR(static_cast<double>(world.state().substeps + world.state().dropped), 60'400.0, 1.0);

    Settings slow;  // a substep longer than the limit of a frame
    slow.substep = 0.1, slow.longest_frame = 0.01f;
    World other = world_with(slow);
    for (int i = 0; i < 100; ++i) other.advance(1.0 / 60.0);
    EXPECT_NEAR(static_cast<double>(other.state().substeps + other.state().dropped), 16.0, 1.0);
}

TEST(RopeTime, ZeroTimeTakesNoStepAndBadTimeIsRefused) {
    World world = busy_world(Solver::Direct);
    world.advance(0.3 / 240.0);
    const rope::State before = world.state();
    EXPECT_EQ(world.advance(0.0).substeps, 0);
    EXPECT_TRUE(same_bits(before, world.state()));
    for (const double seconds : {-1.0, -1e-300, 2e9, double{nan}, double{infinity}, -double{infinity}}) {
        const Advance done = world.advance(seconds);
        EXPECT_FALSE(done.accepted) << seconds;
        EXPECT_EQ(done.substeps, 0);
        EXPECT_TRUE(same_bits(before, world.state()));
    }
}

/// A change of substep does not change speeds.
TEST(RopeTime, ANewSubstepKeepsTheSpeed) {
    World world = world_with({.damping = 0.0f, .gravity = {0, 0, 0}, .external = {1, 0, 0}});
    world.add_rope("rope", {.from = {0, 0, 0}, .to = {0, 1, 0}, .segments = 4});
    run(world, 1.0);
    Settings settings = world.settings();
    const glm::vec3 speed = world.velocity(0);
    settings.external = {0, 0, 0};
    for (const double substep : {1.0 / 1000.0, 1.0 / 30.0, 1.0 / 240.0}) {
        settings.substep = substep;
        world.set_settings(settings);
        run(world, 0.5);
        EXPECT_NEAR(world.velocity(2).x, speed.x, 1e-5) << substep;
    }
}

// The reports of World::advance: fallbacks, bodies that neither hang nor fall, energy lost in contact.

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
