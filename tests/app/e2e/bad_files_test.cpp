// Unreadable scripts and scenes: exit code 2 (or a refusal in a window), one line, and nothing overwritten.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

class BadFiles : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    Outcome run_script(const std::string& text) {
        write(folder_ / "script.jsonl", text);
        return run_here({"--headless", "--script", path("script.jsonl"), "--state", path("state.json")});
    }
    bool left_nothing() const { return !std::filesystem::exists(folder_ / "state.json"); }
    TempFolder folder_;
};

TEST_F(BadFiles, ScriptsNameTheLineAndRunNothing) {
    const std::string ran = ScriptText().line({{"state", path("ran.json")}}).text();
    for (const char* line :
         {"no JSON at all", "{}", "{\"command\": \"chain.explode\"}", "{\"recording\": 1}", "\x01\x02\xFF"}) {
        const Outcome outcome = run_script(ran + "\n" + line + "\n");
        EXPECT_TRUE(complained(outcome, 2, {path("script.jsonl"), "line 3"})) << line;
        EXPECT_TRUE(left_nothing()) << line;
        EXPECT_FALSE(std::filesystem::exists(folder_ / "ran.json")) << line;
    }
}

TEST_F(BadFiles, RecordingsThatAreBrokenNewerOrHalf) {
    const std::string good = [&] {
        write(folder_ / "script.jsonl", "{\"wait\": 1}\n");
        EXPECT_TRUE(succeeded(
            run_program({"--headless", "--script", path("script.jsonl"), "--record", path("r.jsonl")})));
        return read(folder_ / "r.jsonl");
    }();
    const app::Json start = app::parse_json(good.substr(0, good.find('\n')));
    const auto with = [&](const char* key, const app::Json& value) {
        app::Json changed = start;
        changed[key] = value;
        return changed.dump() + "\n";
    };
    app::Json future = start["scene"];
    future["tendril_scene"] = 99;
    for (const std::string& script :
         {with("recording", 2), with("recording", "one"), with("size", {0, 0}), with("size", "large"),
          with("lab", "kitchen"), with("scene", 7), with("scene", app::Json::object()), with("scene", future),
          with("settings", {{"theme", "plaid"}}), with("settings", nullptr), with("and", "more")}) {
        EXPECT_TRUE(complained(run_script(script), 2, {path("script.jsonl") + ": line 1: "}))
            << script.substr(0, 80);
        EXPECT_TRUE(left_nothing());
    }
    app::Json half = start;
    half.erase("scene");
    EXPECT_TRUE(complained(run_script(half.dump() + "\n"), 2, {"scene"}));
}

TEST_F(BadFiles, OpenedWhileTheProgramRunsAreRefusedAndTheSceneIsKept) {
    write(folder_ / "broken.json", "{\"tendril_scene\": 1, \"lab\"");
    write(folder_ / "large.json", "");
    std::filesystem::resize_file(folder_ / "large.json", 70u << 20);
    ScriptText script = ScriptText().command("chain.target", {{"to", {3, 2, 1}}});
    const auto before = state_after(script);
    script.command("scene.open", {{"path", path("broken.json")}}, true);
    script.command("scene.open", {{"path", path("large.json")}}, true);
    script.line({{"drop", app::Json::array({path("none.json")})}});
    const Outcome outcome = run_script(script.text());
    EXPECT_TRUE(complained(outcome, 0, {path("none.json")}))
        << "a dropped file that cannot be read is told, no more";
    EXPECT_EQ(app::parse_json(read(folder_ / "state.json")), before);
    script.command("undo");
    EXPECT_EQ(run_script(script.text()).exit_code, 0) << "the history is kept too";
}

TEST_F(BadFiles, ASceneThatIsOpenedIsWhatWasSaved) {
    ScriptText script;
    script.command("chain.preset", {{"name", "random"}, {"count", 31}, {"seed", 5}})
        .command("chain.mode", {{"mode", "with_index"}, {"index", 11}})
        .command("chain.target", {{"to", {0.1, 2.3, -0.7}}})
        .command("camera.set", {{"yaw_deg", 12.3}, {"pitch_deg", 4.5}})
        .command("scene.save", {{"path", path("scene.json")}});
    const auto saved = state_after(script);
    const Outcome outcome = run_program({"--headless", path("scene.json"), "--state", path("state.json")});
    EXPECT_TRUE(succeeded(outcome));
    EXPECT_EQ(app::parse_json(read(folder_ / "state.json")), saved);
    const auto dropped = state_after(ScriptText().line({{"drop", app::Json::array({path("scene.json")})}}));
    EXPECT_EQ(dropped["segments"], saved["segments"]);
}

