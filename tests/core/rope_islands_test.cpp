// Bodies without links between them are solved independently: none affects another, and threads that share
// them give the same bits.
#include "jobs.hpp"
#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using rope::Advance;
using rope::Workspace;

/// Colliders for everything to fall on.
void add_ground(rope::World& world) {
    allow(world.add_collider(rope::Plane{{0, -0.5f, 0}, {0.1f, 1.0f, 0}}).error());
    for (int i = 0; i < 8; ++i) {
        const auto n = static_cast<float>(i);
        allow(world.add_collider(rope::Sphere{{0.3f * n - 1.0f, 0.1f * n - 0.3f, 0.0f}, 0.15f}).error());
    }
}

/// Adds body `number`: every third a cloth, some hair, the others ropes.
void add_body(rope::World& world, int number, int cells) {
    Random random(static_cast<std::uint64_t>(1000 + number));
    const glm::vec3 at = random.point(1.0f), along = random.point(0.8f);
    if (number % 3 == 0) {
        allow(world
                  .add_cloth({.corner = at,
                              .along = {0.6f, 0, 0},
                              .down = {0, -0.1f, 0.6f},
                              .columns = cells,
                              .rows = cells,
                              .tear = number % 2 == 0 ? 0.3f : 0.0f,
                              .pins = number % 2 == 0 ? rope::ClothShape::Pins::Corners
                                                      : rope::ClothShape::Pins::None})
                  .error());
    } else if (number % 7 == 0) {
        allow(world.add_hair({.roots = {{at, {0, 1, 0}}, {at + glm::vec3(0.1f, 0, 0), {1, 1, 0}}}}).error());
    } else {
        allow(world
                  .add_rope({.from = at,
                             .to = at + along,
                             .segments = number % 2 == 0 ? cells : 3 * cells,
                             .radius = 0.01f,
                             .pin_start = number % 5 != 0})
                  .error());
    }
}

rope::World some_world(const rope::Settings& settings, int bodies, int cells) {
    rope::World world;
    allow(world.set_settings(settings));
    add_ground(world);
    for (int i = 0; i < bodies; ++i) add_body(world, i, cells);
    return world;
}

/// Moves pins and colliders while advancing; returns the sum of all reports.
Advance play(rope::World& world, Workspace& workspace, int frames) {
    Advance sum;
    Random random(7);
    for (int i = 0; i < frames; ++i) {
        const std::size_t which = random.below(world.state().colliders.size());
        const glm::vec3 to = random.point(0.5f);
        allow(world.move_collider(world.state().colliders[which].id, to, 0.1));
        const Advance done = world.advance(1.0 / 60.0, workspace);
        sum.substeps += done.substeps, sum.passes += done.passes, sum.work += done.work;
        sum.shortened += done.shortened, sum.unresolved += done.unresolved;
        sum.unconverged += done.unconverged;
    }
    return sum;
}

LABEL(slow, "RopeIslands.Threads*");

TEST(RopeIslands, NoBodyAffectsAnother) {
    constexpr int bodies = 15;
    for (const rope::Solver solver : all_solvers) {
        const rope::Settings settings{.solver = solver};
        rope::World together = some_world(settings, bodies, 6);
        Workspace workspace;
        play(together, workspace, 30);
        for (int i = 0; i < bodies; ++i) {
            rope::World alone;
            allow(alone.set_settings(settings));
            add_ground(alone);
            add_body(alone, i, 6);
            play(alone, workspace, 30);
            const std::size_t first = together.state().bodies[static_cast<std::size_t>(i)].first;
            for (std::size_t k = 0; k < alone.size(); ++k)
                ASSERT_EQ(alone.position(k), together.position(first + k)) << name(solver) << ' ' << i;
        }
    }
}

/// A rope whose pins are further apart than its length cannot be solved. Beside it, a rope between colliders
/// has the same bits as alone.
TEST(RopeIslands, AnUnsolvableRopeAffectsNoOther) {
    const auto add_lying = [](rope::World& world) {
        for (const float x : {0.0f, 0.35f}) allow(world.add_collider(rope::Sphere{{x, 0, 0}, 0.2f}).error());
        // In the notch, each particle is pushed out of one ball and into the other.
        allow(world
                  .add_rope({.from = {0.175f, 0.5f, -0.05f},
                             .to = {0.18f, 0.5f, 0.05f},
                             .segments = 8,
                             .length = 0.12f,
                             .radius = 0.02f})
                  .error());
    };
    rope::World alone, together;
    Workspace workspace;
    add_lying(alone), add_lying(together);
    const rope::BodyId stretched =
        allowed(together.add_rope({.from = {0, 5, 0}, .to = {1, 5, 0}, .segments = 24, .pin_start = true}));
    allow(together.pin(allowed(together.particle(stretched, 24)), {3, 5, 0}));
    for (rope::World* const world : {&alone, &together})
        for (int i = 0; i < 60; ++i) world->advance(1.0 / 60.0, workspace);
    EXPECT_GT(together.state().bodies[1].stretch, 0.5f);
    for (std::size_t k = 0; k < alone.size(); ++k) ASSERT_EQ(alone.position(k), together.position(k)) << k;
}

bool same(const Advance& a, const Advance& b) {
    return a.substeps == b.substeps && a.passes == b.passes && a.work == b.work &&
           a.shortened == b.shortened && a.unresolved == b.unresolved && a.unconverged == b.unconverged;
}

