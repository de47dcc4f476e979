// Surfaces before they are drawn: closed, smooth, and finite for any input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <random>

#include "app/view/surfaces.hpp"

namespace tendril::app::surfaces_test {
namespace {

using Points = std::vector<glm::vec3>;

const Rect viewport{{0.0f, 0.0f}, {800.0f, 600.0f}};
const glm::vec3 white{1.0f}, red{1.0f, 0.0f, 0.0f}, blue{0.0f, 0.0f, 1.0f};

Camera camera_at(float distance, bool orthographic = false) {
    return Camera({.yaw = 0.3f, .pitch = 0.2f, .distance = distance, .orthographic = orthographic}, viewport);
}

std::size_t outlines(const DrawList& list) {
    return static_cast<std::size_t>(
        std::count_if(list.strokes.begin(), list.strokes.end(),
                      [](const Stroke& stroke) { return stroke.shade == Shade::Edge; }));
}

/// Finite everywhere, indices in range, unit normals, and nothing pickable.
void expect_sound(const DrawList& list) {
    for (const Vertex& vertex : list.mesh.vertices) {
        const glm::vec3 p = vertex.position, c = vertex.colour + vertex.back;
        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z + c.x + c.y + c.z));
        ASSERT_NEAR(glm::length(vertex.normal), 1.0f, 1e-4f);
    }
    ASSERT_EQ(list.mesh.indices.size() % 3, 0u);
    for (const std::uint32_t index : list.mesh.indices) ASSERT_LT(index, list.mesh.vertices.size());
    for (const Stroke& stroke : list.strokes) {
        const glm::vec3 sum = stroke.a + stroke.b + stroke.normal;
        ASSERT_TRUE(std::isfinite(sum.x + sum.y + sum.z + stroke.radius_a + stroke.radius_b));
        ASSERT_TRUE(std::isfinite(stroke.mitre.x + stroke.mitre.y));
        ASSERT_EQ(stroke.pick, no_pick);
    }
}

/// Triangles must be anticlockwise seen from the side of their normals.
void expect_fronts_agree(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                     &c = mesh.vertices[mesh.indices[i + 2]];
        const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
        if (glm::length(face) < 1e-12f) continue;
        EXPECT_GT(glm::dot(face, a.normal + b.normal + c.normal), 0.0f);
    }
}

Points hanging(int links) {
    Points points;
    for (int i = 0; i <= links; ++i) {
        const float t = 2.0f * static_cast<float>(i) / static_cast<float>(links) - 1.0f;
        points.emplace_back(t, t * t + 0.5f, 0.2f * std::sin(3.0f * t));
    }
    return points;
}

TEST(DrawList, ClearKeepsItsMemory) {
    DrawList list;
    tube(list, camera_at(3.0f), hanging(30), 0.05f, 16, {});
    const std::size_t vertices = list.mesh.vertices.capacity(), indices = list.mesh.indices.capacity();
    ASSERT_GT(vertices, 100u);
    list.clear();
    EXPECT_TRUE(list.mesh.vertices.empty() && list.mesh.indices.empty() && list.strokes.empty());
    EXPECT_EQ(list.mesh.vertices.capacity(), vertices);
    EXPECT_EQ(list.mesh.indices.capacity(), indices);
}

TEST(Tube, IsRoundAboutItsAxis) {
    for (const bool orthographic : {false, true}) {
        const Camera camera = camera_at(2.0f, orthographic);
        DrawList list;
        tube(list, camera, Points{{-0.5f, 0, 0}, {-0.1f, 0, 0}, {0.5f, 0, 0}}, 0.1f, 24, {});
        expect_sound(list);
        expect_fronts_agree(list.mesh);
        ASSERT_GT(list.mesh.indices.size(), 100u);
        for (const Vertex& vertex : list.mesh.vertices) {
            const glm::vec3 axis(std::clamp(vertex.position.x, -0.5f, 0.5f), 0.0f, 0.0f);
            const glm::vec3 out = vertex.position - axis;
            // Half a pixel is reserved for its outline.
            const float radius = 0.1f - 0.5f * camera.metres_per_pixel(axis);
            EXPECT_NEAR(glm::length(out), radius, 1e-5f) << "also at the caps, which are half balls";
            const glm::vec3 sight = orthographic ? -camera.forward() : camera.eye() - vertex.position;
            if (glm::dot(out, sight) < 0.0f) continue;  // not visible
            EXPECT_GT(glm::dot(glm::normalize(out), vertex.normal), 0.98f) << "nearly: see tube.cpp";
        }
    }
}

