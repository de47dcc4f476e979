// Quitting with unsaved work asks first, and does what the user then chooses.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

std::size_t segments(const app::Json& state) {
    return state.at("segments").size();
}

/// Ctrl+Q in a scene with or without a change; an additional segment shows that the program continued.
app::Json after_ctrl_q(bool changed, const ScriptText& then = {}) {
    ScriptText script;
    if (changed) script.command("chain.add", {{"length", 0.5}});
    script.key("ctrl+q").wait(2).lines(then).wait(2).command("chain.add", {{"length", 0.25}});
    return state_after(script);
}

TEST(UnsavedWork, IsAskedFor) {
    const std::size_t at_first = segments(state_after(ScriptText()));
    EXPECT_EQ(segments(after_ctrl_q(false)), at_first) << "nothing to save: it has quit";
    EXPECT_EQ(segments(after_ctrl_q(true)), at_first + 2) << "it asks, and goes on meanwhile";
    EXPECT_EQ(segments(after_ctrl_q(true, ScriptText().key("escape"))), at_first + 2);
    EXPECT_EQ(segments(after_ctrl_q(true, ScriptText().command("quit", {{"unsaved", "discard"}}))),
              at_first + 1);
    EXPECT_EQ(segments(after_ctrl_q(true, ScriptText().command("quit"))), at_first + 1);
}

TEST(UnsavedWork, IsSavedOnTheWayOut) {
    const TempFolder folder;
    const std::string file = (folder / "arm.json").string();
    ScriptText script;
    script.command("scene.save", {{"path", file}}).command("chain.add", {{"length", 0.5}});
    script.key("ctrl+q")
        .command("quit", {{"unsaved", "save"}})
        .wait(2)
        .command("chain.add", {{"length", 0.25}});
    const app::Json state = state_after(script);
    EXPECT_EQ(segments(state), segments(state_after(ScriptText())) + 1);
    EXPECT_EQ(app::parse_json(read(file)).at("labs").at("chain").at("segments").size(), segments(state));
}

/// A scene without a name gets one first; the dialog can be cancelled.
TEST(UnsavedWork, WithoutANameIsGivenOne) {
    const TempFolder folder;
    const std::string file = (folder / "new.json").string();
    ScriptText begin;
    begin.command("chain.add", {{"length", 0.5}}).command("quit", {{"unsaved", "save"}});
    ScriptText saved = begin;
    saved.command("scene.save", {{"path", file}}).wait(2).command("chain.add", {{"length", 0.25}});
    const std::size_t at_first = segments(state_after(ScriptText()));
    EXPECT_EQ(segments(state_after(saved)), at_first + 1);
    EXPECT_TRUE(std::filesystem::exists(file));
    ScriptText cancelled = begin;
    cancelled.wait(2)
        .key("escape")
        .command("scene.save", {{"path", file}})
        .wait(2)
        .command("chain.add", {{"length", 0.25}});
    EXPECT_EQ(segments(state_after(cancelled)), at_first + 2) << "saving later does not quit";
}

/// The request to quit ends with the dialog: a later save only saves.
TEST(UnsavedWork, AfterAnotherSceneWasOpenedASaveOnlySaves) {
    const TempFolder folder;
    const std::string other = (folder / "other.json").string(), file = (folder / "new.json").string();
    play(ScriptText().command("scene.save", {{"path", other}}));
    ScriptText script;
    script.command("chain.add", {{"length", 0.5}}).command("quit", {{"unsaved", "save"}}).wait(2);
    script.command("scene.open", {{"path", other}}).command("chain.add", {{"length", 0.5}});
    script.command("scene.save", {{"path", file}}).wait(2).command("chain.add", {{"length", 0.25}});
    EXPECT_EQ(segments(state_after(script)), segments(state_after(ScriptText())) + 2);
}

/// Saving answers the question.
TEST(UnsavedWork, SavedMeanwhileIsNotAskedForAgain) {
    const TempFolder folder;
    const std::string file = (folder / "arm.json").string();
    ScriptText asked = ScriptText().command("chain.add", {{"length", 0.5}}).key("ctrl+q").wait(2);
    asked.command("scene.save", {{"path", file}}).wait(400);
    ScriptText plain;
    plain.command("chain.add", {{"length", 0.5}}).command("scene.save", {{"path", file}}).wait(400);
    EXPECT_EQ(play(asked, {.picture = true}).picture.rgba, play(plain, {.picture = true}).picture.rgba);
}

// Termination by signals: a clean end with everything written.

class Signals : public testing::TestWithParam<int> {};

TEST_P(Signals, EndItCleanlyWithEverythingWritten) {
    const TempFolder folder;
    const auto path = [&](const char* name) { return (folder / name).string(); };
    ScriptText script;
    script.command("chain.motion", {{"path", "circle"}})
        .wait(1)
        .line({{"state", path("going.json")}})
        .wait(1'000'000);
    write(folder / "script.jsonl", script.text());
    Process process(
        program_command({"--headless", "--script", path("script.jsonl"), "--state", path("state.json"),
                         "--screenshot", path("picture.png"), "--record", path("record.jsonl")}));
    for (int i = 0; i < 3000 && process.running() && !std::filesystem::exists(folder / "going.json"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    process.signal(GetParam());
    EXPECT_TRUE(succeeded(process.wait()));
    const app::Json state = app::parse_json(read(folder / "state.json"));
    EXPECT_EQ(state["motion"], "circle");
    EXPECT_GE(state["time"]["tick"], 1);
    EXPECT_EQ(app::read_png(folder / "picture.png").size, glm::ivec2(1280, 720));

    // The recording up to the signal leads to the same state.
    EXPECT_TRUE(succeeded(
        run_program({"--headless", "--script", path("record.jsonl"), "--state", path("again.json")})));
    EXPECT_EQ(app::parse_json(read(folder / "again.json")), state);
}

INSTANTIATE_TEST_SUITE_P(All, Signals, testing::Values(SIGINT, SIGTERM),
                         [](const auto& number) { return number.param == SIGINT ? "SIGINT" : "SIGTERM"; });

TEST(Quit, EndsAScriptAtOnceWithEverythingWritten) {
    ScriptText script = ScriptText().command("chain.target", {{"to", {3, 2, 1}}});
    const std::string before = state_after(script)["target"].dump();
    script.command("quit").wait(1'000'000).command("chain.target", {{"to", {0, 0, 0}}});
    const Played played = play(script);
    EXPECT_EQ(played.state["target"].dump(), before);
    EXPECT_LT(played.outcome.cpu_seconds, 10.0 * sanitizer_factor);
}

}  // namespace
}  // namespace tendril::test