// Commands with hostile arguments in scripts: refused with a reason and an exit code, the document unchanged.

struct Refusal {
    std::string line;  ///< the script line, without the closing brace
    std::string told;  ///< part of the reason
};

/// Each line is valid JSON. The labs' own tests cover the others.
const std::vector<Refusal> refusals{
    {R"({"command": "chain.add")", "length"},
    {R"({"command": "chain.add", "length": 1, "colour": "red")", "colour"},
    {R"({"command": "chain.insert", "index": 8, "length": 1)", "8"},
    {R"({"command": "chain.mode", "mode": "sideways")", "sideways"},
    {R"({"command": "chain.clear", "default_direction": [0, 0, 0])", "direction"},
    {R"({"command": "chain.seek", "tick": 4)", "path"},
    {R"({"command": "lab.open", "name": "kitchen")", "kitchen"},
    {R"({"command": "undo")", "undo"},
    {R"({"command": "scene.open", "path": "/no/such/scene.json")", "/no/such/scene.json"},
    {R"({"command": "scene.save", "path": "/no/such/folder/scene.json")", "/no/such/folder/scene.json"},
    {R"({"command": "scene.save")", "path"},
};

class RefusedCommand : public BadFiles {
  protected:
    std::string state() const { return read(folder_ / "state.json"); }
};

LABEL(slow, "RefusedCommand.ChangesNothingAndEndsTheScriptWith1");

TEST_F(RefusedCommand, ChangesNothingAndEndsTheScriptWith1) {
    EXPECT_TRUE(succeeded(run_script("{\"wait\": 1}\n")));
    const std::string before = state();
    for (const Refusal& refusal : refusals) {
        const Outcome outcome =
            run_script("{\"wait\": 1}\n" + refusal.line + "}\n{\"command\": \"chain.clear\"}\n");
        EXPECT_TRUE(complained(outcome, 1, {"line 2", refusal.told})) << refusal.line;
        EXPECT_EQ(state(), before) << refusal.line;
    }
}

TEST_F(RefusedCommand, AsExpectedLetsTheScriptGoOn) {
    std::string script;
    for (const Refusal& refusal : refusals) script += refusal.line + ", \"refused\": true}\n";
    script += "{\"command\": \"undo\", \"refused\": true}\n";  // they leave no step to undo
    EXPECT_TRUE(succeeded(run_script("{\"wait\": 1}\n")));
    const std::string before = state();
    EXPECT_EQ(run_script(script).exit_code, 0);
    EXPECT_EQ(state(), before);
}

TEST_F(RefusedCommand, WhereItWasAcceptedIsAFailure) {
    const Outcome outcome = run_script("{\"command\": \"chain.add\", \"length\": 1, \"refused\": true}\n");
    EXPECT_TRUE(complained(outcome, 1, {"line 1", "chain.add"}));
    EXPECT_FALSE(state().empty());
}

TEST_F(RefusedCommand, AFailedExpectationReportsTheValueAndWritesTheState) {
    struct Failing {
        const char* line;
        const char* found;
    };
    for (const Failing& failing : {Failing{R"({"expect": "mode", "equals": "forward"})", "backward"},
                                   Failing{R"({"expect": "moon", "equals": 1})", "moon"}}) {
        const Outcome outcome =
            run_script(std::string("{\"wait\": 1}\n") + failing.line + "\n{\"command\": \"chain.clear\"}\n");
        EXPECT_TRUE(complained(outcome, 1, {"line 2", failing.found})) << failing.line;
        EXPECT_EQ(app::parse_json(state())["segments"].size(), 8u) << failing.line;
    }
}

// Unlikely input: windows of every shape, extreme numbers, very long text. The program must not crash.

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