TEST(Tube, NormalsChangeSteadilyAlongIt) {
    DrawList list;
    const int sides = 16;
    tube(list, camera_at(3.0f), hanging(20), 0.1f, sides, {});
    expect_sound(list);
    expect_fronts_agree(list.mesh);
    const std::vector<Vertex>& vertices = list.mesh.vertices;
    ASSERT_EQ(vertices.size() % sides, 0u);
    for (std::size_t i = sides; i < vertices.size(); ++i)
        EXPECT_LT(glm::distance(vertices[i].normal, vertices[i - sides].normal), 0.5f);
}

TEST(Tube, HasTheRequestedSidesOrAsManyAsAreVisible) {
    DrawList near, three, far;
    tube(near, camera_at(1.0f), Points{{0, 0, 0}, {0.1f, 0, 0}}, 0.1f, 40, {});
    EXPECT_EQ(near.mesh.vertices.size() % 40, 0u);
    tube(three, camera_at(1.0f), Points{{0, 0, 0}, {0.1f, 0, 0}}, 0.1f, 3, {});
    EXPECT_EQ(three.mesh.vertices.size() % 3, 0u);
    EXPECT_LT(three.mesh.vertices.size(), 20u);
    tube(far, camera_at(20.0f), Points{{0, 0, 0}, {1, 0, 0}}, 0.1f, 40, {});
    EXPECT_LT(far.mesh.vertices.size(), near.mesh.vertices.size() / 2);
}

TEST(Tube, HasTheColoursOfItsCentres) {
    DrawList list;
    tube(list, camera_at(2.0f), Points{{-0.5f, 0, 0}, {0.5f, 0, 0}}, 0.1f, 16, Points{red, blue});
    for (const Vertex& vertex : list.mesh.vertices) {
        const float t = std::clamp(vertex.position.x + 0.5f, 0.0f, 1.0f);
        EXPECT_LT(glm::distance(vertex.colour, glm::mix(red, blue, t)), 1e-5f);
    }
    DrawList one;
    tube(one, camera_at(2.0f), Points{{-0.5f, 0, 0}, {0.5f, 0, 0}}, 0.1f, 16, Points{red});
    for (const Vertex& vertex : one.mesh.vertices) EXPECT_EQ(vertex.colour, red);
}

TEST(Tube, BecomesThreadsWhereItIsThinnerThanTwoPixels) {
    DrawList list;
    tube(list, camera_at(100.0f), hanging(10), 0.005f, 16, Points{red});
    EXPECT_TRUE(list.mesh.indices.empty());
    EXPECT_GE(outlines(list), 5u);
    expect_sound(list);
}

TEST(Tube, CastsItsShadowByInvisibleStrokes) {
    DrawList list;
    tube(list, camera_at(3.0f), hanging(20), 0.05f, 16, {});
    int casting = 0;
    for (const Stroke& stroke : list.strokes) {
        EXPECT_EQ(stroke.shadow, stroke.colour.a == 0.0f);
        casting += stroke.shadow;
    }
    EXPECT_EQ(casting, 20);
}

TEST(Tube, MovesSmoothlyWithItsCentres) {
    const Camera camera = camera_at(30.0f);  // where no span needs to be divided
    Points centres = hanging(24);
    DrawList before;
    tube(before, camera, centres, 0.05f, 12, {});
    for (int frame = 0; frame < 300; ++frame) {
        for (std::size_t i = 0; i < centres.size(); ++i) {
            const float swing =
                1e-3f * std::sin(0.1f * static_cast<float>(frame) + 0.2f * static_cast<float>(i));
            centres[i] += glm::vec3(swing, 0.5f * swing, -swing);
        }
        DrawList after;
        tube(after, camera, centres, 0.05f, 12, {});
        ASSERT_EQ(after.mesh.vertices.size(), before.mesh.vertices.size());
        for (std::size_t i = 0; i < after.mesh.vertices.size(); ++i)
            ASSERT_LT(glm::distance(after.mesh.vertices[i].position, before.mesh.vertices[i].position),
                      0.004f);
        before = std::move(after);
    }
}

