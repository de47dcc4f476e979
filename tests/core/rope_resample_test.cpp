// Bodies that are resampled, reversed, and made longer or wider while they move.
#include <glm/vec3.hpp>
#include <string>

#include "rope_support.hpp"
#include "tendril/rope/edit.hpp"

namespace tendril::test {
namespace {

using rope::Body;
using rope::Link;

/// Replaces the state and keeps the names.
std::vector<std::size_t> apply(World& world, Expected<rope::Edited> edited) {
    allow(edited.error());
    world.core() = std::move(edited->world);
    return std::move(edited->becomes);
}
std::vector<std::size_t> divide(World& world, const char* body, std::size_t columns, std::size_t rows = 1) {
    return apply(world, rope::resample(world, world.id(body), {columns, rows}));
}

/// The current position of a point at the fraction `part` along a rope.
glm::dvec3 along(const World& world, const char* name, double part) {
    const Body& body = *world.find(name);
    const double at = part * static_cast<double>(body.count - 1);
    const auto before = std::min(static_cast<std::size_t>(at), body.count - 2);
    const auto& p = world.state().position;
    return p[body.first + before] +
           (at - static_cast<double>(before)) * (p[body.first + before + 1] - p[body.first + before]);
}

World swinging() {
    World world;
    world.add_rope("before", {.segments = 3});
    world.add_rope("rope",
                   {.from = {0, 2, 0}, .to = {1, 2, 0}, .segments = 16, .length = 1.2f, .pin_start = true});
    world.add_rope("after", {.from = {4, 2, 0}, .to = {5, 2, 0}, .segments = 5, .pin_end = true});
    run(world, 0.5);
    return world;
}

TEST(RopeResample, ARopeKeepsItsShapeAndMotion) {
    for (const std::size_t segments : {8u, 15u, 32u, 50u, 128u}) {
        World world = swinging();
        const World before = world;
        divide(world, "rope", segments + 1);
        const Body& rope = *world.find("rope");
        EXPECT_EQ(rope.count, segments + 1);
        EXPECT_EQ(rope.row, segments + 1);
        EXPECT_NEAR(world.length(rope), 1.2, 1e-6);
        EXPECT_NEAR(world.density(rope), 1.0, 1e-6);
        EXPECT_NEAR(world.mass(rope), 1.2, 1e-6);
        EXPECT_NEAR(before.mass(*before.find("rope")), 1.2, 1e-6);
        for (int i = 0; i <= 20; ++i)
            EXPECT_LT(distance(along(world, "rope", i / 20.0), along(before, "rope", i / 20.0)), 0.02)
                << segments;
        EXPECT_TRUE(world.pinned(world.particle("rope", 0)));
        EXPECT_TRUE(world.pinned(world.particle("after", 5)));
        EXPECT_EQ(world.state().pins.size(), 2u);
        EXPECT_LT(glm::length(momentum(world) - momentum(before)), 1e-9) << segments;
        EXPECT_NO_THROW(World{world.state()});
        // It moves on much as before.
        World coarse = before;
        run(world, 0.25), run(coarse, 0.25);
        EXPECT_LT(distance(along(world, "rope", 1.0), along(coarse, "rope", 1.0)), 0.12) << segments;
        EXPECT_LE(stretch(world), 2e-3);
    }
}

/// Doubled and then halved in number of segments, it is the same rope again.
TEST(RopeResample, SubdividingAndMergingRestoresIt) {
    World world = swinging();
    const rope::State before = world.state();
    divide(world, "rope", 33);
    divide(world, "rope", 17);
    for (std::size_t i = 0; i < world.size(); ++i) {
        EXPECT_LT(distance(world.state().position[i], before.position[i]), 1e-12);
        EXPECT_NEAR(world.state().mass[i], before.mass[i], 1e-9);
    }
    EXPECT_EQ(world.state().links.size(), before.links.size());
}

/// Too few particles for the pins and ties are refused; pinned and tied points stay in place.
TEST(RopeResample, PinsAndTiesStayOnTheirPoints) {
    World world;
    world.add_rope("a", {.segments = 12});
    world.add_rope("b", pinned_rope({0, 1, 0}, {1, 1, 0}, 12));
    world.pin(world.particle("a", 5), {0.4f, 0, 0});
    const rope::TieId tie = allowed(world.core().tie(world.particle("a", 7), world.particle("b", 3)));
    run(world, 0.5);
    const glm::dvec3 pinned = world.state().position[5], tied = world.state().position[7];
    for (const std::size_t columns : {4u, 7u, 40u}) {
        divide(world, "a", columns);
        EXPECT_EQ(world.find("a")->count, columns);
        std::size_t pins = 0;
        for (const rope::Pin& pin : world.state().pins)
            if (pin.particle < columns) {
                ++pins;
                EXPECT_EQ(world.state().position[pin.particle], pinned);
            }
        EXPECT_EQ(pins, 1u);
        EXPECT_EQ(world.state().position[world.core().find(tie)->a], tied);
        EXPECT_EQ(world.core().find(tie)->b, columns + 3);
        EXPECT_NEAR(world.length(*world.find("a")), 1.0, 1e-6);
    }
    const auto refused = rope::resample(world, world.id("a"), {3, 1});
    ASSERT_FALSE(refused);
    EXPECT_NE(std::string(refused.error().message()).find("4 or more"), std::string::npos)
        << refused.error().message();
    EXPECT_FALSE(rope::resample(world, world.id("a"), {1, 1}));
    EXPECT_FALSE(rope::resample(world, world.id("a"), {9, 2}));
    EXPECT_FALSE(rope::resample(world, world.id("a"), {2'000'000, 1}));
    EXPECT_FALSE(rope::resample(world, {}, {9, 1}));
}

TEST(RopeResample, HairKeepsItsRootsAndTheirDirection) {
    World world;
    world.add_hair("hair", {.roots = {{{0, 2, 0}, {1, 0, 0}}, {{0, 2, 1}, {1, 0, 0}}}, .segments = 8});
    run(world, 0.5);
    for (const std::size_t columns : {17u, 6u, 30u}) {
        divide(world, "hair", columns, 2);
        const Body& hair = *world.find("hair");
        EXPECT_EQ(hair.count, 2 * columns);
        EXPECT_NEAR(world.length(hair), 0.5, 1e-6);
        EXPECT_NEAR(world.density(hair), 0.05, 1e-6);
        EXPECT_TRUE(world.pinned(0) && world.pinned(1) && world.pinned(columns) && world.pinned(columns + 1));
        EXPECT_LT(std::abs(world.state().position[1].y - 2.0), 1e-6);
        run(world, 0.5);
        EXPECT_TRUE(all_finite(world));
    }
}

TEST(RopeResample, AClothKeepsItsSidesMassAndPins) {
    World world;
    world.add_cloth("cloth", {.corner = {0, 2, 0},
                              .along = {1, 0, 0},
                              .down = {0.3f, -0.5f, 0},
                              .columns = 9,
                              .rows = 7,
                              .pins = rope::ClothShape::Pins::Row});
    run(world, 0.5);
    const Body was = *world.find("cloth");
    const double length = world.length(was), width = world.width(was), mass = world.mass(was);
    allow(world.set_compliance(was.id, Link::Kind::Stretch, 1e-3));
    for (const auto& [columns, rows] :
         {std::pair<std::size_t, std::size_t>{17, 13}, {5, 4}, {20, 4}, {9, 7}}) {
        const World before = world;
        divide(world, "cloth", columns, rows);
        const Body& cloth = *world.find("cloth");
        EXPECT_EQ(cloth.count, columns * rows);
        EXPECT_EQ(cloth.row, columns);
        EXPECT_NEAR(world.length(cloth), length, 1e-6);
        EXPECT_NEAR(world.width(cloth), width, 1e-6);
        EXPECT_NEAR(world.mass(cloth), mass, 1e-9);
        EXPECT_NEAR(world.density(cloth), 0.2, 1e-3);
        EXPECT_NEAR(world.compliance(cloth, Link::Kind::Stretch), 1e-3, 1e-8);
        EXPECT_EQ(world.state().pins.size(), columns);
        EXPECT_LT(distance(world.state().position.back(), before.state().position.back()), 1e-9);
        run(world, 0.25);
        EXPECT_TRUE(all_finite(world));
        EXPECT_LT(stretch(world, "cloth"), 0.03) << columns;
    }
}

TEST(RopeResample, ATornClothStaysTorn) {
    World world;
    world.add_cloth("cloth", {.columns = 9, .rows = 9, .pins = rope::ClothShape::Pins::Row});
    rope::State state = world.state();
    // Torn between columns 4 and 5.
    std::erase_if(state.links, [](const Link& link) {
        const auto a = link.a % 9, b = link.b % 9;
        return std::min(a, b) <= 4 && std::max(a, b) >= 5;
    });
    world = World(state);
    divide(world, "cloth", 17, 17);
    run(world, 1.0);
    EXPECT_TRUE(all_finite(world));
    for (const Link& link : world.state().links) EXPECT_TRUE(link.a % 17 > 8 || link.b % 17 <= 9);
    EXPECT_NEAR(world.length(*world.find("cloth")), 1.0, 1e-6);
}

TEST(RopeResample, AReversedRopeKeepsItsMotion) {
    World world = swinging();
    const rope::TieId tie =
        allowed(world.core().tie(world.particle("rope", 4), world.particle("after", 2), {.length = 3}));
    World other = world;
    const auto becomes = apply(other, rope::reverse(other, other.id("rope")));
    EXPECT_EQ(becomes.front(), 16u);
    EXPECT_TRUE(other.pinned(other.particle("rope", 16)) && !other.pinned(other.particle("rope", 0)));
    EXPECT_EQ(other.core().find(tie)->a, other.particle("rope", 12));
    run(world, 0.5), run(other, 0.5);
    for (std::size_t i = 0; i <= 16; ++i)
        EXPECT_LT(distance(world.position(world.particle("rope", i)),
                           other.position(other.particle("rope", 16 - i))),
                  1e-4);
    apply(other, rope::reverse(other, other.id("rope")));
    EXPECT_TRUE(other.pinned(other.particle("rope", 0)));
    other.add_cloth("cloth", {});
    EXPECT_FALSE(rope::reverse(other, other.id("cloth")));
    EXPECT_FALSE(rope::reverse(other, {}));
}

/// The same pull gives the same strain, for any number of segments and any length.
TEST(RopeResample, StretchDependsOnTheMaterialOnly) {
    for (const int segments : {4, 32}) {
        World world = world_with({.damping = 3.0f});
        world.add_rope("rope",
                       {.to = {0, -1, 0}, .segments = segments, .density = 0.001f, .pin_start = true});
        world.add_rope("weight", {.from = {0, -1, 0}, .to = {0, -1.1f, 0}, .segments = 1, .density = 5.0f});
        allowed(world.core().tie(world.particle("rope", static_cast<std::size_t>(segments)),
                                 world.particle("weight", 0)));
        allow(world.set_compliance(world.id("rope"), Link::Kind::Stretch, 0.01));  // 1 % per newton
        EXPECT_NEAR(world.compliance(*world.find("rope"), Link::Kind::Stretch), 0.01, 1e-7);
        run(world, 6.0);
        const double pull = 9.81 * world.mass(*world.find("weight"));
        const auto end = [&] {
            return -world.state().position[world.particle("rope", world.find("rope")->count - 1)].y;
        };
        EXPECT_NEAR(end(), 1.0 + 0.01 * pull, 0.01) << segments;
        divide(world, "rope", 12 + 1);
        run(world, 6.0);
        EXPECT_NEAR(end(), 1.0 + 0.01 * pull, 0.01) << segments;
        allow(world.set_length(world.id("rope"), 2.0f));
        run(world, 6.0);
        EXPECT_NEAR(end(), 2.0 * (1.0 + 0.01 * pull), 0.02) << segments;
    }
}

TEST(RopeResample, LengthAndWidthAreOneSideEach) {
    World world;
    world.add_cloth("cloth", {.along = {1, 0, 0}, .down = {0, -0.5f, 0}, .columns = 9, .rows = 7});
    world.add_rope("rope", {});
    const rope::BodyId cloth = world.id("cloth"), rope = world.id("rope");
    allow(world.set_length(cloth, 2.0f));
    const auto expect = [&](double length, double width) {
        const Body& body = *world.find("cloth");
        EXPECT_NEAR(world.length(body), length, 1e-6);
        EXPECT_NEAR(world.width(body), width, 1e-6);
        EXPECT_NEAR(world.mass(body), 0.2 * length * width, 1e-6);
        for (const Link& link : world.state().links)
            if (link.kind == Link::Kind::Shear) {
                EXPECT_NEAR(link.rest, std::hypot(length / 8, width / 6), 1e-6);
            }
    };
    expect(2.0, 0.5);
    allow(world.set_width(cloth, 1.5f));
    expect(2.0, 1.5);
    EXPECT_FALSE(world.set_width(rope, 1.0f));
    EXPECT_FALSE(world.set_width({}, 1.0f));
    const double mass = world.mass(*world.find("rope"));
    allow(world.set_length(rope, 3.0f));
    EXPECT_NEAR(world.mass(*world.find("rope")), 3.0 * mass, 1e-6);
    EXPECT_NEAR(world.density(*world.find("rope")), 1.0, 1e-6);
    allow(world.set_density(rope, 0.25));
    EXPECT_NEAR(world.mass(*world.find("rope")), 0.75 * mass, 1e-6);
    EXPECT_FALSE(world.set_density(rope, 0.0));
}

}  // namespace
}  // namespace tendril::test
