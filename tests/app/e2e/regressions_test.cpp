// Regressions, seen from outside: the user's or script's actions, and the correct result.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

TEST(OnceWrong, EscapeInADragWithoutEffectUndoesNothingElse) {
    // Along Z, seen from the front, a drag has no effect.
    ScriptText script;
    script.command("chain.target", {{"to", app::Json::array({5, 3, 0})}})
        .command("camera.view", {{"name", "front"}});
    script.command("camera.orthographic").command("camera.frame", {{"what", "all"}});
    const app::Json before = state_after(ScriptText(script));
    const glm::vec2 at = handle(before, "target");
    script.move(at).hold("z").down().move(at + glm::vec2(12, 0)).key("escape").up();
    EXPECT_EQ(state_after(script)["target"], before["target"]);
}

/// The mouse rested on the hand's handle, which was drawn once more after its removal: a crash.
TEST(OnceWrong, AHandMayVanishUnderTheMouse) {
    const TempFolder folder;
    const std::string two_nodes = (folder / "two.bvh").string(), scene = (folder / "two.json").string();
    write(two_nodes,
          "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT b\n{\nOFFSET "
          "0 1 0\n"
          "CHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n}\nMOTION\nFrames: 1\n"
          "Frame Time: 0.03\n0 0 0 0 0 0\n");
    const auto load = [&](ScriptText& script) { script.command("humanoid.load", {{"path", two_nodes}}); };
    const auto rest_on_hand = [](ScriptText& script) {
        script.line({{"mouse", "move"}, {"to", "right_hand"}}).wait(2);
    };
    std::vector<ScriptText> ways(4);
    rest_on_hand(ways[0]);
    ways[0].command("humanoid.map", {{"bone", "RightHand"}});
    rest_on_hand(ways[1]);
    load(ways[1]);
    load(ways[2]);
    ways[2].command("humanoid.load");
    rest_on_hand(ways[2]);
    ways[2].command("undo");
    load(ways[3]);
    ways[3].command("scene.save", {{"path", scene}}).command("humanoid.load");
    rest_on_hand(ways[3]);
    ways[3].command("scene.open", {{"path", scene}});
    for (ScriptText& way : ways) {
        const app::Json state = play(way.wait(3), {.more = {"--lab", "humanoid"}}).state;
        for (const app::Json& each : state.at("handles")) EXPECT_NE(each.at("name"), "right_hand");
    }
}

/// State of the old chain remained, and the saved scene could not be opened.
TEST(OnceWrong, AChainReplacedAfterADragIsSavedAndOpened) {
    const TempFolder folder;
    const std::string path = (folder / "scene.json").string();
    const app::Json pole = {3, 3, 3};
    for (const auto& [command, arguments] :
         std::vector<std::pair<const char*, app::Json>>{{"chain.preset", {{"name", "snake"}, {"count", 39}}},
                                                        {"chain.preset", {{"name", "coil"}, {"count", 3}}},
                                                        {"chain.clear", app::Json::object()},
                                                        {"chain.reset", app::Json::object()},
                                                        {"chain.add", {{"length", 1}}}})
        for (const char* undo : {"", "undo"}) {
            ScriptText script;
            script.command("chain.pole", {{"to", pole}})
                .command("chain.target", {{"to", {4, 3, 0}}})
                .command("chain.target", {{"to", {3, 4, 1}}})
                .command(command, arguments);
            if (*undo != 0) script.command(undo);
            script.command("scene.save", {{"path", path}}).command("scene.open", {{"path", path}});
            state_after(script);
            const std::string saved = read(path);
            std::filesystem::remove(path);
            state_after(script.command("scene.save", {{"path", path}}));
            EXPECT_EQ(read(path), saved) << command << ' ' << undo;
            std::filesystem::remove(path);
        }
}

TEST(OnceWrong, AStepOfTimeIsTakenAtOnce) {
    ScriptText script = ScriptText().command("time.step").line({{"expect", "time.tick"}, {"equals", 1}});
    script.command("time.step").command("time.step").line({{"expect", "time.tick"}, {"equals", 3}});
    state_after(script);
}

TEST(OnceWrong, AHeldKeyDoesNotToggleRepeatedly) {
    ScriptText script;
    for (int i = 0; i < 3; ++i) script.hold("space");
    script.release("space");
    script.line({{"expect", "time.playing"}, {"equals", false}});
    state_after(script);
}

TEST(OnceWrong, EqualTapsEachCount) {
    ScriptText script = ScriptText().key("ctrl+k").text("chain.add length=12345");
    for (int i = 0; i < 4; ++i) script.key("backspace");
    script.key("enter").wait(1).line({{"expect", "segments.8.length"}, {"equals", 1}});
    state_after(script);
}

TEST(OnceWrong, ALeftDragOverNothingLeavesTheSelection) {
    ScriptText script = ScriptText().command("chain.select", {{"index", 2}}).drag({{640, 150}, {420, 200}});
    script.line({{"expect", "selected"}, {"equals", 2}});
    script.click({640, 150}).line({{"expect", "selected"}, {"equals", nullptr}});
    state_after(script);
}

TEST(OnceWrong, TheScriptInTheReadmeRuns) {
    const TempFolder folder;
    std::istringstream readme(read(source_path("app/README.md")));
    std::string script;
    for (std::string line; std::getline(readme, line);) {
        if (line.starts_with("    {\"") && line.find("screenshot") == std::string::npos)
            script += line + "\n";
    }
    write(folder / "readme.jsonl", script);
    EXPECT_GT(script.size(), 200u);
    EXPECT_TRUE(succeeded(run_program({"--headless", "--script", (folder / "readme.jsonl").string()})));
}

}  // namespace
}  // namespace tendril::test
