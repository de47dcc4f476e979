// A folded side panel and the strip that remains of it.
#include <gtest/gtest.h>

#include "app/shell/layout.hpp"

namespace tendril::app {
namespace {

TEST(FoldedPanel, LeavesAStripToBringItBackWith) {
    Settings settings;
    settings.left_open = settings.right_open = false;
    const Layout layout = lay_out({1280, 720}, 2.0f, settings, 0.0f);
    EXPECT_EQ(layout.left.size().x, 24.0f);
    EXPECT_EQ(layout.right.size().x, 24.0f);
    EXPECT_EQ(layout.view.size().x, 1280.0f - 48.0f);
}

TEST(FoldedPanel, OneFoldsByItselfWhereThereIsNoRoomForTwo) {
    Settings settings;
    EXPECT_TRUE(lay_out({900, 640}, 1.0f, settings, 0.0f).right_open);
    const Layout narrow = lay_out({899, 640}, 1.0f, settings, 0.0f);
    EXPECT_TRUE(narrow.left_open);
    EXPECT_FALSE(narrow.right_open);
    EXPECT_EQ(narrow.right.size().x, 12.0f) << "the strip that brings it back";
    settings.left_open = false;
    EXPECT_TRUE(lay_out({899, 640}, 1.0f, settings, 0.0f).right_open);
}

TEST(FoldedPanel, OneFoldsByItselfWhereLargeTextLeavesRoomForOne) {
    Settings settings;
    EXPECT_FALSE(lay_out({1280, 720}, 1.5f, settings, 0.0f).one_panel);
    const Layout large = lay_out({1280, 720}, 2.0f, settings, 0.0f);
    EXPECT_TRUE(large.one_panel);
    EXPECT_EQ(large.left.size().x, 2.0f * settings.left_width)
        << "labels have the room that they have at scale 1";
    EXPECT_EQ(large.right.size().x, 24.0f) << "the strip that brings it back";
    settings.left_width = 520.0f;
    EXPECT_GE(lay_out({1280, 720}, 2.0f, settings, 0.0f).view.size().x, 0.339f * 1280.0f);
}

}  // namespace
}  // namespace tendril::app