TEST(Tube, IsFiniteForAnyInput) {
    const float nan = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
    const float odd[]{nan, infinite, -infinite, 1e38f, -1e30f, 1e9f, 1e-38f, 0.0f, -0.0f, 1.0f};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
    std::uniform_int_distribution<int> one_of(0, 9);
    for (int round = 0; round < 2000; ++round) {
        Points centres, colours;
        const int count = one_of(random);
        for (int i = 0; i < count; ++i) {
            const int kind = one_of(random);
            glm::vec3 point{coordinate(random), coordinate(random), coordinate(random)};
            if (kind < 2 && !centres.empty()) point = centres.back();                  // the same point twice
            if (kind == 2 && centres.size() > 1) point = centres[centres.size() - 2];  // straight back
            if (kind == 3 && !centres.empty()) point = centres.back() + 1e-7f * point;
            if (kind == 4) point[one_of(random) % 3] = odd[one_of(random)];
            if (kind == 5 && centres.size() > 1) point = 2.0f * centres.back() - centres[centres.size() - 2];
            centres.push_back(point);
            colours.push_back(glm::abs(glm::vec3(coordinate(random))));
        }
        const float radii[]{0.1f, 0.01f, 1e-4f, 1.0f, 0.0f, -1.0f, nan, infinite, 1e20f, 1e8f};
        DrawList list;
        const float radius = radii[one_of(random)];
        tube(list, camera_at(3.0f, round % 2 == 0), centres, radius, one_of(random) * 8 - 8, colours);
        expect_sound(list);
        if (HasFatalFailure()) FAIL() << "round " << round;
    }
}

TEST(Box, HasSixFacesThatLookOutwards) {
    const glm::vec3 centre(0.2f, 0.5f, -0.1f), half(0.4f, 0.2f, 0.3f);
    const glm::quat turn = glm::angleAxis(0.1f, glm::normalize(glm::vec3(1, 2, 3)));
    DrawList list;
    box(list, camera_at(5.0f), centre, half, turn, red);
    expect_sound(list);
    expect_fronts_agree(list.mesh);
    EXPECT_EQ(list.mesh.indices.size(), 36u);
    for (const Vertex& vertex : list.mesh.vertices) {
        const glm::vec3 local = glm::conjugate(turn) * (vertex.position - centre);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::abs(local[i]), half[i], 0.01f);
        EXPECT_GT(glm::dot(vertex.normal, vertex.position - centre), 0.0f);
    }
    EXPECT_EQ(outlines(list), 9u) << "a corner towards the eye: three creases, six outlines";
}

TEST(Box, IsFiniteForAnyInput) {
    const float nan = std::nanf("");
    for (const float bad : {nan, INFINITY, -1e30f, 0.0f, -0.5f, 1e9f}) {
        DrawList list;
        const Camera camera = camera_at(3.0f);
        box(list, camera, {bad, 0, 0}, glm::vec3(0.5f), glm::quat(1, 0, 0, 0), red);
        box(list, camera, {0, 0, 0}, {0.5f, bad, 0.5f}, glm::quat(1, 0, 0, 0), red);
        box(list, camera, {0, 0, 0}, glm::vec3(0.5f), glm::quat(bad, 0, 0, 0), red);
        box(list, camera, {0, 0, 0}, glm::vec3(bad), glm::quat(0.5f, 0.5f, 0, 0), red);
        plane_patch(list, camera, {0, bad, 0}, {0, 1, 0}, 1.0f, red);
        plane_patch(list, camera, {0, 1, 0}, {0, bad, 0}, 1.0f, red);
        plane_patch(list, camera, {0, 1, 0}, {1, 1, 0}, bad, red);
        expect_sound(list);
    }
}

struct Cloth {
    int columns = 5, rows = 4;
    Points positions;
    std::vector<std::uint8_t> cells;

