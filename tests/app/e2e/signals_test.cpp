// Termination by signals: a clean end with everything written.
#include <signal.h>

#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

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
