// The camera's mathematics: pixels and rays agree, moves have their effects, and no pose breaks it.
#include "app/view/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <vector>

namespace tendril::app {
namespace {

const Rect wide{{272.0f, 40.0f}, {1008.0f, 640.0f}};

std::vector<CameraPose> poses() {
    std::vector<CameraPose> result;
    for (const bool orthographic : {false, true})
        for (const float pitch : {-1.5707964f, -0.4f, 0.0f, 0.7f, 1.5707964f})
            for (const float yaw : {-3.0f, 0.0f, 0.5f, 2.2f})
                result.push_back({.target = {1.0f, 2.0f, -3.0f},
                                  .yaw = yaw,
                                  .pitch = pitch,
                                  .distance = 7.0f,
                                  .orthographic = orthographic});
    return result;
}

bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

TEST(Camera, LooksWhereThePoseSays) {
    const Camera ahead({.yaw = 0.0f, .pitch = 0.0f}, wide);
    EXPECT_NEAR(glm::distance(ahead.forward(), glm::vec3(0, 0, -1)), 0.0f, 1e-6f);
    const Camera above({.pitch = 0.5f}, wide);
    EXPECT_GT(above.eye().y, 0.0f) << "a positive pitch is above the target";
    EXPECT_LT(above.forward().y, 0.0f);
    for (const CameraPose& pose : poses()) {
        const Camera camera(pose, wide);
        EXPECT_NEAR(glm::dot(camera.right(), camera.up()), 0.0f, 1e-6f);
        EXPECT_NEAR(glm::distance(glm::cross(camera.right(), camera.up()), -camera.forward()), 0.0f, 1e-6f);
        EXPECT_GE(camera.up().y, -1e-6f) << "never upside down";
    }
}

TEST(Camera, ProjectsTheTargetToTheMiddle) {
    for (const CameraPose& pose : poses()) {
        const auto pixel = Camera(pose, wide).project(pose.target);
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(glm::distance(*pixel, wide.centre()), 0.0f, 1e-2f);
    }
}

TEST(Camera, RayThroughAProjectedPointMeetsThePoint) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> offset(-2.0f, 2.0f);
    for (const CameraPose& pose : poses()) {
        const Camera camera(pose, wide);
        for (int i = 0; i < 20; ++i) {
            glm::vec3 point = pose.target + glm::vec3{offset(random), offset(random), offset(random)};
            if (pose.orthographic) point -= 7.0f * camera.forward();  // nearer than the camera's own place
            const auto pixel = camera.project(point);
            ASSERT_TRUE(pixel);
            const Ray ray = camera.ray(*pixel);
            EXPECT_NEAR(glm::length(ray.direction), 1.0f, 1e-5f);
            const glm::vec3 to_point = point - ray.origin;
            const float miss = glm::length(to_point - ray.direction * glm::dot(to_point, ray.direction));
            EXPECT_LT(miss, 2e-4f);
            const auto found = camera.on_plane(*pixel, point, camera.forward());
            ASSERT_TRUE(found);
            EXPECT_LT(glm::distance(*found, point), 2e-4f);
        }
    }
}

TEST(Camera, AgreesWithItsOwnMatrices) {
    for (const CameraPose& pose : poses()) {
        const Camera camera(pose, wide);
        const glm::vec3 point = pose.target + glm::vec3(0.3f, -0.7f, 0.5f);
        const glm::vec4 clip = camera.projection() * camera.view() * glm::vec4(point, 1.0f);
        const glm::vec2 ndc = glm::vec2(clip) / clip.w;
        const glm::vec2 expected = wide.centre() + 0.5f * wide.size() * glm::vec2(ndc.x, -ndc.y);
        EXPECT_LT(glm::distance(*camera.project(point), expected), 0.02f);
    }
}

TEST(Camera, OrthographicShowsTheTargetsPlaneAtTheSameSize) {
    CameraPose pose{.target = {1, 2, 3}, .yaw = 0.4f, .pitch = 0.3f, .distance = 9.0f};
    const Camera perspective(pose, wide);
    pose.orthographic = true;
    const Camera orthographic(pose, wide);
    const glm::vec3 beside = pose.target + 1.5f * perspective.right() - 0.6f * perspective.up();
    EXPECT_LT(glm::distance(*perspective.project(beside), *orthographic.project(beside)), 0.02f);
    EXPECT_NEAR(perspective.metres_per_pixel(beside), orthographic.metres_per_pixel(beside), 1e-6f);
}

TEST(Camera, NothingBehindTheEyeHasAPixelInPerspective) {
    const Camera camera({.distance = 5.0f}, wide);
    EXPECT_FALSE(camera.project(camera.eye() - camera.forward()));
    EXPECT_FALSE(camera.project(camera.eye()));
    EXPECT_FALSE(camera.on_plane(wide.centre(), camera.eye() - camera.forward(), camera.forward()));
    EXPECT_FALSE(camera.on_plane(wide.centre(), {0, 0, 0}, camera.right())) << "edge on";
}

TEST(Camera, ZoomKeepsThePointUnderTheCursor) {
    for (const CameraPose& pose : poses()) {
        const Camera camera(pose, wide);
        for (const glm::vec2 cursor : {glm::vec2(300, 60), glm::vec2(900, 600), wide.centre()}) {
            const auto point = camera.on_plane(cursor, pose.target, camera.forward());
            ASSERT_TRUE(point);
            for (const float notches : {-3.0f, 1.0f, 7.5f}) {
                const CameraPose moved = zoomed(camera, cursor, notches);
                EXPECT_NEAR(moved.distance, pose.distance * std::pow(1.15f, -notches), 1e-3f);
                EXPECT_LT(glm::distance(*Camera(moved, wide).project(*point), cursor), 0.05f);
            }
        }
    }
}

TEST(Camera, PanMovesTheTargetWithTheMouse) {
    for (const CameraPose& pose : poses()) {
        const Camera camera(pose, wide);
        const Camera moved(panned(camera, {37.0f, -21.0f}), wide);
        const auto pixel = moved.project(pose.target);
        ASSERT_TRUE(pixel);
        EXPECT_LT(glm::distance(*pixel, wide.centre() + glm::vec2(37.0f, -21.0f)), 0.05f);
    }
}

TEST(Camera, OrbitStopsAtThePoles) {
    const CameraPose pose{.pitch = 0.3f};
    EXPECT_NEAR(orbited(pose, {0.0f, 1e6f}).pitch, 1.5707964f, 1e-6f);
    EXPECT_NEAR(orbited(pose, {0.0f, -1e6f}).pitch, -1.5707964f, 1e-6f);
    EXPECT_GT(orbited(pose, {0.0f, 10.0f}).pitch, pose.pitch) << "dragging down raises the camera";
    EXPECT_LE(std::abs(orbited(pose, {1e6f, 0.0f}).yaw), 3.1415930f);
}

TEST(Camera, FramedFitsTheWholeSphere) {
    for (const Rect& viewport : {wide, Rect{{0, 0}, {300, 900}}}) {
        for (const CameraPose& pose : poses()) {
            const glm::vec3 centre(-4.0f, 1.0f, 2.0f);
            const float radius = 3.0f;
            const CameraPose moved = framed(pose, viewport, centre, radius);
            EXPECT_EQ(moved.yaw, pose.yaw);
            const Camera camera(moved, viewport);
            float most = 0.0f;
            for (int i = 0; i < 64; ++i) {
                const float angle = 0.0981748f * static_cast<float>(i);
                // Where lines of sight touch the sphere, which is nearer than its centre.
                const float nearer = moved.orthographic ? 0.0f : radius * radius / moved.distance;
                const float rim = std::sqrt(radius * radius - nearer * nearer);
                const glm::vec3 point =
                    centre - camera.forward() * nearer +
                    rim * (camera.right() * std::cos(angle) + camera.up() * std::sin(angle));
                const glm::vec2 away = glm::abs(*camera.project(point) - viewport.centre());
                most = std::max(most, std::max(away.x, away.y));
            }
            const float room = 0.5f * std::min(viewport.size().x, viewport.size().y);
            EXPECT_LE(most, room);
            EXPECT_GE(most, 0.7f * room) << "and not much smaller than it could be";
        }
    }
}

TEST(Camera, FixedViewsLookAlongTheAxes) {
    const auto forward = [](FixedView view) {
        return Camera(turned_to({.yaw = 1.0f}, view), wide).forward();
    };
    EXPECT_LT(glm::distance(forward(FixedView::Front), glm::vec3(0, 0, -1)), 1e-6f);
    EXPECT_LT(glm::distance(forward(FixedView::Side), glm::vec3(-1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(forward(FixedView::Top), glm::vec3(0, -1, 0)), 1e-6f);
    const Camera top(turned_to({}, FixedView::Top), wide);
    EXPECT_LT(glm::distance(top.right(), glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(top.up(), glm::vec3(0, 0, -1)), 1e-6f);
}

TEST(Camera, HostilePosesStayFinite) {
    const float infinite = std::numeric_limits<float>::infinity(), nan = std::nanf("");
    for (const float bad : {nan, infinite, -infinite, 0.0f, -1.0f, 1e38f, -1e38f, 1e-38f})
        for (const bool orthographic : {false, true}) {
            const CameraPose pose{.target = {bad, bad, bad},
                                  .yaw = bad,
                                  .pitch = bad,
                                  .distance = bad,
                                  .field_of_view = bad,
                                  .orthographic = orthographic};
            for (const Rect& viewport : {wide, Rect{}, Rect{{bad, 0}, {bad, 0}}, Rect{{10, 10}, {5, 5}}}) {
                const Camera camera(pose, viewport);
                EXPECT_TRUE(finite(camera.eye()) && finite(camera.forward()));
                EXPECT_GT(camera.metres_per_pixel({0, 0, 0}), 0.0f);
                for (int i = 0; i < 16; ++i) {
                    EXPECT_TRUE(std::isfinite(camera.view()[i / 4][i % 4]));
                    EXPECT_TRUE(std::isfinite(camera.projection()[i / 4][i % 4]));
                }
                for (const CameraPose& moved :
                     {orbited(pose, {bad, bad}), panned(camera, {bad, bad}), zoomed(camera, {bad, bad}, bad),
                      framed(pose, viewport, {bad, bad, bad}, bad), turned_to(pose, FixedView::Top)}) {
                    EXPECT_TRUE(finite(moved.target));
                    EXPECT_TRUE(moved.distance >= 1e-3f && moved.distance <= 1e7f);
                    EXPECT_TRUE(std::isfinite(moved.yaw) && std::isfinite(moved.pitch));
                }
            }
        }
}

}  // namespace
}  // namespace tendril::app
