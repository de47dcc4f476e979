// Comparing frame rates tick by tick, as in the window.
#include "app/labs/rig/take.hpp"
#include "rig_support.hpp"

namespace tendril::app {
namespace {

class RigRates : public RigTest {
  protected:
    RigRates() {
        run("rig.preset", {{"name", "secondary"}});
        run("rig.motion", {{"name", "head"}, {"path", "figure_eight"}, {"radius", 0.6}, {"period", 1.7}});
    }
};

TEST_F(RigRates, OfAnEarlierTakeAreNoLongerShown) {
    run("rig.rates");
    ASSERT_TRUE(part().rates);
    // As after a backward solve that found other values for the controls.
    begin_take(workspace.document.edit<RigPart>(rig_lab));
    EXPECT_FALSE(part().rates);
}

/// The result is the same however it is divided into ticks, restarted, or loaded from a file half way.
TEST_F(RigRates, FrameRatesAreComparedFromTickToTick) {
    Workspace other = workspace;
    run("rig.rates");
    EXPECT_FALSE(lab().working(workspace)) << "a script's next line finds it done";
    const RateDifference at_once = *part().rates;
    EXPECT_GT(at_once.mm, 1.0);
    workspace = other;
    begin("rig.rates");
    int ticks = 0;
    for (; lab().working(workspace) && ticks < 1000; ++ticks) {
        if (ticks % 2 == 1) workspace.runtimes.clear();
        if (ticks % 3 == 2) {
            Workspace again = reopened();
            ASSERT_EQ(rig_part(again).rates, part().rates) << ticks;
            workspace.document = again.document;
        }
        if (ticks == 3) tick(2);
        lab().work(workspace);
    }
    EXPECT_GT(ticks, 5);
    EXPECT_EQ(*part().rates, at_once);
}

TEST_F(RigRates, AComparisonOfFrameRatesIsCancelledAndEndsWithItsTake) {
    expect_refused("rig.rates.cancel", Json::object(), {"no frame rates are being compared"});
    begin("rig.rates");
    lab().work(workspace);
    ASSERT_TRUE(lab().working(workspace));
    const std::size_t done = part().rates->done;
    run("rig.rates.cancel");
    EXPECT_FALSE(part().rates);
    run("undo");
    EXPECT_EQ(part().rates->done, done);
    run("rig.motion", {{"name", "head"}, {"path", "figure_eight"}});
    EXPECT_FALSE(lab().working(workspace)) << "it was of the take so far";
    run("undo");
    set("head", {{"translation", {0.3, 1, 0}}});
    EXPECT_FALSE(lab().working(workspace));
}

}  // namespace
}  // namespace tendril::app
