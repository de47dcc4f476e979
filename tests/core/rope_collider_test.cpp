// The four shapes of colliders: distances, normals, and no NaN.
#include <glm/gtc/quaternion.hpp>

#include "rope_support.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;
using rope::Box;
using rope::Capsule;
using rope::Plane;
using rope::Shape;
using rope::Sphere;
using rope::SurfaceDistance;

void expect_surface(const Shape& shape, const dvec3& point, double distance, const dvec3& normal) {
    const SurfaceDistance surface = surface_distance(shape, point);
    EXPECT_NEAR(surface.distance, distance, 1e-6);
    EXPECT_LE(glm::length(surface.normal - normal), 1e-6);
}

TEST(RopeCollider, DistanceAndNormalOfEachShape) {
    expect_surface(Sphere{{1, 0, 0}, 0.5f}, {3, 0, 0}, 1.5, {1, 0, 0});
    expect_surface(Sphere{{1, 0, 0}, 0.5f}, {1, -0.1, 0}, -0.4, {0, -1, 0});
    expect_surface(Capsule{{0, 0, 0}, {0, 2, 0}, 0.25f}, {1, 1, 0}, 0.75, {1, 0, 0});
    expect_surface(Capsule{{0, 0, 0}, {0, 2, 0}, 0.25f}, {0, 3, 0}, 0.75, {0, 1, 0});
    expect_surface(Plane{{0, 1, 0}, {0, 5, 0}}, {7, 3, 7}, 2.0, {0, 1, 0});
    expect_surface(Plane{{0, 1, 0}, {0, 5, 0}}, {7, 0, 7}, -1.0, {0, 1, 0});
    const Box box{{0, 0, 0}, {1, 2, 3}, glm::quat(1, 0, 0, 0)};
    expect_surface(box, {2, 0, 0}, 1.0, {1, 0, 0});
    expect_surface(box, {0.9, 0, 0}, -0.1, {1, 0, 0});
    expect_surface(box, {0, -1.9, 0}, -0.1, {0, -1, 0});
    expect_surface(box, {4, 6, 0}, 5.0, {0.6, 0.8, 0});  // 3, 4, 5 from an edge
    // A quarter turn about z: x and y are swapped.
    const Box turned{{0, 0, 0}, {1, 2, 3}, glm::angleAxis(static_cast<float>(pi) / 2, glm::vec3(0, 0, 1))};
    expect_surface(turned, {3, 0, 0}, 1.0, {1, 0, 0});
    expect_surface(turned, {0, 2, 0}, 1.0, {0, 1, 0});
}

/// Degenerate shapes of every kind: no size, no length, no unit rotation.
std::vector<Shape> thin_shapes() {
    return {Sphere{{1, 2, 3}, 0.0f},
            Capsule{{1, 2, 3}, {1, 2, 3}, 0.0f},
            Capsule{{1, 2, 3}, {1, 2, 3}, 0.5f},
            Capsule{{1, 2, 3}, {1, 3, 3}, 0.0f},
            Box{{1, 2, 3}, {0, 0, 0}, glm::quat(1, 0, 0, 0)},
            Box{{1, 2, 3}, {1, 0, 1}, glm::quat(0.1f, 0.2f, 0.3f, 0.4f)},
            Plane{{1, 2, 3}, {1e-6f, 0, 0}}};
}

TEST(RopeCollider, DegenerateShapesStillGiveANormal) {
    for (const Shape& shape : thin_shapes()) {
        const dvec3 middle(centre(shape));
        for (const dvec3& off :
             {dvec3(0.0), dvec3(1e-300, 0, 0), dvec3(0, 1e-13, 0), dvec3(0, 0, -1e-9), dvec3(0, 0.5, 0)}) {
            const SurfaceDistance surface = surface_distance(shape, middle + off);
            EXPECT_TRUE(std::isfinite(surface.distance)) << kind(shape);
            EXPECT_NEAR(glm::length(surface.normal), 1.0, 1e-9) << kind(shape);
        }
    }
}

/// From the centre, the axis, an edge or a corner: the distance along the normal leads to the surface.
TEST(RopeCollider, DistanceAndNormalLeadToTheSurface) {
    const Shape shapes[] = {Sphere{{0, 0, 0}, 0.5f}, Capsule{{-1, 0, 0}, {1, 0.5f, 0}, 0.3f},
                            Box{{0, 0, 0}, {0.5f, 0.5f, 0.5f}, glm::quat(0.9f, 0.1f, 0.2f, 0.3f)},
                            Plane{{0, 0.1f, 0}, {1, 2, 3}}};
    Random random(61);
    for (const Shape& shape : shapes) {
        for (int i = 0; i < 500; ++i) {
            dvec3 point = i == 0 ? dvec3(centre(shape)) : dvec3(random.point(1.5f));
            if (i % 5 == 1) point = dvec3(0.5, 0.5, 0.5) * static_cast<double>(random.around(1.0f));
            const SurfaceDistance surface = surface_distance(shape, point);
            const dvec3 on = point - surface.distance * surface.normal;
            EXPECT_NEAR(surface_distance(shape, on).distance, 0.0, 1e-7) << kind(shape);
            // No direction leads closer than the distance.
            const dvec3 aside = point + dvec3(random.point(1.0f)) * (0.5 * std::abs(surface.distance));
            EXPECT_LE(std::abs(surface_distance(shape, aside).distance - surface.distance),
                      glm::length(aside - point) + 1e-9)
                << kind(shape);
        }
    }
}

TEST(RopeCollider, MovesWithItsCentre) {
    Random random(62);
    for (const Shape& shape : thin_shapes()) {
        const glm::vec3 to = random.point(4.0f);
        EXPECT_LE(distance(centre(moved(shape, to)), to), 1e-6) << kind(shape);
        EXPECT_EQ(size(moved(shape, to)), size(shape));
        EXPECT_EQ(moved(shape, to).index(), shape.index());
    }
    EXPECT_EQ(size(Box{{0, 0, 0}, {3, 1, 2}, {}}), 1.0f);
    EXPECT_EQ(size(Plane{}), 1.0f);
}

}  // namespace
}  // namespace tendril::test
