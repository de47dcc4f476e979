// App itself, run in the test process on an offscreen window.
#include "app/labs/chain/chain_lab.hpp"
#include "tests/app/support/driven_app.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using namespace app;

class AppTest : public testing::Test, protected DrivenApp {
  protected:
    AppTest() : DrivenApp({1280, 720}) {}

    glm::vec2 pixel(const std::string& name) { return handle(app_.state(), name); }
    const ChainPart& part() { return chain_part(app_.workspace()); }
    /// Grabs the target and moves it a little.
    void begin_drag() {
        const glm::vec2 caught = pixel("target");
        take(MouseMove{caught});
        take(MousePress{MouseButton::Left, true});
        take(MouseMove{caught + glm::vec2(-40, -60)});
        ASSERT_TRUE(app_.busy());
        ASSERT_GT(part().target.y, 0.1f);
    }
};

/// The status line at rest: of the last press, and no longer than the window.
TEST_F(AppTest, SaysHowToTurnTheView) {
    const auto says = [&](const std::string& hint) {
        take(MouseMove{{640.0f, 650.0f}});
        return seen(hint).has_value();
    };
    const std::string brief = "Right-drag turns the view. ? shows every key.";
    EXPECT_TRUE(
        says("Right-drag turns the view, middle-drag shifts it, the wheel zooms. ? shows every key."));
    run("view.scroll", {{"does", "pan"}});
    EXPECT_TRUE(
        says("Right-drag turns the view, two fingers shift it; with Ctrl they zoom. "
             "? shows every key."));
    EXPECT_FALSE(says(brief));
    take(Resize{{480, 720}});
    EXPECT_TRUE(says(brief));
    const std::string touch = "One finger turns the view, two move and zoom it.";
    for (const bool down : {true, false}) take(MousePress{MouseButton::Left, down, true});
    EXPECT_TRUE(says(touch));
    for (const bool down : {true, false}) take(MousePress{MouseButton::Left, down});
    EXPECT_FALSE(says(touch));
}

LABEL(slow, "AppTest.DrawCallsDoNotGrowWithSegments");

TEST_F(AppTest, DrawCallsDoNotGrowWithSegments) {
    std::vector<int> calls;
    for (int count : {10, 1000, 10'000}) {
        run("chain.preset", {{"name", "coil"}, {"count", count}});
        run("camera.frame", {{"what", "all"}});
        app_.draw();
        calls.push_back(app_.draw_calls());
    }
    EXPECT_GT(calls[0], 0);
    EXPECT_LT(calls[0], 12);
    EXPECT_EQ(calls[1], calls[0]);
    EXPECT_EQ(calls[2], calls[0]);
}

TEST_F(AppTest, ShowsTheEndOfAMotionBeforeItIdles) {
    run("lab.open", {{"name", "linkage"}});
    run("linkage.set", {{"crank", 2.2}});
    run("linkage.motor", {{"joint", "crank"}, {"deg_per_s", 360}});
    run("time.play", Json::object());
    int after = 0;
    for (int i = 0; i < 600 && app_.needs_ticks(); ++i) {
        app_.tick(nullptr);
        after += app_.state().at("status") == "DeadPoint";
    }
    EXPECT_FALSE(app_.needs_ticks());
    EXPECT_GE(after, 2) << "the panels of a tick show what the tick before it ended with";
}

TEST_F(AppTest, LosingTheFocusInMidDragEndsTheDrag) {
    begin_drag();
    take(Focus{false});
    EXPECT_FALSE(app_.busy());
    const glm::vec3 left_at = part().target;
    take(MouseMove{{400, 300}});
    EXPECT_EQ(part().target, left_at);
    take(Focus{true});
    take(MousePress{MouseButton::Left, false});
    take(MouseMove{{420, 320}});
    EXPECT_EQ(part().target, left_at);
    run("undo", Json::object());
    EXPECT_EQ(part().target, glm::vec3(7, 0, 0)) << "what was dragged is one step";
}

TEST_F(AppTest, AKeyHeldWhenTheFocusLeavesIsNotHeldAfterwards) {
    take(KeyChange{Key::X, true});
    take(Focus{false});
    take(Focus{true});
    begin_drag();  // X would bind it
}

TEST_F(AppTest, AResizeInMidDragDoesNoHarm) {
    begin_drag();
    take(Resize{{1600, 900}});
    EXPECT_EQ(window_->size(), glm::ivec2(1600, 900));
    take(MouseMove{{700, 350}});
    take(MouseMove{{720, 360}});
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(part().target[i]));
    EXPECT_LT(glm::distance(pixel("target"), glm::vec2(720, 360)), 1.0f);
    take(Resize{{1, 1}});
    take(MouseMove{{0, 0}});
    app_.draw();
    take(Resize{{1280, 720}});
    take(MousePress{MouseButton::Left, false});
    EXPECT_FALSE(app_.busy());
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(part().target[i]));
}

TEST_F(AppTest, ASecondButtonInMidDragChangesNothing) {
    begin_drag();
    const CameraPose camera = app_.workspace().camera;
    take(MousePress{MouseButton::Right, true});
    take(MouseMove{{600, 300}});
    take(MousePress{MouseButton::Right, false});
    EXPECT_TRUE(app_.busy());
    EXPECT_EQ(app_.workspace().camera, camera);
    take(MousePress{MouseButton::Left, false});
    EXPECT_FALSE(app_.busy());
}

TEST_F(AppTest, ADropOfNothingChangesNothing) {
    const Json before = app_.state();
    take(Drop{{}});
    EXPECT_EQ(app_.state()["segments"], before["segments"]);
    EXPECT_TRUE(app_.workspace().ui.toasts.empty());
}

TEST_F(AppTest, TheFirstHintStaysUntilTheFirstDrag) {
    EXPECT_FALSE(app_.workspace().settings.hint_seen);
    run("chain.target", {{"to", {1, 2, 3}}});
    EXPECT_FALSE(app_.workspace().settings.hint_seen);
    begin_drag();
    EXPECT_TRUE(app_.workspace().settings.hint_seen);
}

TEST_F(AppTest, ClosingTheWindowQuits) {
    EXPECT_FALSE(app_.quit());
    take(CloseRequest{});
    EXPECT_TRUE(app_.quit());
}

TEST_F(AppTest, ShortcutsAreIgnoredWhileTyping) {
    take(KeyTap{{Key::K, true, false, false}});
    app_.tick(nullptr);
    take(TextInput{"b"});
    take(KeyTap{{Key::B, false, false, false}});
    EXPECT_TRUE(app_.workspace().settings.choices.empty());
    take(KeyTap{{Key::Escape, false, false, false}});
    app_.tick(nullptr);
    EXPECT_FALSE(app_.workspace().ui.palette);
    app_.tick(nullptr);
    take(KeyTap{{Key::B, false, false, false}});
    EXPECT_EQ(app_.workspace().settings.choices.at("segments"), "bones");
}

}  // namespace
}  // namespace tendril::test
