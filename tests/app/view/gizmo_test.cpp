// Gizmos: the effect of dragging each part, from any camera and along any line of sight, and picking of
// parts.
#include "app/view/gizmo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <random>

#include "app/view/picking.hpp"

namespace tendril::app::gizmo_test {
namespace {

const Rect viewport{{0.0f, 0.0f}, {800.0f, 600.0f}};
constexpr Drag everything = Drag::Position | Drag::Rotation | Drag::Scale;

struct Chance {
    std::mt19937 random{20};
    float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); }
    glm::vec3 point(float size) {
        const float x = in(-size, size), y = in(-size, size), z = in(-size, size);
        return {x, y, z};
    }
    glm::quat rotation() {
        const float angle = in(-3.0f, 3.0f);
        return glm::angleAxis(angle, glm::normalize(point(1.0f) + glm::vec3(0.0f, 1e-3f, 0.0f)));
    }
    HandleFrame frame() {
        const glm::vec3 position = point(2.0f);
        const glm::quat turned = rotation();
        return {position, turned, {in(0.5f, 2.0f), 1.0f, 3.0f}};
    }
    Camera camera(bool orthographic) {
        const float yaw = in(-3.0f, 3.0f), pitch = in(-1.5f, 1.5f), distance = in(3.0f, 20.0f);
        return Camera({.target = point(1.0f),
                       .yaw = yaw,
                       .pitch = pitch,
                       .distance = distance,
                       .orthographic = orthographic},
                      viewport);
    }
    glm::vec2 pixel() {
        const float x = in(0.0f, 800.0f), y = in(0.0f, 600.0f);
        return {x, y};
    }
};

GizmoDrag caught(GizmoPart part, const HandleFrame& frame, const Camera& camera, glm::vec2 pixel) {
    const Gizmo gizmo{frame, everything};
    return GizmoDrag(part, frame, camera.ray(pixel), gizmo.reach(changed_by(part), camera),
                     camera.pose().orthographic);
}

glm::vec3 axis(const HandleFrame& frame, GizmoPart part) {
    glm::vec3 v(0.0f);
    v[axis_of(part)] = 1.0f;
    return frame.rotation * v;
}

bool finite(const HandleFrame& frame) {
    const glm::vec3 sum = frame.position + frame.scale;
    return std::isfinite(sum.x + sum.y + sum.z) && std::abs(glm::length(frame.rotation) - 1.0f) < 1e-4f;
}

TEST(GizmoDrag, ChangesWhatItsPartIsForAndNothingElse) {
    Chance chance;
    for (int round = 0; round < 4000; ++round) {
        const Camera camera = chance.camera(round % 2 == 0);
        const HandleFrame from = chance.frame();
        const auto part = static_cast<GizmoPart>(round % gizmo_parts);
        GizmoDrag drag = caught(part, from, camera, chance.pixel());
        const HandleFrame to = drag.to(camera.ray(chance.pixel()));
        const glm::vec3 by = to.position - from.position, upright = axis(from, part);
        if (changed_by(part) == Drag::Position) {
            const float off =
                is_plane(part) ? std::abs(glm::dot(by, upright)) : glm::length(glm::cross(by, upright));
            EXPECT_LE(off, 1e-4f * (1.0f + glm::length(by))) << name(part);
        } else {
            EXPECT_EQ(to.position, from.position) << name(part);
        }
        if (changed_by(part) == Drag::Rotation) {
            const glm::quat turn = glm::conjugate(from.rotation) * to.rotation;
            glm::vec3 rest(turn.x, turn.y, turn.z);
            rest[axis_of(part)] = 0.0f;
            EXPECT_LE(glm::length(rest), 1e-5f) << name(part);
        } else {
            EXPECT_NEAR(std::abs(glm::dot(to.rotation, from.rotation)), 1.0f, 1e-5f) << name(part);
        }
        for (int i = 0; i < 3; ++i) {
            const bool scaled = changed_by(part) == Drag::Scale && i == axis_of(part);
            if (!scaled) {
                EXPECT_EQ(to.scale[i], from.scale[i]) << name(part);
            }
            EXPECT_GT(to.scale[i], 0.0f) << name(part) << ": no drag makes anything flat";
        }
    }
}

