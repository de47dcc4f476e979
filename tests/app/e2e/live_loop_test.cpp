// The loop of a real window, stepped by hand: it draws if something may have changed, and only then.
#include "app/live_loop.hpp"

#include "app/document/runtime.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using namespace app;

class LiveLoopTest : public testing::Test {
  protected:
    void turn(std::vector<Event> events = {}, double elapsed = tick_seconds) {
        loop_.turn(std::move(events), elapsed, player_);
    }
    void settle() {
        for (int i = 0; i < 20; ++i) turn();
    }
    const ChainPart& part() { return chain_part(app_.workspace()); }

    std::unique_ptr<Window> window_ = open_offscreen({1000, 640});
    App app_{*window_};
    std::atomic<bool> ending_{false};
    LiveLoop loop_{app_, *window_, {.config = false, .ending = ending_}};
    Player player_{Script{}};
};

TEST_F(LiveLoopTest, AnIdleWindowDrawsNothing) {
    settle();
    EXPECT_GE(loop_.frames_drawn(), 1);
    const int drawn = loop_.frames_drawn();
    for (int i = 0; i < 600; ++i) turn();
    EXPECT_EQ(loop_.frames_drawn(), drawn);
    EXPECT_GT(loop_.patience(player_), 0.5) << "and sleeps";
}

TEST_F(LiveLoopTest, AnEventIsDrawnAtOnceAndThenTheWindowIdles) {
    settle();
    const int drawn = loop_.frames_drawn();
    turn({KeyChange{Key::L, true}}, 0.0);
    EXPECT_EQ(loop_.frames_drawn(), drawn + 1);
    settle();
    const int after = loop_.frames_drawn();
    EXPECT_LE(after, drawn + 8);
    for (int i = 0; i < 100; ++i) turn();
    EXPECT_EQ(loop_.frames_drawn(), after);
}

TEST_F(LiveLoopTest, AMovingSceneIsDrawnContinuously) {
    app_.run({"chain.motion", Json{{"path", "circle"}}});
    settle();
    const int drawn = loop_.frames_drawn();
    const auto tick = app_.workspace().clock.tick;
    for (int i = 0; i < 60; ++i) turn();
    EXPECT_NEAR(loop_.frames_drawn() - drawn, 60, 2);
    EXPECT_NEAR(static_cast<double>(app_.workspace().clock.tick - tick), 60.0, 2.0);
}

TEST_F(LiveLoopTest, TimeKeepsPaceWithSlowFramesButDoesNotRaceAfterAStall) {
    app_.run({"chain.motion", Json{{"path", "circle"}}});
    settle();
    auto tick = app_.workspace().clock.tick;
    for (int i = 0; i < 15; ++i) turn({}, 4 * tick_seconds);
    EXPECT_NEAR(static_cast<double>(app_.workspace().clock.tick - tick), 60.0, 4.0);
    tick = app_.workspace().clock.tick;
    turn({}, 30.0);
    EXPECT_LE(app_.workspace().clock.tick - tick, 20u);
    app_.workspace().ui.filming.emplace();
    tick = app_.workspace().clock.tick;
    turn({}, 30.0);
    EXPECT_LE(app_.workspace().clock.tick - tick, 1u) << "its progress is drawn as well";
}

TEST_F(LiveLoopTest, TheVerdictReportsThatTimePassesTooSlowly) {
    FrameRecorder recorder;
    app_.run({"lab.open", Json{{"name", "rope"}}});
    app_.run({"rope.preset", Json{{"name", "line"}}});
    const auto says = [&](const std::string& text) {
        return std::ranges::any_of(recorder.frame().texts,
                                   [&](const DrawnText& each) { return each.text == text; });
    };
    for (int i = 0; i < 60; ++i) turn();
    turn({}, 30.0);
    EXPECT_TRUE(says("Lengths hold")) << "one stall is none";
    for (int i = 0; i < 20; ++i) turn({}, 0.5);  // one turn catches up by at most a quarter of a second
    EXPECT_NEAR(pace_of(app_.workspace().runtimes).kept, 0.5, 0.01);
    EXPECT_TRUE(says("Lengths hold, at 50 % of real time"));
    for (int i = 0; i < 300; ++i) turn();
    EXPECT_TRUE(says("Lengths hold"));
}

TEST_F(LiveLoopTest, AThousandMovesBetweenTwoFramesBecomeOne) {
    settle();
    const glm::vec2 target = handle(app_.state(), "target");
    turn({MouseMove{target}, MousePress{MouseButton::Left, true}});
    std::vector<Event> moves;
    for (int i = 1; i <= 1000; ++i)
        moves.push_back(MouseMove{target + static_cast<float>(i) * glm::vec2(-0.1f, -0.15f)});
    const int drawn = loop_.frames_drawn();
    turn(moves);
    turn();
    EXPECT_LE(loop_.frames_drawn(), drawn + 2);
    const glm::vec2 now = handle(app_.state(), "target");
    EXPECT_NEAR(now.x, target.x - 100.0f, 0.1f);
    EXPECT_NEAR(now.y, target.y - 150.0f, 0.1f);
}

TEST_F(LiveLoopTest, NoPressIsLostInABurst) {
    settle();
    // Pressed, moved and released between two frames: no event may be lost.
    const glm::vec2 target = handle(app_.state(), "target");
    turn({MouseMove{target}, MousePress{MouseButton::Left, true}, MouseMove{target + glm::vec2(-30, -30)},
          MouseMove{target + glm::vec2(-60, -90)}, MousePress{MouseButton::Left, false},
          MouseMove{{600, 600}}});
    settle();
    EXPECT_FALSE(app_.busy());
    const glm::vec2 now = handle(app_.state(), "target");
    EXPECT_NEAR(now.x, target.x - 60.0f, 0.1f);
    EXPECT_NEAR(now.y, target.y - 90.0f, 0.1f);
}

TEST_F(LiveLoopTest, PastedTextIsRecordedAsText) {
    app_.start_recording();
    settle();
    window_->set_clipboard("chain.add length=0.25");
    turn({KeyChange{Key::Ctrl, true}, KeyChange{Key::K, true}, KeyChange{Key::K, false},
          KeyChange{Key::Ctrl, false}});
    settle();
    turn({KeyChange{Key::Ctrl, true}, KeyChange{Key::V, true}, KeyChange{Key::V, false},
          KeyChange{Key::Ctrl, false}});
    settle();
    turn({KeyChange{Key::Enter, true}, KeyChange{Key::Enter, false}});
    settle();
    EXPECT_EQ(part().chain.size(), 9u);
    EXPECT_TRUE(has(app_.recording(), "{\"text\":\"chain.add length=0.25\"}"));
}

TEST_F(LiveLoopTest, AScriptPlaysInTheWindowAtItsOwnPace) {
    ScriptText script;
    script.command("chain.motion", {{"path", "circle"}}).wait(30).command("time.pause");
    Player player(parse_script(script.text(), app_.commands()));
    for (int i = 0; i < 200 && !player.done(); ++i) loop_.turn({}, tick_seconds, player);
    EXPECT_TRUE(player.done());
    EXPECT_NEAR(static_cast<double>(app_.workspace().clock.tick), 30.0, 1.0);
}

}  // namespace
}  // namespace tendril::test
