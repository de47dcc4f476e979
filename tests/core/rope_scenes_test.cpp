// Ten thousand random scenes: ropes, cloth and hair among colliders of every kind that move, overlap, and
// contain particles at the start. No free particle stays inside if there is room, and nothing is ever NaN.
#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;
using rope::Shape;
using rope::Solver;

Shape some_shape(Random& random) {
    const glm::vec3 at = random.point(0.6f);
    switch (random.below(8)) {
        case 0:
        case 1:
        case 2:
            return rope::Sphere{at, random.chance(12) ? 0.0f : 0.05f + 0.35f * random.part()};
        case 3:
        case 4:
            return rope::Capsule{at, random.chance(12) ? at : at + random.point(0.5f),
                                 0.03f + 0.2f * random.part()};
        case 5: {
            const glm::vec3 normal = random.point(1.0f) + glm::vec3(0, 1.1f, 0);
            return rope::Plane{{0, -0.8f, 0}, normal};
        }
        default:
            return rope::Box{
                at,
                {0.05f + 0.3f * random.part(), 0.05f + 0.3f * random.part(), 0.05f + 0.3f * random.part()},
                glm::quat(1.5f, random.point(1.0f))};
    }
}

void add_some_body(World& world, Random& random) {
    const float radius = random.chance(6) ? 0.0f : 0.03f * random.part();
    const glm::vec3 at = random.point(0.8f);
    switch (random.below(6)) {
        case 0:
            world.add_cloth(
                {.corner = at,
                 .along = {0.5f, 0, 0},
                 .down = {0, -0.1f, 0.5f},
                 .columns = 4,
                 .rows = 4,
                 .radius = radius,
                 .pins = random.chance(2) ? rope::ClothShape::Pins::Corners : rope::ClothShape::Pins::None});
            return;
        case 1: {
            const bool held = !world.state().colliders.empty() && random.chance(2);
            world.add_hair({.roots = {{at, {0, -1, 0}}, {at + glm::vec3(0.05f, 0, 0), {1, -1, 0}}},
                            .length = 0.4f,
                            .segments = 5,
                            .radius = radius,
                            .attach = held ? world.state().colliders.front().id : rope::ColliderId{}});
            return;
        }
        default: {
            const glm::vec3 to = random.chance(10) ? at : at + random.point(0.8f);
            const auto distance_of = static_cast<float>(distance(at, to));
            world.add_rope({.from = at,
                            .to = to,
                            .segments = 1 + static_cast<int>(random.below(14)),
                            .length = distance_of * (random.chance(3) ? 1.0f : 1.0f + random.part()),
                            .radius = radius,
                            .pin_start = random.chance(2),
                            .pin_end = random.chance(4)});
        }
    }
}

struct Found {
    double depth = 0.0;  ///< in excess of the allowed depth, metres
    std::string what = {};
};

/// Whether there is room for a ball nearby, which is all that the bound requires.
bool has_room(const World& world, const dvec3& near, double radius, Random& random) {
    for (int i = 0; i < 400; ++i) {
        const dvec3 at = near + dvec3(random.point(i < 200 ? 0.05f : 1.0f));
        bool free = true;
        for (const rope::Collider& collider : world.state().colliders)
            free = free && surface_distance(collider.shape, at).distance >= radius;
        if (free) return true;
    }
    return false;
}

void look(const World& world, Random& random, Found& worst) {
    for (const rope::Body& body : world.state().bodies)
        for (std::size_t i = body.first; i < body.first + body.count; ++i) {
            if (world.pinned(i)) continue;
            for (const rope::Collider& collider : world.state().colliders) {
                const dvec3 at = world.state().position[i];
                const double depth = body.radius - surface_distance(collider.shape, at).distance;
                const double allowed = std::max(1e-3 * static_cast<double>(size(collider.shape)), 1e-4);
                if (depth - allowed <= worst.depth || !has_room(world, at, body.radius, random)) continue;
                worst = {depth - allowed, world.name(body) + ", particle " + std::to_string(i - body.first) +
                                              " in " + world.name(collider)};
            }
        }
}

/// Plays one scene of half a second, with colliders that change direction.
void play(std::uint64_t seed, Found& worst) {
    Random random(seed);
    World world = world_with({.substep = random.chance(4) ? 1.0 / 60.0 : 1.0 / 240.0,
                              .iterations = 1 + static_cast<int>(random.below(12)),
                              .solver = all_solvers[random.below(3)],
                              .compliance = random.chance(4) ? 1e-3f : 0.0f,
                              .friction = random.part()});
    const std::size_t colliders = 1 + random.below(4), bodies = 1 + random.below(2);
    for (std::size_t i = 0; i < colliders; ++i)
        world.add_collider("collider " + std::to_string(i), some_shape(random));
    for (std::size_t i = 0; i < bodies; ++i) add_some_body(world, random);
    if (random.chance(3)) {  // exactly on a centre
        rope::State state = world.state();
        state.position[random.below(state.position.size())] = dvec3(centre(state.colliders[0].shape));
        world = World(state);
    }
    for (int turn = 0; turn < 3; ++turn) {
        for (std::size_t i = 0; i < colliders; ++i)
            if (random.chance(2)) {
                const rope::Collider& collider = world.state().colliders[i];
                const glm::vec3 to = centre(collider.shape) + random.point(0.5f);
                world.move_collider(world.name(collider), to, 0.25 * static_cast<double>(random.part()));
            }
        for (int frame = 0; frame < 4; ++frame) {
            world.advance(1.0 / 60.0);
            look(world, random, worst);
            if (!all_finite(world)) {
                worst = {1e9, "not finite"};
                return;
            }
        }
    }
}

/// Four tests of 2500 scenes, so that none takes long.
class RopeScenes : public testing::TestWithParam<int> {};

LABEL(slow, "Of10000/RopeScenes.*");

TEST_P(RopeScenes, NothingFreeStaysInside) {
    int failed = 0;
    for (int i = 0; i < rounds(2500); ++i) {
        const auto seed = static_cast<std::uint64_t>(GetParam() * 10'000 + i);
        Found worst;
        play(seed, worst);
        if (worst.depth > 0.0 && ++failed <= 10) {
            ADD_FAILURE() << "scene " << seed << ": " << worst.what << ", " << worst.depth
                          << " m over what is allowed";
        }
    }
    EXPECT_EQ(failed, 0) << "of " << rounds(2500);
}

/// One of 10^5 other scenes, in which a free end moved 0.89 m out of a plane and into a capsule.
TEST(RopeScene, LeavingAPlaneDoesNotEndInACapsule) {
    Found worst;
    play(1'077'508, worst);
    EXPECT_LE(worst.depth, 0.0) << worst.what;
}

INSTANTIATE_TEST_SUITE_P(Of10000, RopeScenes, testing::Range(1, 5));

}  // namespace
}  // namespace tendril::test
