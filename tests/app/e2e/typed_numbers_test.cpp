// Numbers that are typed into a panel: what is out of range is refused with its value and the range.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

/// Double-clicks every row of the Chain lab's solver options, from iterations to soft zone, and types.
ScriptText typed_into_every_row(const char* text) {
    ScriptText script;
    script.command("chain.mode", {{"mode", "reach"}});
    for (float y = 419.0f; y < 562.0f; y += 8.0f)
        script.click({173.0f, y}).click({173.0f, y}).text(text).key("enter").wait(30);
    return script;
}

/// Plays it; refusals of what is typed into a panel end no script.
Played played_with_refusals(const ScriptText& script) {
    const TempFolder folder;
    write(folder / "script.jsonl", script.text());
    const std::string state = (folder / "state.json").string();
    Played played;
    played.outcome =
        run_program({"--headless", "--script", (folder / "script.jsonl").string(), "--state", state});
    EXPECT_EQ(played.outcome.exit_code, 0) << played.outcome.err;
    played.state = app::parse_json(read(state));
    return played;
}

TEST(TypedNumbers, OutOfRangeAreRefusedWithValueAndRange) {
    const Played played = played_with_refusals(typed_into_every_row("99999"));
    for (const char* reason : {"chain.solver: iterations must be 1 to 10000, got 99999",
                               "chain.solver: snap_back must be 0.0 to 1.0, got 99999.0",
                               "chain.solver: soft_zone must be 0.0 to 1.0, got 99999.0"})
        EXPECT_TRUE(has(played.outcome.err, reason));
    const app::Json& solve = played.state.at("solve");
    EXPECT_EQ(solve.at("iterations"), 100);
    EXPECT_EQ(solve.at("snap_back"), 0.0);
    EXPECT_EQ(solve.at("soft_zone"), 0.0);
}

TEST(TypedNumbers, InRangeAreTaken) {
    const Played played = play(typed_into_every_row("1"));
    EXPECT_EQ(played.outcome.err, "");
    const app::Json& solve = played.state.at("solve");
    EXPECT_EQ(solve.at("iterations"), 1);
    EXPECT_EQ(solve.at("snap_back"), 1.0);
    EXPECT_EQ(solve.at("soft_zone"), 1.0);
}

/// 2^32 + 7 is 7 where a parser keeps the last 32 bits.
TEST(TypedNumbers, WholeOnesThatNoIntHoldsAreRefused) {
    for (const char* text : {"4294967303", "-4294967289", "99999999999999999999"}) {
        const Played played = played_with_refusals(typed_into_every_row(text));
        EXPECT_TRUE(has(played.outcome.err, "chain.solver: iterations must be 1 to 10000, got")) << text;
    }
}

TEST(TypedNumbers, EndlessOnesToo) {
    for (const char* text : {"1e30", "-1e30", "1e999"}) {
        const Played played = played_with_refusals(typed_into_every_row(text));
        EXPECT_TRUE(has(played.outcome.err, "tolerance must be")) << text;
        EXPECT_EQ(played.state.at("solve").at("snap_back"), 0.0) << text;
    }
}

}  // namespace
}  // namespace tendril::test
