// Which of several objects under a pixel is picked.
#include "app/view/picking.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tendril::app::picking_test {
namespace {

const Rect viewport{{0.0f, 0.0f}, {800.0f, 600.0f}};
const glm::vec2 middle{400.0f, 300.0f};
const glm::vec4 white{1.0f};

Stroke& ball(DrawList& list, PickId id, glm::vec3 at, float radius = 10.0f) {
    Stroke& stroke = list.sphere(at, radius, Unit::Pixels, white);
    stroke.pick = id;
    return stroke;
}

TEST(Picking, FindsNothingWhereNothingIs) {
    DrawList list;
    EXPECT_EQ(pick(list, Camera({}, viewport), middle), no_pick);
    ball(list, 1, {2, 0, 0});
    list.sphere({0, 0, 0}, 20.0f, Unit::Pixels, white);  // not pickable
    EXPECT_EQ(pick(list, Camera({}, viewport), middle), no_pick);
    ball(list, 2, {0, 0, 0});
    EXPECT_EQ(pick(list, Camera({}, viewport), {-5.0f, 300.0f}), no_pick) << "outside the viewport";
}

TEST(Picking, TheNearerWins) {
    for (const bool orthographic : {false, true}) {
        DrawList list;
        ball(list, 1, {0, 0, 1});
        ball(list, 2, {0, 0, 3});
        ball(list, 3, {0, 0, -1});
        EXPECT_EQ(pick(list, Camera({.orthographic = orthographic}, viewport), middle), 2);
    }
}

TEST(Picking, TheHigherRankWinsOverTheNearer) {
    DrawList list;
    ball(list, 1, {0, 0, 3}).layer = Layer::Overlay;
    ball(list, 2, {0, 0, 0}).rank = 5;
    EXPECT_EQ(pick(list, Camera({}, viewport), middle), 2);
}

TEST(Picking, TheOverlayWinsOverTheSceneOfTheSameRank) {
    DrawList list;
    ball(list, 1, {0, 0, 3});
    ball(list, 2, {0, 0, 0}).layer = Layer::Overlay;
    EXPECT_EQ(pick(list, Camera({}, viewport), middle), 2);
}

TEST(Picking, ABallWinsOverTheLineThatEndsInIt) {
    DrawList list;
    ball(list, 1, {0, 0, 0});
    list.line({0, 0, 0}, {2, 0, 0}, 3.0f, white).pick = 2;
    const Camera camera({}, viewport);
    EXPECT_EQ(pick(list, camera, middle), 1);
    EXPECT_EQ(pick(list, camera, middle + glm::vec2(6.0f, 0.0f)), 1);
    EXPECT_EQ(pick(list, camera, middle + glm::vec2(40.0f, 0.0f)), 2);
}

TEST(Picking, SlackReachesBeyondTheEdgeButWhatIsHitCountsFirst) {
    DrawList list;
    ball(list, 1, {0, 0, 0});
    const Camera camera({}, viewport);
    EXPECT_EQ(pick(list, camera, middle + glm::vec2(12.5f, 0.0f), 3.0f), 1);
    EXPECT_EQ(pick(list, camera, middle + glm::vec2(13.5f, 0.0f), 3.0f), no_pick);
    EXPECT_EQ(pick(list, camera, middle + glm::vec2(12.5f, 0.0f), 0.0f), no_pick);
    const glm::vec2 between = middle + glm::vec2(12.0f, 0.0f);
    ball(list, 2, *camera.on_plane(middle + glm::vec2(20.0f, 0.0f), {0, 0, -2}, {0, 0, 1}));
    EXPECT_EQ(pick(list, camera, between, 3.0f), 2) << "farther, but under the pixel itself";
}

TEST(Picking, ARingIsCaughtByItsLine) {
    DrawList list;
    list.ring({0, 0, 0}, 30.0f, 2.0f, white).pick = 1;
    const Camera camera({}, viewport);
    EXPECT_EQ(pick(list, camera, middle), no_pick);
    EXPECT_EQ(pick(list, camera, middle + glm::vec2(30.0f, 0.0f)), 1);
    EXPECT_EQ(pick(list, camera, middle + glm::vec2(0.0f, 26.5f)), 1);
    EXPECT_EQ(pick(list, camera, middle + glm::vec2(0.0f, 36.0f)), no_pick);
}

TEST(Picking, BrokenStrokesAreNotPicked) {
    DrawList list;
    ball(list, 1, {std::nanf(""), 0, 0});
    ball(list, 2, {0, 0, 0}, std::nanf(""));
    ball(list, 3, {0, 0, 0}, -5.0f);
    ball(list, 4, {0, 0, 30});  // behind the eye
    EXPECT_EQ(pick(list, Camera({}, viewport), middle), no_pick);
}

}  // namespace
}  // namespace tendril::app::picking_test