/// The parent may have moved, rotated and scaled the handle since it was grabbed.
TEST(GizmoDrag, KeepsOtherPropertiesAsTheyAreNow) {
    Chance chance;
    for (int round = 0; round < 2000; ++round) {
        const Camera camera = chance.camera(round % 2 == 0);
        const HandleFrame from = chance.frame(), now = chance.frame();
        const auto part = static_cast<GizmoPart>(round % gizmo_parts);
        GizmoDrag drag = caught(part, from, camera, chance.pixel());
        const HandleFrame dragged = drag.to(camera.ray(chance.pixel()));
        const HandleFrame to = drag.changed(now, dragged);
        if (changed_by(part) != Drag::Rotation) {
            EXPECT_EQ(to.rotation, now.rotation) << name(part);
        } else {
            EXPECT_EQ(to.rotation, dragged.rotation) << name(part);
        }
        for (int i = 0; i < 3; ++i) {
            const bool scaled = changed_by(part) == Drag::Scale && i == axis_of(part);
            EXPECT_EQ(to.scale[i], scaled ? dragged.scale[i] : now.scale[i]) << name(part);
        }
        if (changed_by(part) != Drag::Position) {
            EXPECT_EQ(to.position, now.position) << name(part);
            continue;
        }
        const float size = 1e-4f * (1.0f + glm::length(now.position) + glm::length(dragged.position));
        const glm::vec3 upright = axis(from, part), by = to.position - now.position;
        const glm::vec3 off = to.position - dragged.position;  // from the pointer's position
        const float along = glm::dot(by, upright), missed = glm::dot(off, upright);
        if (is_plane(part)) {
            EXPECT_LE(std::abs(along), size) << name(part);
            EXPECT_LE(glm::length(off - missed * upright), size) << name(part);
        } else {
            EXPECT_LE(glm::length(by - along * upright), size) << name(part);
            EXPECT_LE(std::abs(missed), size) << name(part);
        }
    }
}

TEST(GizmoDrag, TheGrabbedPointStaysUnderThePointer) {
    Chance chance;
    int tried = 0;
    for (int round = 0; round < 4000; ++round) {
        const Camera camera = chance.camera(round % 2 == 0);
        const HandleFrame from = chance.frame();
        const auto part = static_cast<GizmoPart>(round % 6);  // those that move
        const glm::vec3 sight =
            camera.pose().orthographic ? camera.forward() : glm::normalize(from.position - camera.eye());
        const float along = std::abs(glm::dot(sight, axis(from, part)));
        if (is_plane(part) ? along < 0.4f : along > 0.9f) continue;  // not exact there, see below
        const auto middle = camera.project(from.position);
        if (!middle || !viewport.contains(*middle)) continue;
        // To the pixel of that exact point of the axis or plane.
        glm::vec3 by = chance.in(-0.8f, 0.8f) * axis(from, part);
        if (is_plane(part)) {
            const glm::vec3 any = chance.point(0.6f);
            by = any - glm::dot(any, axis(from, part)) * axis(from, part);
        }
        const auto there = camera.project(from.position + by);
        if (!there || camera.depth(from.position + by) < 0.7f * camera.depth(from.position)) continue;
        ++tried;
        GizmoDrag drag = caught(part, from, camera, *middle);
        const glm::vec3 moved = drag.to(camera.ray(*there)).position - from.position;
        EXPECT_LT(glm::distance(moved, by), 0.01f + 0.01f * glm::length(by)) << name(part) << " " << round;
    }
    EXPECT_GT(tried, 500);
}

