// The Signal lab in the running program: dragging the ball, drawing a response, small windows.
#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

ScriptText opened() {
    return ScriptText().command("lab.open", {{"name", "signal"}});
}

ScriptText signal_lab() {
    return opened().command("signal.input", {{"kind", "hand"}}).wait(10);
}

ScriptText dragged_ball(const ScriptText& before, float pixels) {
    const glm::vec2 at = handle(state_after(before), "hand");
    ScriptText script = before;
    script.move(at).down();
    for (int i = 1; i <= 10; ++i) script.move(at - glm::vec2(0.0f, 0.1f * static_cast<float>(i) * pixels));
    return script;
}

TEST(SignalInTheWindow, TheDraggedBallIsTheInput) {
    const ScriptText before = signal_lab();
    ScriptText script = dragged_ball(before, 60.0f).up().wait(120);
    const Json state = state_after(script);
    EXPECT_EQ(state.at("input").at("kind"), "hand");
    const double input = state.at("input").at("value").get<double>();
    EXPECT_GT(input, 0.3);
    EXPECT_NEAR(state.at("output").get<double>(), input, 0.1 * input) << "the spring follows";
    const float moved = handle(state_after(before), "hand").y - handle(state, "hand").y;
    EXPECT_NEAR(moved, 60.0f, 1.5f);
    const Json back = state_after(script.command("undo").wait(1));
    EXPECT_NEAR(back.at("input").at("value").get<double>(), 0.0, 1e-6) << "the whole drag is one step";
}

TEST(SignalInTheWindow, DraggingReplacesAWave) {
    const ScriptText before = opened().wait(30).command("time.pause");
    ScriptText script = dragged_ball(before, -30.0f).up();
    EXPECT_EQ(state_after(script).at("input").at("kind"), "hand");
}

TEST(SignalInTheWindow, AResponseIsDrawnWithTheMouse) {
    ScriptText script = opened().command("time.pause").command("signal.plot", {{"name", "fit"}}).wait(2);
    script.drag({{450, 560}, {470, 560}, {500, 540}, {560, 500}, {600, 500}});
    script.command("signal.fit");
    const Json state = state_after(script);
    EXPECT_EQ(state.at("plot"), "fit");
    EXPECT_FALSE(state.at("fits").empty());
    const Json undone = state_after(script.command("undo").command("undo"));
    EXPECT_TRUE(undone.at("fits").empty());
    script.command("signal.fit", Json::object(), true);
    EXPECT_TRUE(state_after(script).at("fits").empty()) << "what was drawn is undone in one step";
}

double most_wanted_after(ScriptText script) {
    const Json scene = scene_after(script);
    const Json& wanted = scene.at("labs").at("signal").at("fit").at("wanted");
    double most = 0.0;
    for (const Json& each : wanted) most = std::max(most, each.get<double>());
    return most;
}

/// The axes make room for the drawn curve only once the button is up: otherwise the value under a resting
/// mouse would grow in every frame.
TEST(SignalInTheWindow, TheAxesOfAResponseStayWhileItIsDrawn) {
    ScriptText script = opened()
                            .command("signal.preset", {{"name", "spring"}})
                            .command("signal.plot", {{"name", "fit"}})
                            .wait(150);
    script.move({400, 560}).wait(1).down().move({450, 500}).move({500, 410});
    ScriptText held = script;
    const double at_once = most_wanted_after(script.up().wait(3));
    EXPECT_GT(at_once, 1.7) << "there is room over the response";
    EXPECT_LT(at_once, 3.0);
    EXPECT_NEAR(most_wanted_after(held.wait(60).up().wait(3)), at_once, 0.1);
}

/// The row of pixels where the lower plot's input crosses a column.
float row_of_input(const app::Image& picture, int column) {
    int best = 0, most = -1;
    for (int y = picture.size.y / 2; y < picture.size.y - 100; ++y) {
        const std::uint8_t* at =
            &picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.size.x) +
                               static_cast<std::size_t>(column))];
        const int orange = at[0] + at[1] - 2 * at[2];
        if (orange > most) most = orange, best = y;
    }
    return static_cast<float>(best) + 0.5f;
}

TEST(SignalInTheWindow, AResponseIsDrawnWhereTheMouseIs) {
    ScriptText script = opened()
                            .command("signal.input", {{"kind", "square"}, {"period", 4}})
                            .command("signal.plot", {{"name", "fit"}})
                            .command("time.pause")
                            .wait(3);
    const float row = row_of_input(play(script, {.picture = true}).picture, 340);  // at 1.0
    script.drag({{320, row}, {330, row}, {400, row}});
    const Json scene = scene_after(script);
    const Json& wanted = scene.at("labs").at("signal").at("fit").at("wanted");
    for (std::size_t i = 15; i < 40; ++i) EXPECT_NEAR(wanted[i].get<double>(), 1.0, 0.05) << i;
}

