// Cloth and hair on the same solver: cloth tears where it is pulled, and hair follows a head.
#include <glm/gtc/quaternion.hpp>

#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using rope::ClothShape;
using rope::Link;
using rope::Solver;

std::size_t count(const World& world, Link::Kind kind) {
    return static_cast<std::size_t>(std::count_if(world.state().links.begin(), world.state().links.end(),
                                                  [&](const Link& link) { return link.kind == kind; }));
}

LABEL(slow, "RopeCloth.HangsAndComesToRest");

TEST(RopeCloth, IsAGridWithShearAndBendLinks) {
    World world;
    world.add_cloth("cloth", {.columns = 5, .rows = 4, .pins = ClothShape::Pins::Row});
    EXPECT_EQ(world.size(), 20u);
    EXPECT_EQ(world.find("cloth")->row, 5u);
    EXPECT_EQ(count(world, Link::Kind::Stretch), 4u * 4u + 5u * 3u);
    EXPECT_EQ(count(world, Link::Kind::Shear), 2u * 4u * 3u);
    EXPECT_EQ(count(world, Link::Kind::Bend), 3u * 4u + 5u * 2u);
    EXPECT_EQ(world.state().pins.size(), 5u);
    EXPECT_NEAR(world.length(*world.find("cloth")), 1.0, 1e-6);
    double mass = 0.0;
    for (const double each : world.state().mass) mass += each;
    EXPECT_NEAR(mass, 0.2, 1e-6);  // one square metre
}

TEST(RopeCloth, HangsAndComesToRest) {
    for (const Solver solver : all_solvers) {
        World world = world_with({.iterations = 32, .solver = solver, .damping = 2.0f});
        world.add_cloth("cloth", {.columns = 12, .rows = 12, .pins = ClothShape::Pins::Row});
        run(world, 8.0);
        for (std::size_t i = 0; i < world.size(); ++i)
            EXPECT_LE(glm::length(glm::dvec3(world.velocity(i))), 0.02) << name(solver);
        EXPECT_LE(stretch(world, "cloth"), 0.02) << name(solver);
        EXPECT_NEAR(lowest(world), -1.0, 0.03) << name(solver);
    }
}

