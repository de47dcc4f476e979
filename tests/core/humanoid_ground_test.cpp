// Grounds have the heights of their definitions, and meshes the heights of their triangles, of any number.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <tendril/humanoid/ground.hpp>

#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace humanoid;

double height(const Ground& ground, double x, double z, double from = 100.0) {
    const auto hit = ground.below({x, from, z});
    return hit ? hit->height : std::numeric_limits<double>::quiet_NaN();
}

TEST(Ground, HasTheHeightOfItsDefinition) {
    const Ground flat = *Ground::flat(0.3), slope = *Ground::slope(0.3), stairs = *Ground::stairs(0.15, 0.3);
    EXPECT_FALSE(Ground().below({0, 1, 0}));
    EXPECT_EQ(Ground().kind(), GroundKind::None);
    EXPECT_STREQ(name(stairs.kind()), "stairs");
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-5.0, 5.0);
    for (int i = 0; i < 1000; ++i) {
        const double x = number(random), z = number(random);
        EXPECT_EQ(height(flat, x, z), 0.3);
        EXPECT_NEAR(height(slope, x, z), std::max(0.0, z) * std::tan(0.3), 1e-12);
        EXPECT_NEAR(height(stairs, x, z), 0.15 * std::floor(std::max(0.0, z) / 0.3), 1e-12);
    }
    EXPECT_EQ(height(stairs, 0, 3.5, 0.1), height(stairs, 0, 3.5)) << "it has one height at each place";
    const glm::dvec3 normal = slope.below({0, 9, 1})->normal;
    EXPECT_NEAR(std::acos(normal.y), 0.3, 1e-12);
    EXPECT_LT(normal.z, 0.0) << "what rises along +Z faces -Z";
}

TEST(Ground, RefusesInvalidGroundsByName) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(says(Ground::stairs(0.15, 0.0).message(), "stairs step_depth 0.01 1e3 0"));
    EXPECT_TRUE(says(Ground::slope(nan).message(), "slope angle -1.5 1.5 nan"));
    EXPECT_FALSE(Ground::flat(nan));
    EXPECT_FALSE(Ground::stairs(nan, 0.3));
    EXPECT_FALSE(Ground::terrain({}));
    EXPECT_FALSE(Ground::terrain({.columns = 2, .heights = {0, 0, 0, nan}}));
    EXPECT_FALSE(Ground::terrain({.columns = 2, .heights = {0, 0, 0}}));
    EXPECT_FALSE(Ground::terrain({.columns = 4, .heights = {0, 0, 0, 0}}));
    EXPECT_TRUE(Ground::terrain({.columns = 2, .heights = {0, 0, 0, 0}}));
    const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    const std::vector<std::uint32_t> good{0, 1, 2}, two{0, 1}, beyond{0, 1, 3};
    EXPECT_TRUE(Ground::mesh(points, good));
    EXPECT_FALSE(Ground::mesh(points, two));
    EXPECT_FALSE(Ground::mesh(points, {}));
    EXPECT_TRUE(says(Ground::mesh(points, beyond).message(), "mesh triangles[2] vertex 3"));
    const std::vector<glm::dvec3> broken{{0, 0, 0}, {1, nan, 0}, {0, 0, 1}};
    EXPECT_FALSE(Ground::mesh(broken, good));
}

TEST(Ground, RaysFromInvalidPointsHitNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();
    const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    const std::vector<std::uint32_t> triangles{0, 1, 2};
    for (const Ground& ground :
         {*Ground::flat(), *Ground::slope(0.2), *Ground::stairs(0.1, 0.3),
          *Ground::terrain({.columns = 2, .heights = {0, 0, 0, 0}}), *Ground::mesh(points, triangles)})
        for (const double bad : {nan, infinite, -infinite}) {
            EXPECT_FALSE(ground.below({bad, 1, 0.1}));
            EXPECT_FALSE(ground.below({0.1, 1, bad}));
        }
}

struct Triangles {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> places;

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        for (const glm::dvec3& p : {a, b, c}) {
            places.push_back(static_cast<std::uint32_t>(points.size()));
            points.push_back(p);
        }
    }
    Ground ground() const { return *Ground::mesh(points, places); }
    /// The height by testing every triangle.
    double height(double x, double z, double from) const {
        double best = std::numeric_limits<double>::quiet_NaN();
        for (std::size_t i = 0; i < places.size(); i += 3) {
            const glm::dvec3 &a = points[i], &b = points[i + 1], &c = points[i + 2];
            const double area = (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
            const double u = ((b.x - x) * (c.z - z) - (b.z - z) * (c.x - x)) / area,
                         v = ((c.x - x) * (a.z - z) - (c.z - z) * (a.x - x)) / area, w = 1.0 - u - v;
            if (!(u >= 0 && v >= 0 && w >= 0)) continue;
            const double y = u * a.y + v * b.y + w * c.y;
            if (y <= from && !(y <= best)) best = y;
        }
        return best;
    }
};