/// The window stays responsive; a script's command completes at once, with the same result.
TEST(SignalInTheWindow, AFitStartedByAButtonContinuesFromTickToTick) {
    const glm::vec2 fit{1060.0f, 306.0f};
    const ScriptText drawn =
        opened()
            .command("signal.input", {{"kind", "square"}, {"period", 4}})
            .command("time.pause")
            .command("signal.fit.draw",
                     {{"from", 2.5}, {"from_value", -1.5}, {"to", 2.7}, {"to_value", -1.3}})
            .wait(3);
    ScriptText clicked = drawn;
    const Json running = state_after(clicked.click(fit).wait(15));
    EXPECT_EQ(running.at("fitting"), true);
    EXPECT_GT(running.at("fits").size(), 1u);
    EXPECT_LT(running.at("fits").size(), 10u);
    const Json done = state_after(clicked.wait(100));
    EXPECT_EQ(done.at("fitting"), false);
    ScriptText at_once = drawn;
    EXPECT_EQ(done.at("fits"), state_after(at_once.command("signal.fit")).at("fits"));
    ScriptText cancelled = drawn;
    const Json stopped = state_after(cancelled.click(fit).wait(15).click(fit).wait(30));
    EXPECT_EQ(stopped.at("fitting"), false);
    EXPECT_EQ(stopped.at("fits"), running.at("fits")) << "what is fitted stays";
}

TEST(SignalInTheWindow, AResponseIsShownWithTheOutputBall) {
    const ScriptText before = opened()
                                  .command("signal.input", {{"kind", "square"}, {"period", 4}})
                                  .wait(40)
                                  .command("signal.fit.record")
                                  .wait(30);
    const Json armed = state_after(before);
    EXPECT_EQ(armed.at("seconds"), 0.0) << "it waits for the hand";
    const glm::vec2 at = handle(armed, "output");
    ScriptText script = before;
    script.move(at).down();
    for (int i = 1; i <= 10; ++i) script.move(at - glm::vec2(0.0f, 5.0f * static_cast<float>(i)));
    script.wait(20).up().wait(20);
    const Json state = state_after(script);
    EXPECT_EQ(state.at("recording"), false) << "letting go ends it";
    EXPECT_GT(state.at("wanted").get<int>(), 25);
    EXPECT_LT(state.at("wanted").get<int>(), 40);
    EXPECT_EQ(state.at("input").at("kind"), "square") << "the input is not the hand";
    const Json undone = state_after(script.command("undo"));
    EXPECT_EQ(undone.at("recording"), true) << "the drag is one step";
    EXPECT_EQ(undone.at("seconds"), 0.0);
}

/// The editor of a curve with three keys, at the end of the panel, with nothing moving.
class CurveInTheWindow : public testing::Test {
  protected:
    CurveInTheWindow() {
        const Json keys = {{{"time", 0}, {"value", 0}, {"piece", "cubic"}},
                           {{"time", 0.5}, {"value", 0.8}, {"piece", "cubic"}},
                           {{"time", 1}, {"value", 1}}};
        script.command("lab.open", {{"name", "signal"}})
            .command("time.pause")
            .command("view.fold", {{"section", "signal: Input"}, {"folded", false}})
            .command("signal.clear")
            .command("signal.filter.add", {{"kind", "curve"}, {"keys", keys}})
            .wait(3);
    }
    Json state() { return play(script, {.more = {"--size", "1280x1200"}}).state; }
    Json keys() { return state().at("filters").at(0).at("keys"); }
    static constexpr glm::vec2 middle{128.0f, 856.0f};  ///< the key at 0.5
    ScriptText script;
};

TEST_F(CurveInTheWindow, AKeyIsDraggedAndThatIsOneStep) {
    script.drag({middle, middle + glm::vec2(10.0f, 10.0f), middle + glm::vec2(22.0f, 30.0f)}).wait(2);
    const Json moved = keys();
    ASSERT_EQ(moved.size(), 3u);
    EXPECT_NEAR(moved[1].at("time").get<double>(), 0.6, 0.02);
    EXPECT_NEAR(moved[1].at("value").get<double>(), 0.6, 0.05);
    EXPECT_EQ(moved[1].at("piece"), "cubic");
    EXPECT_EQ(moved[0], keys()[0]);
    script.command("undo").wait(2);
    EXPECT_NEAR(keys()[1].at("time").get<double>(), 0.5, 1e-9);
    EXPECT_NEAR(keys()[1].at("value").get<double>(), 0.8, 1e-9);
}

TEST_F(CurveInTheWindow, AKeyStaysUnderAMouseAtRest) {
    const glm::vec2 up = middle + glm::vec2(0.0f, -40.0f);
    const ScriptText before = script;
    script.drag({middle, up}).wait(2);
    const double at_once = keys()[1].at("value").get<double>();
    EXPECT_GT(at_once, 1.0);
    script = before;
    script.move(middle).down().move(up).wait(60).up().wait(2);
    EXPECT_NEAR(keys()[1].at("value").get<double>(), at_once, 1e-6);
}

TEST_F(CurveInTheWindow, AKeyStaysBetweenItsNeighbours) {
    script.drag({middle, middle + glm::vec2(20.0f, 0.0f), middle + glm::vec2(300.0f, 0.0f)}).wait(2);
    const double time = keys()[1].at("time").get<double>();
    EXPECT_LT(time, 1.0);
    EXPECT_GT(time, 0.99);
}