TEST(RopeCloth, LiesOnABall) {
    World world = world_with({.damping = 1.0f});
    world.add_collider("ball", rope::Sphere{{0.5f, -0.5f, 0.5f}, 0.3f});
    world.add_cloth("cloth", square_cloth({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 16));
    run(world, 3.0);
    double highest = -1e9, nearest = 1e9;
    for (const glm::dvec3& p : world.state().position) {
        highest = std::max(highest, p.y);
        nearest = std::min(nearest, surface_distance(world.find_collider("ball")->shape, p).distance);
    }
    EXPECT_NEAR(highest, -0.19, 0.02);  // on top, at its radius; the rest hangs down around it
    EXPECT_GE(nearest, 0.01 - 1e-4);
    EXPECT_LT(lowest(world), -0.4);
}

/// Pulled at one corner beyond its strength, it tears there and nowhere else.
TEST(RopeCloth, TearsWhereItIsPulled) {
    World world;
    world.add_cloth("cloth", {.columns = 8, .rows = 8, .tear = 0.2f, .pins = ClothShape::Pins::Row});
    run(world, 1.0);
    const std::size_t whole = world.state().links.size();
    EXPECT_EQ(whole, count(world, Link::Kind::Stretch) + count(world, Link::Kind::Shear) +
                         count(world, Link::Kind::Bend));
    const std::size_t corner = world.particle("cloth", 63);
    world.pin(corner, world.position(corner) + glm::vec3(1.5f, -1.5f, 0), 1.0);
    run(world, 1.5);
    EXPECT_LT(world.state().links.size(), whole);
    EXPECT_GT(world.state().links.size(), whole / 2);
    EXPECT_TRUE(all_finite(world));
    // The torn-off part hangs on the corner; the far upper corner holds.
    const auto touches = [&](std::size_t particle) {
        return std::count_if(world.state().links.begin(), world.state().links.end(),
                             [&](const Link& link) { return link.a == particle || link.b == particle; });
    };
    EXPECT_GE(touches(0), 3);  // of 5: shear links are weaker
    EXPECT_LT(touches(54), 12);
    EXPECT_NO_THROW(World{world.state()});
}

/// Cloth of minimal strength tears at once; cloth that must not tear never does.
TEST(RopeCloth, TearsOnlyIfItMay) {
    for (const float tear : {0.0f, 0.01f}) {
        World world;
        world.add_cloth("cloth", {.columns = 6, .rows = 6, .tear = tear, .pins = ClothShape::Pins::Corners});
        world.add_rope("rope", pinned_rope({3, 0, 0}, {5, 0, 0}, 6, 1.0f));
        const std::size_t links = world.state().links.size();
        world.pin(world.particle("cloth", 30), {-3, -3, 0}, 0.5);
        run(world, 1.0);
        EXPECT_EQ(world.state().links.size() < links, tear > 0.0f);
        const auto of_rope = [&](const Link& link) { return link.a >= world.find("rope")->first; };
        EXPECT_EQ(std::count_if(world.state().links.begin(), world.state().links.end(), of_rope), 6);
    }
}

/// A State may have particles without links: a hole.
TEST(RopeCloth, MayHaveHoles) {
    World world;
    world.add_cloth("cloth", {.columns = 9, .rows = 9, .pins = ClothShape::Pins::Row});
    rope::State state = world.state();
    const auto in_hole = [](std::uint32_t i) { return i % 9 >= 3 && i % 9 <= 5 && i / 9 >= 3 && i / 9 <= 5; };
    std::erase_if(state.links, [&](const Link& link) { return in_hole(link.a) || in_hole(link.b); });
    world = World(state);
    run(world, 1.0);
    EXPECT_TRUE(all_finite(world));
    EXPECT_LT(world.position(40).y, -4.0f);        // the cut-out part falls
    EXPECT_NEAR(world.position(76).y, -1.0, 0.1);  // the rim below the hole still hangs
    EXPECT_LE(glm::length(world.state().position[49] - world.state().position[76]), 40.0);
}

TEST(RopeHair, FollowsItsCollider) {
    for (const Solver solver : all_solvers) {
        World world = world_with({.solver = solver});
        const glm::vec3 head(0.5f, -0.25f, 2.0f);
        world.add_collider("head", rope::Sphere{head, 0.2f});
        rope::HairShape shape{.length = 0.4f, .segments = 8, .attach = world.collider_id("head")};
        for (int i = 0; i < 5; ++i) {
            const float angle = 0.4f * static_cast<float>(i);
            const glm::vec3 out(std::sin(angle), std::cos(angle), 0);
            shape.roots.push_back({head + 0.21f * out, out});
        }
        world.add_hair("hair", shape);
        EXPECT_EQ(world.size(), 45u);
        EXPECT_EQ(world.find("hair")->row, 9u);
        EXPECT_NEAR(world.length(*world.find("hair")), 0.4, 1e-6);
        EXPECT_EQ(world.state().pins.size(), 10u);  // root and direction of each
        const rope::State start = world.state();
        world.move_collider("head", head + glm::vec3(1, 0.5f, 0.25f), 0.5);
        run_substeps(world, 240, [&] {
            const glm::dvec3 by(centre(world.find_collider("head")->shape) - head);
            for (const rope::Pin& pin : world.state().pins) {
                const glm::dvec3 expected = start.position[pin.particle] + by;
                ASSERT_LE(glm::length(world.state().position[pin.particle] - expected), 1e-6);
            }
        });
        EXPECT_TRUE(all_finite(world));
        EXPECT_LE(stretch(world, "hair"), solver == Solver::Direct ? 0.02 : 0.1) << name(solver);
        world.remove_collider("head");
        EXPECT_TRUE(world.state().pins.empty());
        run(world, 0.5);
        EXPECT_LT(world.position(0).y, 0.3f);  // it falls
    }
}

/// Bend links keep hair from hanging straight down: stiffer hair stands out further.
TEST(RopeHair, StifferHairStandsOutFurther) {
    double reach[2];
    const float bends[] = {1e-3f, 10.0f};
    for (int i = 0; i < 2; ++i) {
        World world = world_with({.damping = 2.0f});
        world.add_hair("hair",
                       {.roots = {{{0, 0, 0}, {1, 0, 0}}}, .length = 0.4f, .segments = 8, .bend = bends[i]});
        run(world, 8.0);
        reach[i] = static_cast<double>(world.position(8).x);
        EXPECT_LT(world.position(8).y, -0.01f);
    }
    EXPECT_GT(reach[0], reach[1] + 0.02);
}

}  // namespace
}  // namespace tendril::test