TEST(Ground, AMeshReturnsTheHighestTriangleBelowTheRay) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> number(-4.0, 4.0);
    for (int round = 0; round < 30; ++round) {
        Triangles mesh;
        const double size = round % 3 == 0 ? 4.0 : 0.5;  // many overlaps, or few of them
        for (int i = 0; i < 1 + round * 7; ++i) {
            const glm::dvec3 middle(number(random), number(random), number(random));
            glm::dvec3 corners[3];
            for (glm::dvec3& corner : corners) {
                corner = middle;
                for (int k = 0; k < 3; ++k) corner[k] += size * 0.25 * number(random);
            }
            mesh.add(corners[0], corners[1], corners[2]);
        }
        const Ground ground = mesh.ground();
        int hits = 0;
        for (int i = 0; i < 300; ++i) {
            const double x = number(random), z = number(random), from = number(random);
            const auto hit = ground.below({x, from, z});
            const double expected = mesh.height(x, z, from);
            ASSERT_EQ(hit.has_value(), !std::isnan(expected));
            if (!hit) continue;
            ++hits;
            EXPECT_NEAR(hit->height, expected, 1e-6);
            EXPECT_GE(hit->normal.y, 0.0);
            EXPECT_NEAR(glm::length(hit->normal), 1.0, 1e-9);
        }
        if (round > 5) {
            EXPECT_GT(hits, 0);
        }
    }
}

TEST(Ground, ATerrainAndItsMeshAreEqualWithoutGaps) {
    HeightField field{.x = -1.0, .z = -2.0, .cell = 0.25, .columns = 33, .heights = {}};
    const auto wave = [](double x, double z) { return 0.2 * std::sin(1.3 * x) * std::cos(0.9 * z); };
    for (int row = 0; row < 41; ++row)
        for (int column = 0; column < 33; ++column)
            field.heights.push_back(wave(-1.0 + 0.25 * column, -2.0 + 0.25 * row));
    const Ground terrain = *Ground::terrain(field);
    Triangles mesh;
    const auto corner = [&](int column, int row) {
        const double x = -1.0 + 0.25 * column, z = -2.0 + 0.25 * row;
        return glm::dvec3(x, wave(x, z), z);
    };
    for (int row = 0; row < 40; ++row)
        for (int column = 0; column < 32; ++column) {
            mesh.add(corner(column, row), corner(column + 1, row), corner(column, row + 1));
            mesh.add(corner(column + 1, row + 1), corner(column + 1, row), corner(column, row + 1));
        }
    const Ground ground = mesh.ground();
    for (double x = -1.0; x <= 7.0; x += 0.03125)  // hits many edges and corners
        for (double z = -2.0; z <= 8.0; z += 0.03125) {
            const auto a = terrain.below({x, 5, z}), b = ground.below({x, 5, z});
            ASSERT_TRUE(a) << x << ' ' << z;
            ASSERT_TRUE(b) << x << ' ' << z;
            EXPECT_NEAR(a->height, wave(x, z), 0.004);
            EXPECT_NEAR(a->height, b->height, 0.004);
            EXPECT_GT(glm::dot(a->normal, b->normal), 0.995);
        }
    EXPECT_FALSE(terrain.below({-1.01, 5, 0}));
    EXPECT_FALSE(ground.below({-1.01, 5, 0}));
}

TEST(Ground, ALargeMeshWithOneHugeTriangleStaysSmall) {
    Triangles mesh;
    for (int i = 0; i < 100; ++i)
        for (int k = 0; k < 100; ++k) {
            const double x = 0.01 * i, z = 0.01 * k;
            mesh.add({x, 0.1, z}, {x + 0.01, 0.1, z}, {x, 0.1, z + 0.01});
        }
    mesh.add({-5e5, 0, -5e5}, {5e5, 0, -5e5}, {0, 0, 5e5});
    const Ground ground = mesh.ground();
    EXPECT_NEAR(height(ground, 0.001, 0.001), 0.1, 1e-12);
    EXPECT_NEAR(height(ground, 1000.0, -1000.0), 0.0, 1e-6);
    EXPECT_NEAR(ground.highest(0.001, 0.001)->height, 0.1, 1e-12);
    EXPECT_NEAR(height(ground, 0.001, 0.001, 0.05), 0.0, 1e-6) << "what is above the ray does not count";
}

}  // namespace
}  // namespace tendril::test