TEST_F(CurveInTheWindow, ADoubleClickAddsAKeyAndARightClickRemovesIt) {
    const glm::vec2 free = middle + glm::vec2(-60.0f, -10.0f);
    script.click(free).click(free).wait(2);
    const Json added = keys();
    ASSERT_EQ(added.size(), 4u);
    EXPECT_NEAR(added[1].at("time").get<double>(), 0.22, 0.02);
    EXPECT_EQ(added[1].at("piece"), "cubic") << "it goes on as the key before it";
    script.move(free).down("right").up("right").wait(2);
    const Json removed = keys();
    ASSERT_EQ(removed.size(), 3u);
    EXPECT_EQ(removed[1].at("time"), 0.5);
    script.move(middle).down("right").up("right").wait(2);
    EXPECT_EQ(keys().size(), 2u) << "any key";
    script.command("undo").command("undo").command("undo");
    EXPECT_EQ(keys().size(), 3u);
}

TEST_F(CurveInTheWindow, ATangentIsDraggedByItsEnd) {
    // Its handle is a fixed length to the right of a key with a level tangent.
    script.click(middle).wait(2);
    const glm::vec2 end = middle + glm::vec2(39.0f, 0.0f);
    script.drag({end, end + glm::vec2(0.0f, -10.0f), end + glm::vec2(-10.0f, -30.0f)}).wait(2);
    const Json key = keys()[1];
    EXPECT_GT(key.value("leave", 0.0), 0.5);
    EXPECT_EQ(key.value("arrive", 0.0), 0.0);
    EXPECT_EQ(key.at("time"), 0.5);
}

/// A filter's numbers are of its curve in the plot, so of those above it too where it follows them.
TEST(SignalInTheWindow, EachNumberNamesItsFilter) {
    const auto window = app::open_offscreen({1440, 1400});
    app::App app(*window);
    FrameRecorder recorder;
    const auto says = [&](const std::string& text) {
        app.settle();
        return std::ranges::any_of(recorder.frame().texts,
                                   [&](const DrawnText& each) { return each.text == text; });
    };
    app.run({"lab.open", Json{{"name", "signal"}}});
    app.run({"signal.preset", Json{{"name", "spring"}}});
    app.run({"signal.input", Json{{"kind", "noise"}}});
    app.run({"signal.plot", Json{{"name", "shelf"}}});
    const char* const follows = "with those above it, from the input on";
    app.run({"signal.filter.add", Json{{"kind", "one_euro"}, {"beside", true}}});
    EXPECT_FALSE(says(follows));
    app.run({"signal.filter.beside", Json{{"at", 1}}});
    EXPECT_TRUE(says(follows));
}

TEST(SignalInTheWindow, AFileIsTypedIntoThePanel) {
    const TempFolder folder;
    write(folder / "rows.csv", "dt,input\n0.5,7\n0.5,-7\n");
    ScriptText script =
        opened().command("view.fold", {{"section", "signal: Input"}, {"folded", false}}).wait(2);
    script.click({170.0f, 466.0f}).text((folder / "rows.csv").c_str());
    EXPECT_EQ(state_after(script).at("input").at("kind"), "square") << "not before Enter";
    const Json state = state_after(script.key("enter").wait(10));
    EXPECT_EQ(state.at("input").at("kind"), "csv");
    EXPECT_EQ(state.at("input").at("value"), 7.0);
}

TEST(SignalInTheWindow, ADroppedCsvThatIsRefusedSaysWhy) {
    const TempFolder folder;
    write(folder / "rows.csv", "dt,input\n0.5,7\n0.5,-7\n");
    write(folder / "hole.csv", "dt,input\n0.5,\n");
    const auto drop = [&](const char* lab, const char* file) {
        const ScriptText script = ScriptText()
                                      .command("lab.open", {{"name", lab}})
                                      .line({{"drop", Json::array({(folder / file).string()})}})
                                      .wait(2);
        write(folder / "script.jsonl", script.text());
        return run_program({"--headless", "--script", (folder / "script.jsonl").string(), "--state",
                            (folder / "state.json").string()});
    };
    const auto state = [&] { return app::parse_json(read(folder / "state.json")); };
    EXPECT_TRUE(complained(drop("signal", "hole.csv"), 0, {"hole.csv", "row 2, column 2"}));
    EXPECT_EQ(state().at("input").at("kind"), "square");
    EXPECT_TRUE(complained(drop("chain", "hole.csv"), 0, {"hole.csv", "row 2, column 2"}));
    EXPECT_EQ(state().at("segments").size(), 8u);
}

TEST(SignalInTheWindow, AHandAtRestLetsTheWindowIdle) {
    ScriptText script = signal_lab().wait(650);
    const Json rested = state_after(script), later = state_after(script.wait(100));
    EXPECT_EQ(rested.at("seconds"), later.at("seconds"));
    EXPECT_LT(rested.at("seconds").get<double>(), 10.5);
}

}  // namespace
}  // namespace tendril::test
