// Unlikely input: windows of every shape, extreme numbers, very long text. The program must not crash.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

/// Plays to the end and draws a picture, whatever is refused on the way.
testing::AssertionResult survives(const ScriptText& script) {
    const TempFolder folder;
    write(folder / "script.jsonl", script.text());
    const Outcome outcome = run_here({"--headless", "--script", (folder / "script.jsonl").string(),
                                      "--screenshot", (folder / "picture.png").string()});
    if (outcome.exit_code == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "exit code " << outcome.exit_code << ": " << outcome.err.substr(0, 400);
}

TEST(Extremes, WindowsOfEveryShapeWithEverySheetOpen) {
    for (const char* open : {"f9", "?", "ctrl+k", "ctrl+,", "ctrl+o"}) {
        ScriptText script = ScriptText().key(open);
        for (const int width : {1, 40, 200, 640, 2000})
            for (const int height : {1, 40, 200, 600}) script.line({{"resize", {width, height}}}).wait(1);
        script.line({{"resize", {16384, 1}}}).line({{"resize", {1, 16384}}}).line({{"resize", {640, 480}}});
        EXPECT_TRUE(survives(script)) << open;
    }
}

TEST(Extremes, TextsOfEverySize) {
    for (const double scale : {0.5, 3.0}) {
        ScriptText script;
        script.command("view.text_scale", {{"scale", scale}}).key("?").line({{"resize", {300, 200}}}).wait(2);
        EXPECT_TRUE(survives(script)) << scale;
    }
}

TEST(Extremes, AWheelThatTurnsAMillionTimes) {
    for (const float by : {-1e9f, -1e8f, 1e9f})
        for (const glm::vec2 at : {glm::vec2(140, 400), glm::vec2(640, 400), glm::vec2(1150, 450)}) {
            EXPECT_TRUE(survives(ScriptText().line({{"resize", {1100, 336}}}).move(at).wheel(by).wait(2)))
                << by << " at " << at.x;
            EXPECT_TRUE(survives(ScriptText().move(at).wheel(by).wheel(-by).wait(2))) << by << " at " << at.x;
        }
    EXPECT_TRUE(survives(ScriptText().line({{"resize", {689, 336}}}).move({524, 174}).wheel(-3e8f).wait(2)));
}

TEST(Extremes, AMouseThatIsKilometresAway) {
    ScriptText script = ScriptText().move({1e9f, -1e9f}).down().move({-1e9f, 1e9f}).up();
    script.drag({{640, 400}, {1e9f, 1e9f}, {0, 0}}, "right")
        .drag({{640, 400}, {1e9f, 1e9f}, {0, 0}}, "middle");
    EXPECT_TRUE(survives(script));
    EXPECT_TRUE(survives(ScriptText().drag({handle(first_state(), "target"), {1e9f, 1e9f}, {-1e9f, 0}})));
}

TEST(Extremes, ANovelTypedIntoThePalette) {
    EXPECT_TRUE(
        survives(ScriptText().key("ctrl+k").text(std::string(300'000, 'x').c_str()).key("enter").wait(3)));
    EXPECT_TRUE(survives(
        ScriptText().key("ctrl+k").text("\xF0\x9F\x8E\xA8\xC3\xA4\xE4\xB8\xAD\x01\n\t").key("enter")));
}

TEST(Extremes, AVeryLongRefusalIsPrintedInOneLine) {
    ScriptText script;
    script.command("scene.open", {{"path", "/" + std::string(100'000, 'y')}}, true).wait(1);
    EXPECT_TRUE(survives(script));
    const ScriptText three_lines = ScriptText().command("scene.open", {{"path", "/no\nsuch\nfile"}});
    EXPECT_TRUE(complained(run_script(three_lines), 1, {"line 1"}));
}

TEST(Extremes, FiveHundredRefusalsAtOnce) {
    ScriptText script;
    for (int i = 0; i < 500; ++i) script.command("chain.remove", {{"index", 1000 + i}}, true);
    EXPECT_TRUE(survives(script.wait(1)));
}

TEST(Extremes, ChainsNearTheLimitsOfTheirNumbers) {
    const std::vector<ScriptText> scripts{
        ScriptText().command("chain.target", {{"to", {1e9, 1e9, 1e9}}}),
        ScriptText().command("chain.set_length", {{"index", 2}, {"length", 1e9}}),
        ScriptText()
            .command("chain.clear")
            .command("chain.add", {{"length", 1e-30}})
            .command("chain.add", {{"length", 1e-30}}),
        ScriptText()
            .command("chain.clear")
            .command("chain.add", {{"length", 0}})
            .command("chain.add", {{"length", 0}}),
        ScriptText().command("chain.clear"),
        ScriptText().command("camera.set", {{"distance", 1e7}, {"target", {1e9, 0, 0}}}),
        ScriptText().command("camera.set", {{"distance", 1e-3}}),
    };
    for (ScriptText script : scripts) {
        for (const char* key : {"home", "f", "1", "3", "7", "5", "b", "l"}) script.key(key);
        EXPECT_TRUE(survives(script.wait(1).drag({{640, 400}, {500, 300}}))) << script.text();
    }
}

}  // namespace
}  // namespace tendril::test
