// Ctrl+V over the view: a lab that takes points gets them, the others say which lab does.
#include "app/labs/chain/chain_lab.hpp"
#include "app/live_loop.hpp"
#include "tests/app/support/driven_app.hpp"

namespace tendril::test {
namespace {

using namespace app;

class Paste : public testing::Test, protected DrivenApp {
  protected:
    Paste() : DrivenApp({1280, 720}) {}

    /// Pastes as the window's loop does.
    void paste(const std::string& text) {
        take(KeyChange{Key::Ctrl, true});
        take(TextInput{text});
        take(KeyChange{Key::Ctrl, false});
    }
    std::string told() { return toasts().empty() ? "" : toasts().back().text; }
    std::vector<Toast>& toasts() { return app_.workspace().ui.toasts; }
    const ChainPart& part() { return chain_part(app_.workspace()); }
};

TEST_F(Paste, ASmallArmIsFramedAndOneInViewIsNot) {
    app_.run({"scene.new", Json::object()});
    const CameraPose before = app_.workspace().camera;
    paste("0 0 0\n3 1 0\n6 0 1");
    EXPECT_EQ(app_.workspace().camera, before) << "all of it is seen";
    paste("0 0 0\n0.03 0 0\n0.05 0.02 0");
    EXPECT_LT(app_.workspace().camera.distance, 0.5f);
    const Json state = app_.state();
    EXPECT_GT(glm::distance(handle(state, "segment.0"), handle(state, "segment.2")), 100.0f) << "pixels";
    const CameraPose near = app_.workspace().camera;
    paste("90 0 0\n90.03 0 0\n90.05 0.02 0");
    EXPECT_NE(app_.workspace().camera, near) << "it was outside";
}

TEST_F(Paste, AnotherChainDropsTheLastOnesFlips) {
    const auto flip = [&] {
        app_.workspace().rewind.note({.kind = Incident::Kind::Flip, .joint = 1, .cause = "it was straight"});
    };
    const auto incidents = [&] { return app_.workspace().rewind.incidents().size(); };
    app_.run({"chain.mode", Json{{"mode", "reach"}}});
    flip();
    app_.run({"chain.target", Json{{"to", {2, 3, 0}}}});
    EXPECT_GE(incidents(), 1u) << "the chain is the same";
    paste("0 0 0\n1 1 0\n2 1 0");
    EXPECT_EQ(incidents(), 0u);
    flip();
    app_.run({"undo", Json::object()});
    EXPECT_EQ(incidents(), 0u) << "that was the pasted chain's";
}

TEST_F(Paste, JunkIsRefusedAndTypedTextIsNoPaste) {
    const Json before = app_.state();
    paste("1 2 3\n4 5 six");
    ASSERT_EQ(toasts().size(), 1u);
    EXPECT_EQ(toasts()[0].kind, ToastKind::Refusal);
    EXPECT_TRUE(says(told(), "line 2 six"));
    toasts().clear();
    take(TextInput{"1 2 3"});
    EXPECT_TRUE(toasts().empty());
    EXPECT_EQ(app_.state()["segments"], before["segments"]);
    EXPECT_EQ(app_.state()["target"], before["target"]);
    paste("");
    EXPECT_TRUE(says(told(), "clipboard no text"));
    run("chain.preset", {{"name", "reaching_arm"}});
    paste("Remember the milk");
    EXPECT_TRUE(says(told(), "clipboard no points line 1"));
    EXPECT_TRUE(app_.state()["events"].empty()) << "no incident of the lab";
}

TEST_F(Paste, IntoATextFieldOrUnderADialogMovesNothing) {
    take(KeyTap{*chord_from_name("ctrl+k")});
    app_.tick(nullptr);
    paste("1 2 3");
    EXPECT_EQ(part().target, glm::vec3(7, 0, 0));
    EXPECT_TRUE(toasts().empty());
}

TEST_F(Paste, InAnotherLabSaysWherePointsGo) {
    for (const auto& lab : app_.labs().all()) {
        if (lab->name() == chain_lab) continue;
        app_.run({"lab.open", Json{{"name", lab->name()}}});
        app_.run({"time.pause", Json::object()});
        toasts().clear();
        const Document before = app_.workspace().document;
        paste("(1, 2, 3)");
        EXPECT_TRUE(says(told(), "points Chain paste")) << lab->name();
        toasts().clear();
        paste("Remember the milk");
        EXPECT_TRUE(toasts().empty()) << lab->name();
        EXPECT_EQ(app_.workspace().document, before) << lab->name();
    }
}

/// Neither the menu's row nor the palette's command requests the text itself.
TEST_F(Paste, ByKeyMenuOrPaletteReadsTheClipboardAndIsReplayed) {
    const std::atomic<bool> ending{false};
    LiveLoop loop(app_, *window_, {.config = false, .ending = ending});
    Player none{Script{}};
    const auto turn = [&](std::vector<Event> events) {
        loop.turn(std::move(events), 0.0, none);
        for (int i = 0; i < 20; ++i) loop.turn({}, 1.0 / 60.0, none);
    };
    const auto palette = [&](const char* typed) {
        turn({KeyChange{Key::Ctrl, true}, KeyChange{Key::K, true}, KeyChange{Key::K, false},
              KeyChange{Key::Ctrl, false}});
        turn({TextInput{typed}});
        turn({KeyChange{Key::Enter, true}, KeyChange{Key::Enter, false}});
    };
    app_.start_recording();
    window_->set_clipboard("0 0 0\n0 1 0");
    turn({KeyChange{Key::Ctrl, true}, KeyChange{Key::V, true}, KeyChange{Key::V, false},
          KeyChange{Key::Ctrl, false}});
    EXPECT_EQ(part().chain.size(), 2u);
    window_->set_clipboard("[[0, 0, 0], [0, 1, 0], [0, 2, 0]]");
    palette("Paste points");
    EXPECT_EQ(part().chain.size(), 3u);
    EXPECT_FALSE(app_.workspace().ui.palette);

    window_->set_clipboard("0 0 0\n0 0 1\n0 0 2\n0 0 3");
    const auto click = [&](glm::vec2 at) {
        turn({MouseMove{at}, MousePress{MouseButton::Left, true}, MousePress{MouseButton::Left, false}});
    };
    click({23.0f, 20.0f});
    std::optional<glm::vec2> row, key;
    for (const DrawnText& each : recorder_.frame().texts) {
        if (each.text == "Paste") row = 0.5f * (each.box.min + each.box.max);
        if (each.text == "Ctrl+V") key = 0.5f * (each.box.min + each.box.max);
    }
    ASSERT_TRUE(row && key);
    EXPECT_NEAR(row->y, key->y, 1.0f) << "the menu shows its key";
    click(*row);
    EXPECT_EQ(part().chain.size(), 4u);

    const TempFolder folder;
    write(folder / "recording.jsonl", app_.recording());
    EXPECT_TRUE(succeeded(run_program({"--headless", "--script", (folder / "recording.jsonl").string(),
                                       "--state", (folder / "state.json").string()})));
    EXPECT_EQ(parse_json(read(folder / "state.json"))["segments"], app_.state()["segments"]);
}

}  // namespace
}  // namespace tendril::test