    Cloth() : cells(12, ClothGrid::whole) {
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c)
                positions.emplace_back(0.1f * static_cast<float>(c), -0.1f * static_cast<float>(r), 0.0f);
    }
    DrawList drawn(const Points& colours = {}) const {
        DrawList list;
        cloth_surface(list, Camera({.distance = 2.0f}, viewport), {columns, rows, positions, cells}, red,
                      blue, colours);
        expect_sound(list);
        expect_fronts_agree(list.mesh);
        return list;
    }
};

TEST(Sheet, HasTwoTrianglesPerCellAndAnOutline) {
    const DrawList list = Cloth().drawn();
    EXPECT_EQ(list.mesh.indices.size(), 12u * 6);
    EXPECT_EQ(outlines(list), 2u * (4 + 3));
    for (const Vertex& vertex : list.mesh.vertices) {
        EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1)) << "columns to the right, rows down: the front";
        EXPECT_EQ(vertex.colour, red);
        EXPECT_EQ(vertex.back, blue);
    }
}

TEST(Sheet, HasHolesWhereItIsTorn) {
    Cloth cloth;
    cloth.cells[5] = 0;
    DrawList list = cloth.drawn();
    EXPECT_EQ(list.mesh.indices.size(), 11u * 6);
    EXPECT_EQ(outlines(list), 14u + 4);
    cloth.cells[5] = ClothGrid::upper;
    list = cloth.drawn();
    EXPECT_EQ(list.mesh.indices.size(), 11u * 6 + 3);
    EXPECT_EQ(outlines(list), 14u + 3);
    cloth.cells[5] = ClothGrid::lower;
    EXPECT_EQ(outlines(cloth.drawn()), 14u + 3);
    cloth.cells.assign(12, 0);
    list = cloth.drawn();
    EXPECT_TRUE(list.mesh.indices.empty());
    EXPECT_EQ(outlines(list), 0u);
}

TEST(Sheet, OmitsNonFinitePoints) {
    Cloth cloth;
    cloth.positions[6].y = std::nanf("");
    cloth.positions[19].x = INFINITY;
    const DrawList list = cloth.drawn();
    EXPECT_EQ(list.mesh.indices.size(), 3u * (24 - 6 - 1));
    cloth.positions.pop_back();
    EXPECT_TRUE(cloth.drawn().mesh.vertices.empty()) << "nor draws one with too few points";
}

TEST(Sheet, AFoldHasAnOutlineInTheColourOfTheNearerSide) {
    // A strip that comes towards the eye and folds back: at the fold, one half shows its front, and the back
    // of the other is behind that.
    Cloth cloth;
    cloth.columns = 3;
    cloth.rows = 2;
    for (const bool towards : {true, false}) {
        const float z = towards ? 0.2f : -0.2f;
        cloth.positions = {{0, 0, 0.0f},     {0.3f, 0, 0.5f * z},     {0.05f, 0, z},
                           {0, -0.1f, 0.0f}, {0.3f, -0.1f, 0.5f * z}, {0.05f, -0.1f, z}};
        cloth.cells.assign(2, ClothGrid::whole);
        const DrawList list = cloth.drawn();
        int folds = 0;
        for (const Stroke& stroke : list.strokes) {
            if (stroke.shade != Shade::Edge || stroke.a.x != 0.3f || stroke.b.x != 0.3f) continue;
            ++folds;
            EXPECT_EQ(glm::vec3(stroke.colour), towards ? blue : red);
        }
        EXPECT_EQ(folds, 1);
    }
}

TEST(Sheet, NormalsWeighTrianglesByTheirArea) {
    Cloth cloth;
    cloth.columns = 3;
    cloth.rows = 2;
    // A large cell facing up and a small one facing the eye meet in the middle.
    cloth.positions = {{0, 0, 0}, {1, 0, 0}, {1, -0.01f, 0}, {0, 0, 1}, {1, 0, 1}, {1, -0.01f, 1}};
    cloth.cells.assign(2, ClothGrid::whole);
    DrawList list;
    cloth_surface(list, camera_at(3.0f), {3, 2, cloth.positions, cloth.cells}, red, blue);
    EXPECT_GT(std::abs(list.mesh.vertices[1].normal.y), 0.999f);
}