/// A world before and after running on one thread.
struct Played {
    Played(rope::World world, int count) : start(std::move(world)), end(start), frames(count) {
        Workspace workspace;
        done = play(end, workspace, frames);
    }
    void expect_the_same_on(int threads, const Tasks& tasks, const std::string& how) const {
        Workspace workspace;
        allow(workspace.use_threads(threads, tasks));
        rope::World world = start;
        EXPECT_TRUE(same(play(world, workspace, frames), done)) << how << " on " << threads;
        EXPECT_TRUE(same_bits(world.state(), end.state())) << how << " on " << threads;
    }

    rope::World start, end;
    int frames;
    Advance done;
};

TEST(RopeIslands, ThreadsGiveTheSameBits) {
    for (const rope::Solver solver : all_solvers) {
        const Played played(some_world({.solver = solver}, 24, 16), 6);
        for (const int threads : {1, 2, 3}) played.expect_the_same_on(threads, {}, name(solver));
        for (const bool threaded : {false, true}) {
            Jobs jobs{.backwards = true, .threaded = threaded};
            played.expect_the_same_on(3, {run_on_jobs, &jobs}, name(solver));
            EXPECT_EQ(jobs.calls, 24u);  // one per substep
            EXPECT_EQ(jobs.pieces, 72u);
        }
    }
}

/// Threads share a large cloth, in any order of arrival and even if some never come.
TEST(RopeIslands, ThreadsShareACloth) {
    rope::World start = world_with({.iterations = 5});
    add_ground(start);
    for (const float high : {0.2f, 0.6f}) {
        const rope::ClothShape sheet{.corner = {-1, high, -1},
                                     .along = {2, 0.1f, 0},
                                     .down = {0, 0, 2},
                                     .columns = 97,
                                     .rows = 90,
                                     .pins = rope::ClothShape::Pins::Corners};
        allow(start.add_cloth(sheet).error());
        add_body(start, 1, 20), add_body(start, 3, 20);
    }
    const Played played(start, 2);
    for (const int threads : {2, 3, 7}) played.expect_the_same_on(threads, {}, "cloth");
    for (const bool backwards : {false, true}) {
        for (const bool threaded : {false, true}) {
            Jobs jobs{.backwards = backwards, .threaded = threaded};
            played.expect_the_same_on(4, {run_on_jobs, &jobs}, backwards ? "backwards" : "forwards");
            EXPECT_EQ(jobs.pieces, 4 * jobs.calls);
            EXPECT_EQ(jobs.calls, 8u);  // one per substep
        }
    }
}

/// A small world uses one thread only.
TEST(RopeIslands, LittleWorkNeedsNoCallback) {
    rope::World world = some_world({}, 6, 4);
    Workspace workspace;
    Jobs jobs;
    allow(workspace.use_threads(8, {run_on_jobs, &jobs}));
    play(world, workspace, 3);
    EXPECT_EQ(jobs.calls, 0u);
}

TEST(RopeIslands, ThreadCountsOutOfRangeAreRefused) {
    Workspace workspace;
    for (const int threads : {0, -1, 257}) {
        const Result refused = workspace.use_threads(threads);
        EXPECT_EQ(refused.code(), ErrorCode::InvalidArgument) << threads;
        EXPECT_NE(std::string(refused.message()).find("threads"), std::string::npos);
    }
    EXPECT_TRUE(workspace.use_threads(256).ok());
}

/// A hand-made state may have links between bodies. These are solved together, so that the second rope
/// follows the first at the link's length.
TEST(RopeIslands, LinksBetweenBodiesJoinThem) {
    for (const rope::Solver solver : all_solvers) {
        rope::World apart = world_with({.iterations = 64, .solver = solver, .gravity = {0, 0, 0}});
        allow(apart.add_rope({.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 4, .pin_start = true}).error());
        allow(apart.add_rope({.from = {1.5f, 0, 0}, .to = {2.5f, 0, 0}, .segments = 4}).error());
        rope::State state = apart.state();
        state.links.push_back({.a = 4, .b = 5, .rest = 0.5f, .kind = rope::Link::Kind::Stretch});
        rope::World world = allowed(rope::World::from_state(state));
        allow(world.pin(0, {-1, 0, 0}, 0.5));
        Workspace workspace;
        for (int i = 0; i < 30; ++i) {
            world.advance(1.0 / 60.0, workspace);
            EXPECT_NEAR(glm::distance(world.position(4), world.position(5)), 0.5, 0.02) << name(solver) << i;
        }
        EXPECT_LT(world.position(9).x, 1.6) << name(solver);
    }
}

/// Threads give the same bits, also with random links between bodies.
TEST(RopeIslands, ThreadsGiveTheSameBitsForJoinedBodies) {
    Random random(8);
    rope::State state = some_world({}, 24, 16).state();
    for (int i = 0; i < 12; ++i) {
        const auto size = static_cast<std::uint32_t>(state.position.size());
        const auto a = static_cast<std::uint32_t>(random.below(size));
        const auto b = static_cast<std::uint32_t>(random.below(size));
        if (a == b) continue;
        const auto rest = static_cast<float>(glm::length(state.position[a] - state.position[b]));
        state.links.push_back({.a = a, .b = b, .rest = rest, .kind = rope::Link::Kind::Stretch});
    }
    const Played played(allowed(rope::World::from_state(state)), 6);
    Jobs jobs{.threaded = true};
    played.expect_the_same_on(3, {run_on_jobs, &jobs}, "joined");
    EXPECT_GT(jobs.calls, 0u);
}

}  // namespace
}  // namespace tendril::test