TEST(GizmoDrag, ASmallMoveOfThePointerIsASmallMoveOfTheFrame) {
    Chance chance;
    for (int round = 0; round < 1200; ++round) {
        const Camera camera = chance.camera(round % 2 == 0);
        HandleFrame from = chance.frame();
        from.position = camera.pose().target;
        const auto part = static_cast<GizmoPart>(round % gizmo_parts);
        const bool plane = is_plane(part) || changed_by(part) == Drag::Rotation;
        // Pointing at the eye, or edge-on: where a plain intersection jumps.
        if (round % 3 == 0) {
            glm::vec3 local(0.0f), seen = plane ? camera.right() : camera.forward();
            local[axis_of(part)] = 1.0f;
            from.rotation = glm::quat(local, seen);
        }
        const glm::vec2 start = chance.pixel(), end = chance.pixel();
        GizmoDrag drag = caught(part, from, camera, start);
        HandleFrame last = from;
        const float pixel = camera.metres_per_pixel(from.position);
        constexpr int steps = 200;
        for (int i = 1; i <= steps; ++i) {
            const float share = static_cast<float>(i) / steps;
            const glm::vec2 at = start + share * (end - start);
            // Close to its centre a ring may turn fast.
            if (changed_by(part) == Drag::Rotation && glm::distance(at, {400.0f, 300.0f}) < 60.0f) break;
            const HandleFrame now = drag.to(camera.ray(at));
            const float moved = glm::distance(at, start + (share - 1.0f / steps) * (end - start));
            // A slant of 0.1 multiplies distances by ten, and perspective adds more for distant points.
            EXPECT_LT(glm::distance(now.position, last.position), (moved + 0.5f) * pixel * 300.0f)
                << name(part) << " " << round;
            if (changed_by(part) == Drag::Rotation) {
                EXPECT_GT(std::abs(glm::dot(now.rotation, last.rotation)), 0.7f)
                    << name(part) << " " << round;
            }
            last = now;
        }
    }
}

TEST(GizmoDrag, ARingCountsWholeTurns) {
    for (const bool orthographic : {false, true}) {
        const Camera camera({.distance = 6.0f, .orthographic = orthographic}, viewport);
        HandleFrame from;
        GizmoDrag drag = caught(GizmoPart::RotateZ, from, camera, {478.0f, 300.0f});
        HandleFrame now;
        constexpr int turns = 3, steps = 24;
        for (int i = 1; i <= turns * steps; ++i) {
            const float angle = glm::two_pi<float>() * static_cast<float>(i) / steps;
            now = drag.to(camera.ray({400.0f + 78.0f * std::cos(angle), 300.0f - 78.0f * std::sin(angle)}));
        }
        EXPECT_NEAR(glm::degrees(drag.turned()), 360.0 * turns, 1e-2);
        EXPECT_NEAR(std::abs(glm::dot(now.rotation, from.rotation)), 1.0f, 1e-5f);
        EXPECT_EQ(drag.text(now), "1080.0\u00b0 about Z");
        for (int i = turns * steps; i >= 0; --i) {
            const float angle = glm::two_pi<float>() * static_cast<float>(i) / steps;
            drag.to(camera.ray({400.0f + 78.0f * std::cos(angle), 300.0f - 78.0f * std::sin(angle)}));
        }
        EXPECT_NEAR(drag.turned(), 0.0, 1e-4) << "and back again";
    }
}

TEST(GizmoDrag, AnEdgeOnRingRotatesAsItsNearSideIsPulled) {
    const Camera camera({.distance = 6.0f}, viewport);  // y is up, so the ring about it is a line
    const Gizmo gizmo{{}, everything};
    const float radius = gizmo.reach(Drag::Rotation, camera) / camera.metres_per_pixel({});
    GizmoDrag drag = caught(GizmoPart::RotateY, {}, camera, {400.0f, 300.0f});
    drag.to(camera.ray({400.0f + radius, 300.0f}));
    EXPECT_NEAR(drag.turned(), 1.0, 0.02) << "the near side goes to the right";
    drag.to(camera.ray({400.0f - 3.0f * radius, 300.0f}));
    EXPECT_NEAR(drag.turned(), -3.0, 0.1);
}

TEST(GizmoDrag, ABoxDoublesTheScaleAtTwiceItsDistance) {
    const Camera camera({.distance = 6.0f, .orthographic = true}, viewport);
    const Gizmo gizmo{{.scale = {2.0f, 1.0f, 1.0f}}, everything};
    const float out = gizmo.reach(Drag::Scale, camera) / camera.metres_per_pixel({});
    GizmoDrag drag = caught(GizmoPart::ScaleX, gizmo.frame, camera, {400.0f + out, 300.0f});
    const HandleFrame twice = drag.to(camera.ray({400.0f + 2.0f * out, 300.0f}));
    EXPECT_NEAR(twice.scale.x, 4.0f, 1e-3f);
    EXPECT_EQ(drag.text(twice), "2.00 times along X");
    EXPECT_GT(drag.to(camera.ray({0.0f, 300.0f})).scale.x, 0.0f);
}