TEST(Sheet, CanHaveAColourForEachPoint) {
    Points colours(20, white);
    colours[7] = red;
    const DrawList list = Cloth().drawn(colours);
    EXPECT_EQ(list.mesh.vertices[7].colour, red);
    EXPECT_EQ(list.mesh.vertices[7].back, red);
    EXPECT_EQ(list.mesh.vertices[8].colour, white);
}

TEST(PlanePatch, IsFlatAndOnTheGroundOnlyARim) {
    const glm::vec3 point(0.1f, 0.6f, 0.2f), normal = glm::normalize(glm::vec3(1, 2, 0.5f));
    DrawList list;
    plane_patch(list, camera_at(5.0f), point, 3.0f * normal, 0.8f, red);
    expect_sound(list);
    expect_fronts_agree(list.mesh);
    ASSERT_FALSE(list.mesh.indices.empty());
    for (const Vertex& vertex : list.mesh.vertices) {
        EXPECT_NEAR(glm::dot(vertex.position - point, normal), 0.0f, 1e-5f);
        EXPECT_LE(glm::distance(vertex.position, point), 0.8001f);
    }
    DrawList ground;
    plane_patch(ground, camera_at(5.0f), {2, 0, 1}, {0, 1, 0}, 3.0f, red);
    EXPECT_TRUE(ground.mesh.indices.empty()) << "it would hide the shadows";
    EXPECT_GT(outlines(ground), 30u);
}

}  // namespace
}  // namespace tendril::app::surfaces_test

namespace tendril::app {
namespace {

// The curve passes through its points smoothly, and its frames rotate no more than it bends.

using Points = std::vector<glm::vec3>;

Points random_walk(std::mt19937& random, int count) {
    std::normal_distribution<float> step(0.0f, 0.3f);
    Points points{glm::vec3(0.0f)};
    glm::vec3 direction(1.0f, 0.0f, 0.0f);
    for (int i = 1; i < count; ++i) {
        direction = glm::normalize(direction + glm::vec3{step(random), step(random), step(random)});
        points.push_back(points.back() + 0.1f * direction);
    }
    return points;
}

/// Ten curve points per span, with their frames.
std::vector<CurvePoint> curve_through(const Points& points) {
    std::vector<CurvePoint> curve;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const CurveSpan span = curve_span(points, i);
        for (int k = curve.empty() ? 0 : 1; k <= 10; ++k) {
            const float t = 0.1f * static_cast<float>(k);
            curve.push_back({.at = span.at(t), .tangent = glm::normalize(span.slope(t))});
        }
    }
    set_frames(curve);
    return curve;
}

TEST(Spline, PassesThroughItsPointsWithoutKinks) {
    std::mt19937 random(1);
    const Points points = random_walk(random, 40);
    for (std::size_t i = 0; i + 2 < points.size(); ++i) {
        const CurveSpan before = curve_span(points, i), after = curve_span(points, i + 1);
        EXPECT_EQ(before.at(0.0f), points[i]);
        EXPECT_LT(glm::distance(before.at(1.0f), points[i + 1]), 1e-6f);
        EXPECT_GT(glm::dot(glm::normalize(before.slope(1.0f)), glm::normalize(after.slope(0.0f))), 0.99999f);
    }
}

TEST(Spline, SlopeIsTheDerivative) {
    const Points points{{0, 0, 0}, {1, 0, 0}, {1.2f, 0.7f, 0}, {1, 1, 1}};
    for (std::size_t i = 0; i < 3; ++i) {
        const CurveSpan span = curve_span(points, i);
        for (const float t : {0.1f, 0.4f, 0.8f}) {
            const glm::vec3 difference = (span.at(t + 0.01f) - span.at(t - 0.01f)) / 0.02f;
            EXPECT_LT(glm::distance(difference, span.slope(t)), 1e-3f);
        }
    }
}

TEST(Spline, ACircleThroughFewPointsIsRound) {
    Points points;
    for (int i = 0; i < 16; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / 12.0f;
        points.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
    }
    for (std::size_t i = 1; i + 2 < points.size(); ++i)
        EXPECT_NEAR(glm::length(curve_span(points, i).at(0.5f)), 1.0f, 0.002f);
}

TEST(Spline, AStraightLineStaysStraightForAnySpacing) {
    const Points points{{0, 0, 0}, {0.01f, 0, 0}, {1, 0, 0}, {1.001f, 0, 0}, {5, 0, 0}};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const CurveSpan span = curve_span(points, i);
        EXPECT_NEAR(span.turn(), 0.0f, 1e-5f);
        float last = span.a.x;
        for (int k = 1; k <= 10; ++k) {
            const float x = span.at(0.1f * static_cast<float>(k)).x;
            EXPECT_GE(x, last) << "and does not turn back";
            last = x;
        }
    }
}

