#include "app/document/workspace.hpp"

#include <gtest/gtest.h>

#include "tests/app/support/test_part.hpp"

namespace tendril::app {
namespace {

TEST(Workspace, KnowsWhetherItDiffersFromTheSavedScene) {
    Workspace workspace = test::make_workspace();
    EXPECT_FALSE(workspace.modified());
    workspace.document.edit<test::TestPart>("arm").title = "other";
    EXPECT_TRUE(workspace.modified());
    workspace.document = workspace.saved;
    EXPECT_FALSE(workspace.modified());
}

TEST(Workspace, AnEditDoesNotChangeDocumentsThatShareThePart) {
    const Workspace before = test::make_workspace();
    Workspace after = before;
    after.document.edit<test::TestPart>("arm").title = "other";
    EXPECT_EQ(before.document.get<test::TestPart>("arm").title, "blank arm");
    EXPECT_EQ(before.document.parts().at("rope"), after.document.parts().at("rope"));
}

TEST(Workspace, ShowsTheLastFewToastsAndRefusalsLonger) {
    Workspace workspace;
    workspace.toast("saved");
    workspace.toast("no", ToastKind::Refusal);
    ASSERT_EQ(workspace.ui.toasts.size(), 2u);
    EXPECT_EQ(workspace.ui.toasts[0].ticks_left, 4 * 60);
    EXPECT_EQ(workspace.ui.toasts[1].ticks_left, 7 * 60);
    EXPECT_EQ(workspace.ui.toasts[1].kind, ToastKind::Refusal);
    for (int i = 0; i < 10; ++i) workspace.toast(std::to_string(i));
    ASSERT_EQ(workspace.ui.toasts.size(), 4u);
    EXPECT_EQ(workspace.ui.toasts.back().text, "9");
}

TEST(Workspace, ARepeatedToastRestartsAndIsShownOnce) {
    Workspace workspace;
    workspace.toast("limit", ToastKind::Refusal);
    workspace.ui.toasts[0].ticks_left = 3;
    workspace.toast("other");
    workspace.toast("limit", ToastKind::Refusal);
    ASSERT_EQ(workspace.ui.toasts.size(), 2u);
    EXPECT_EQ(workspace.ui.toasts[1].text, "limit");
    EXPECT_EQ(workspace.ui.toasts[1].ticks_left, 7 * 60);
}

TEST(Workspace, ThePastsOfClosedLabsKeepWithinOneBound) {
    constexpr std::size_t bound = 64u << 20;
    Workspace workspace = test::make_workspace();
    for (int i = 0; i < 6; ++i) {
        const std::string lab = "lab " + std::to_string(i);
        workspace.document.set(lab, test::make_part(lab, std::vector<float>(1'000'000)));
        workspace.open_lab(lab);
        for (int tick = 0; tick < 10; ++tick, ++workspace.moment) workspace.remember_moment();
    }
    std::size_t bytes = 0;
    for (const auto& [lab, past] : workspace.pasts) bytes += past.rewind.bytes();
    EXPECT_LE(bytes, bound);
    EXPECT_GT(bytes, 0u);
    EXPECT_EQ(workspace.rewind.size(), 10u) << "the open lab keeps its own";
}

}  // namespace
}  // namespace tendril::app