TEST(GizmoDrag, HostileRaysGiveFiniteFrames) {
    Chance chance;
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const std::vector<float> numbers{0.0f, -0.0f, 1.0f, -1.0f, 1e-38f, 1e30f, -1e38f, nan, inf, -inf};
    const auto any = [&] { return numbers[chance.random() % numbers.size()]; };
    const auto anything = [&] {
        const float x = any(), y = any(), z = any();
        return glm::vec3(x, y, z);
    };
    for (int round = 0; round < 20'000; ++round) {
        HandleFrame frame = chance.frame();
        const bool sound = round % 4 != 0;
        if (!sound) {
            frame.position = anything();
            frame.rotation.x = any();
        }
        const glm::vec3 origin = anything(), direction = anything();
        const float reach = any();
        GizmoDrag drag(static_cast<GizmoPart>(round % gizmo_parts), frame, {origin, direction}, reach,
                       round % 5 == 0);
        for (int i = 0; i < 4; ++i) {
            const glm::vec3 from = anything(), towards = anything();
            EXPECT_TRUE(finite(drag.to({from, towards}))) << round;
        }
        EXPECT_TRUE(std::isfinite(drag.turned()));
    }
}

TEST(Gizmo, EveryPartIsGrabbedAtItsGrip) {
    Chance chance;
    for (int round = 0; round < 60; ++round) {
        const Camera camera = chance.camera(round % 2 == 0);
        Gizmo gizmo{chance.frame(), round % 3 == 0 ? everything : Drag::Position | Drag::Rotation};
        gizmo.frame.position = camera.pose().target;
        gizmo.middle = 7;
        DrawList list;
        draw_gizmo(list, gizmo, camera, palette(Theme::Dark), std::nullopt);
        for (const GizmoPart part : gizmo.parts(camera)) {
            bool found = false;
            for (const glm::vec3 grip : gizmo.grips(part, camera))
                found = found || pick(list, camera, *camera.project(grip), 0.0f) == gizmo_pick(part);
            // If axes are behind one another on the screen, a box may be behind an arrow.
            if (changed_by(part) == Drag::Rotation) {
                EXPECT_TRUE(found) << name(part) << " " << round;
            }
        }
        EXPECT_EQ(pick(list, camera, *camera.project(gizmo.frame.position), 3.0f), 7)
            << "the middle stays free for what stands there";
    }
}

TEST(Gizmo, HasThePartsThatItsHandleAllows) {
    const Camera camera({.yaw = 0.6f, .pitch = 0.5f}, viewport);
    EXPECT_EQ((Gizmo{{}, everything}.parts(camera).size()), 12u);
    for (const Drag what : {Drag::Position, Drag::Rotation, Drag::Scale})
        for (const GizmoPart part : Gizmo{{}, what}.parts(camera)) EXPECT_EQ(changed_by(part), what);
    const Camera front({}, viewport);  // along -z
    for (const GizmoPart part : Gizmo{{}, everything}.parts(front)) {
        EXPECT_NE(part, GizmoPart::MoveZ) << "it points at the eye";
        EXPECT_NE(part, GizmoPart::MoveZX) << "it is seen edge on";
    }
}

TEST(Gizmo, HasTheSameSizeOnTheScreenEverywhere) {
    const Camera camera({.distance = 8.0f}, viewport);
    for (const glm::vec3 at : {glm::vec3(0, 0, 4), glm::vec3(1, 1, -6), glm::vec3(0, 0, -40)}) {
        const Gizmo gizmo{{at}, Drag::Rotation};
        const auto middle = camera.project(at);
        const auto side = camera.project(at + gizmo.reach(Drag::Rotation, camera) * camera.right());
        EXPECT_NEAR(glm::distance(*middle, *side), 78.0f, 0.1f);
    }
}

TEST(Gizmo, DrawsNothingAtANonFinitePosition) {
    DrawList list;
    const Camera camera({}, viewport);
    draw_gizmo(list, {{glm::vec3(std::nanf(""))}, everything}, camera, palette(Theme::Dark), std::nullopt);
    draw_gizmo(list, {{glm::vec3(0, 0, 100)}, everything}, camera, palette(Theme::Dark), std::nullopt);
    EXPECT_TRUE(list.strokes.empty());
}

}  // namespace
}  // namespace tendril::app::gizmo_test