TEST(Spline, FramesAreOrthogonalAndRotateNoMoreThanTheCurve) {
    std::mt19937 random(2);
    for (int round = 0; round < 50; ++round) {
        const std::vector<CurvePoint> curve = curve_through(random_walk(random, 30));
        for (std::size_t i = 0; i < curve.size(); ++i) {
            ASSERT_NEAR(glm::length(curve[i].normal), 1.0f, 1e-5f);
            ASSERT_NEAR(glm::dot(curve[i].normal, curve[i].tangent), 0.0f, 1e-5f);
            if (i == 0) continue;
            const float bend = glm::distance(curve[i].tangent, curve[i - 1].tangent);
            const float turn = glm::distance(curve[i].normal, curve[i - 1].normal);
            EXPECT_LE(turn, 1.1f * bend + 1e-4f);
        }
    }
}

TEST(Spline, InAPlaneFramesDoNotTwist) {
    Points points;
    for (int i = 0; i <= 30; ++i) {
        const float t = 0.3f * static_cast<float>(i);
        points.emplace_back(t, std::sin(t), 0.0f);
    }
    const std::vector<CurvePoint> curve = curve_through(points);
    for (const CurvePoint& point : curve) EXPECT_NEAR(point.normal.z, curve[0].normal.z, 1e-3f);
}

TEST(Spline, OnALoopInSpaceFramesAreWithinTheMethodsError) {
    // Relative to a helix, a frame without twist rotates against its torsion: for (cos t, sin t, c t) the
    // angle is t c / sqrt(1 + c^2).
    const float c = 0.5f, speed = std::sqrt(1.0f + c * c);
    std::vector<CurvePoint> curve;
    for (int i = 0; i <= 40; ++i) {
        const float t = 0.2f * static_cast<float>(i);
        curve.push_back({.at = {std::cos(t), std::sin(t), c * t},
                         .tangent = glm::vec3(-std::sin(t), std::cos(t), c) / speed});
    }
    set_frames(curve);
    const auto angle = [&](std::size_t i) {  // from the principal normal, about the tangent
        const float t = 0.2f * static_cast<float>(i);
        const glm::vec3 inward(-std::cos(t), -std::sin(t), 0.0f);
        const glm::vec3 across = glm::cross(curve[i].tangent, inward);
        return std::atan2(glm::dot(curve[i].normal, across), glm::dot(curve[i].normal, inward));
    };
    const float wanted = -8.0f * c / speed;
    EXPECT_NEAR(std::remainder(angle(40) - angle(0) - wanted, glm::two_pi<float>()), 0.0f, 1e-3f);
}

TEST(Spline, FramesMoveSmoothlyWithTheCurve) {
    std::mt19937 random(3);
    std::normal_distribution<float> small(0.0f, 1e-4f);
    for (int round = 0; round < 50; ++round) {
        Points points = random_walk(random, 20);
        if (round % 2 == 1)  // like hanging ropes
            for (glm::vec3& point : points) point = {point.y, -point.x, point.z};
        const std::vector<CurvePoint> before = curve_through(points);
        for (glm::vec3& point : points) point += glm::vec3{small(random), small(random), small(random)};
        const std::vector<CurvePoint> after = curve_through(points);
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_LT(glm::distance(before[i].normal, after[i].normal), 0.1f);
    }
}

}  // namespace
}  // namespace tendril::app
