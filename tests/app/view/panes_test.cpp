// A divided view: the rectangles of the panes.
#include "app/view/panes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tendril::app {
namespace {

TEST(Panes, ASingleOneIsAllOfTheView) {
    const Rect view{{271.5f, 44.0f}, {1009.25f, 646.0f}};
    EXPECT_EQ(tiled(view, 0, 2.0f), std::vector{view});
    EXPECT_EQ(tiled(view, 1, 2.0f), std::vector{view});
}

TEST(Panes, FourInALandscapeAreTwoByTwoAndTwoStandBesideEachOther) {
    const Rect view{{0.0f, 0.0f}, {802.0f, 602.0f}};
    const std::vector<Rect> four{
        {{0, 0}, {400, 300}}, {{402, 0}, {802, 300}}, {{0, 302}, {400, 602}}, {{402, 302}, {802, 602}}};
    EXPECT_EQ(tiled(view, 4, 2.0f), four);
    EXPECT_EQ(tiled(view, 2, 2.0f), (std::vector<Rect>{{{0, 0}, {400, 602}}, {{402, 0}, {802, 602}}}));
}

TEST(Panes, StayApartWithinTheViewOnWholePixelsAndOfOneSize) {
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
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_TRUE(panes[j].max.x < pane.min.x || pane.max.x < panes[j].min.x ||
                            panes[j].max.y < pane.min.y || pane.max.y < panes[j].min.y)
                    << i << " and " << j << " of " << count;
            }
        }
    }
}

}  // namespace
}  // namespace tendril::app
