// A folded side panel and the strip that stays of it.
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

}  // namespace
}  // namespace tendril::app
