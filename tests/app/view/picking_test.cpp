// Picks one of several objects under a pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "app/view/labels.hpp"
#include "app/view/panes.hpp"
#include "app/view/picking.hpp"
#include "app/window/keys.hpp"

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

TEST(Picking, FindsNothingInEmptySpace) {
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

TEST(Picking, SlackReachesBeyondTheEdgeButDirectHitsComeFirst) {
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

TEST(Picking, ARingIsHitAlongItsLine) {
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

namespace tendril::app {
namespace {

// Keys and chords keep their names.

TEST(Keys, EveryKeyHasItsOwnNameAndIsFoundByIt) {
    std::set<std::string> seen;
    for (int i = 1; i < static_cast<int>(Key::Count); ++i) {
        const auto key = static_cast<Key>(i);
        const std::string name(key_name(key));
        EXPECT_FALSE(name.empty()) << i;
        EXPECT_TRUE(seen.insert(name).second) << name;
        EXPECT_EQ(key_from_name(name), key) << name;
    }
    EXPECT_EQ(key_name(Key::Unknown), "");
    EXPECT_EQ(key_name(Key::Count), "");
}

TEST(Keys, EveryChordSurvivesItsName) {
    for (int i = 1; i < static_cast<int>(Key::Count); ++i)
        for (int modifiers = 0; modifiers < 8; ++modifiers) {
            const Chord chord{static_cast<Key>(i), (modifiers & 1) != 0, (modifiers & 2) != 0,
                              (modifiers & 4) != 0};
            EXPECT_EQ(chord_from_name(chord_name(chord)), chord) << chord_name(chord);
        }
}

TEST(Keys, ChordsAreWrittenOneWayAndReadAnyWay) {
    const Chord redo{.key = Key::Z, .ctrl = true, .shift = true};
    EXPECT_EQ(chord_name(redo), "ctrl+shift+z");
    EXPECT_EQ(chord_label(redo), "Ctrl+Shift+Z");
    EXPECT_EQ(chord_from_name("Shift+CTRL+z"), redo);
    EXPECT_EQ(chord_from_name("ctrl"), (Chord{.key = Key::Ctrl}));
    for (const char* bad : {"", "+", "ctrl+", "+z", "ctrl+ctrl+z", "z+ctrl", "ctrl + z", "super+z"})
        EXPECT_FALSE(chord_from_name(bad)) << bad;
}

// A divided view: the rectangles of the panes.

TEST(Panes, FourInALandscapeAreTwoByTwoAndTwoAreSideBySide) {
    const Rect view{{0.0f, 0.0f}, {802.0f, 602.0f}};
    const std::vector<Rect> four{
        {{0, 0}, {400, 300}}, {{402, 0}, {802, 300}}, {{0, 302}, {400, 602}}, {{402, 302}, {802, 602}}};
    EXPECT_EQ(tiled(view, 4, 2.0f), four);
    EXPECT_EQ(tiled(view, 2, 2.0f), (std::vector<Rect>{{{0, 0}, {400, 602}}, {{402, 0}, {802, 602}}}));
}

TEST(Panes, AreApartOnWholePixelsAndOfEqualSize) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(0.0f, 1.0f);
    for (int round = 0; round < 2000; ++round) {
        const float left = std::round(500.0f * any(random)), top = std::round(100.0f * any(random));
        const float width = std::round(2000.0f * any(random)), height = std::round(1500.0f * any(random));
        const Rect view{{left, top}, {left + width, top + height}};
        const std::size_t count = 2 + static_cast<std::size_t>(round) % 7;
        const std::vector<Rect> panes = tiled(view, count, 2.0f);
        ASSERT_EQ(panes.size(), count);
        for (std::size_t i = 0; i < count; ++i) {
            const Rect& pane = panes[i];
            EXPECT_EQ(pane.min, glm::round(pane.min));
            EXPECT_EQ(pane.max, glm::round(pane.max));
            EXPECT_GE(pane.size().x, 0.0f);
            EXPECT_GE(pane.size().y, 0.0f);
            EXPECT_NEAR(pane.size().x, panes[0].size().x, 1.0f);
            EXPECT_NEAR(pane.size().y, panes[0].size().y, 1.0f);
            if (width < 50.0f || height < 50.0f) continue;
            EXPECT_GE(pane.min.x, view.min.x);
            EXPECT_LE(pane.max.x, view.max.x);
            EXPECT_LE(pane.max.y, view.max.y);
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_TRUE(panes[j].max.x < pane.min.x || pane.max.x < panes[j].min.x ||
                            panes[j].max.y < pane.min.y || pane.max.y < panes[j].min.y)
                    << i << " and " << j << " of " << count;
        }
    }
}

}  // namespace
}  // namespace tendril::app

namespace tendril::app::labels_test {
namespace {

// Labels never overlap and are never cut off, whatever is requested.

const Rect viewport{{100.0f, 50.0f}, {900.0f, 650.0f}};

std::vector<LabelRequest> random_requests(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> x(0.0f, 1000.0f), y(0.0f, 700.0f), width(8.0f, 90.0f);
    std::uniform_int_distribution<int> rank(0, 3);
    std::vector<LabelRequest> requests;
    for (int i = 0; i < count; ++i)
        requests.push_back(
            {.at = {x(random), y(random)}, .size = {width(random), 15.0f}, .rank = rank(random)});
    return requests;
}

bool overlap(const Rect& a, const Rect& b) {
    return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y;
}

TEST(Labels, NeverOverlapAndAreNeverClipped) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto requests = random_requests(seed, 300);
        const auto placed = place_labels(requests, viewport);
        EXPECT_GT(placed.size(), 40u);
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const Rect& box = placed[i].box;
            EXPECT_GE(box.min.x, viewport.min.x);
            EXPECT_GE(box.min.y, viewport.min.y);
            EXPECT_LE(box.max.x, viewport.max.x);
            EXPECT_LE(box.max.y, viewport.max.y);
            EXPECT_NEAR(box.size().x, requests[placed[i].request].size.x, 1e-3f);
            EXPECT_NEAR(box.size().y, requests[placed[i].request].size.y, 1e-3f);
            for (std::size_t j = i + 1; j < placed.size(); ++j) EXPECT_FALSE(overlap(box, placed[j].box));
        }
    }
}

TEST(Labels, KeepTheirPointFree) {
    const std::vector<LabelRequest> requests{{.at = {500, 300}, .size = {40, 14}, .clearance = 12}};
    const auto placed = place_labels(requests, viewport);
    ASSERT_EQ(placed.size(), 1u);
    const Rect& box = placed[0].box;
    EXPECT_GT(box.min.x, 500.0f) << "to the right, where there is room";
    const glm::vec2 nearest = glm::clamp(glm::vec2(500, 300), box.min, box.max);
    EXPECT_GE(glm::distance(nearest, glm::vec2(500, 300)), 11.0f);
}

TEST(Labels, AvoidObstaclesIfThereIsAnotherPlace) {
    const std::vector<LabelRequest> requests{{.at = {500, 300}, .size = {40, 14}, .clearance = 12}};
    std::vector<Rect> obstacles;
    const auto blocked = [&] {
        const auto placed = place_labels(requests, viewport, 2.0f, obstacles);
        EXPECT_EQ(placed.size(), 1u) << "rather over something than not at all";
        const bool covers = std::any_of(obstacles.begin(), obstacles.end(),
                                        [&](const Rect& o) { return overlap(placed[0].box, o); });
        obstacles.push_back(placed[0].box);
        return covers;
    };
    for (int side = 0; side < 3; ++side) EXPECT_FALSE(blocked()) << side;
    obstacles = {{{0, 0}, {2000, 2000}}};
    EXPECT_TRUE(blocked());
}

TEST(Labels, TheHigherRankIsKept) {
    std::vector<LabelRequest> requests;
    for (int i = 0; i < 200; ++i)
        requests.push_back({.at = {500, 300}, .size = {60, 14}, .rank = i == 150 ? 5 : 0});
    const auto placed = place_labels(requests, viewport);
    ASSERT_FALSE(placed.empty());
    EXPECT_EQ(placed[0].request, 150u);
    EXPECT_LT(placed.size(), requests.size());
}

TEST(Labels, OmitWhatCannotBePlaced) {
    const float nan = std::nanf("");
    const std::vector<LabelRequest> requests{{.at = {nan, 300}, .size = {40, 14}},
                                             {.at = {500, 300}, .size = {nan, 14}},
                                             {.at = {500, 300}, .size = {0, 0}},
                                             {.at = {500, 300}, .size = {4000, 14}},
                                             {.at = {-500, 300}, .size = {40, 14}}};
    EXPECT_TRUE(place_labels(requests, viewport).empty());
    EXPECT_TRUE(place_labels(random_requests(1, 5), Rect{}).empty());
    EXPECT_TRUE(place_labels({}, viewport).empty());
}

/// A ball in front of a camera that is nearly inside it covers more pixels than an int can count.
TEST(Labels, AnObstacleOfAnySizeIsHandled) {
    const std::vector<LabelRequest> requests{{.at = {500, 300}, .size = {40, 14}}};
    const std::vector<Rect> obstacles{{{-1e12f, -1e12f}, {1e12f, 1e12f}},
                                      {{-1e38f, 290.0f}, {1e38f, 310.0f}},
                                      {{std::nanf(""), 0.0f}, {10.0f, 10.0f}}};
    EXPECT_EQ(place_labels(requests, viewport, 2.0f, obstacles).size(), 1u) << "it has no better place";
}

}  // namespace
}  // namespace tendril::app::labels_test
