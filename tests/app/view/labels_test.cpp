// Labels never overlap and are never cut off, whatever is requested.
#include "app/view/labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <glm/common.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <random>

namespace tendril::app::labels_test {
namespace {

const Rect viewport{{100.0f, 50.0f}, {900.0f, 650.0f}};

std::vector<LabelRequest> random_requests(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> x(0.0f, 1000.0f), y(0.0f, 700.0f), width(8.0f, 90.0f);
    std::uniform_int_distribution<int> rank(0, 3);
    std::vector<LabelRequest> requests;
    for (int i = 0; i < count; ++i) {
        requests.push_back(
            {.at = {x(random), y(random)}, .size = {width(random), 15.0f}, .rank = rank(random)});
    }
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

TEST(Labels, KeepOffObstaclesWhileThereIsAnotherPlace) {
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

TEST(Labels, TheHigherRankStays) {
    std::vector<LabelRequest> requests;
    for (int i = 0; i < 200; ++i)
        requests.push_back({.at = {500, 300}, .size = {60, 14}, .rank = i == 150 ? 5 : 0});
    const auto placed = place_labels(requests, viewport);
    ASSERT_FALSE(placed.empty());
    EXPECT_EQ(placed[0].request, 150u);
    EXPECT_LT(placed.size(), requests.size());
}

TEST(Labels, AreTheSameEveryTime) {
    const auto requests = random_requests(7, 500);
    const auto first = place_labels(requests, viewport), second = place_labels(requests, viewport);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].request, second[i].request);
        EXPECT_EQ(first[i].box, second[i].box);
    }
}

TEST(Labels, LeaveOutWhatCannotBePlaced) {
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
TEST(Labels, AnObstacleOfAnySizeIsJustInTheWay) {
    const std::vector<LabelRequest> requests{{.at = {500, 300}, .size = {40, 14}}};
    const std::vector<Rect> obstacles{{{-1e12f, -1e12f}, {1e12f, 1e12f}},
                                      {{-1e38f, 290.0f}, {1e38f, 310.0f}},
                                      {{std::nanf(""), 0.0f}, {10.0f, 10.0f}}};
    EXPECT_EQ(place_labels(requests, viewport, 2.0f, obstacles).size(), 1u) << "it has no better place";
}

}  // namespace
}  // namespace tendril::app::labels_test
