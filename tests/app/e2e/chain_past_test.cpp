// The Chain lab's last ten seconds in the running program: drags, flips, and returning to them.
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/app/support/panel_places.hpp"
#include "tests/app/support/play.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using app::Json;

/// Plays in a window, where a refusal does not end the script.
Json play_refused(const ScriptText& script) {
    const TempFolder folder;
    write(folder / "script.jsonl", script.text());
    const std::string state = (folder / "state.json").string();
    const Outcome outcome =
        run_program({"--headless", "--script", (folder / "script.jsonl").string(), "--state", state});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return app::parse_json(read(state));
}

/// Two bones in mode Reach whose target then passes through the root, a hundredth of the reach per tick.
ScriptText through_the_root() {
    ScriptText script;
    script.command("chain.preset", {{"name", "start"}, {"count", 3}})
        .command("chain.mode", {{"mode", "reach"}})
        .command("chain.target", {{"to", {0.4, 0.004, 0}}})
        .wait(1);
    for (int i = 0; i < 40; ++i)
        script.command("chain.target", {{"to", {0.4 - 0.02 * (i + 1), 0.004, 0}}}).wait(1);
    return script;
}

constexpr const char* straight = "the chain was straight (collinear)";

/// All flips but the first, in which the straight chain bends.
std::vector<Json> flips_of(const Json& state) {
    std::vector<Json> flips;
    for (const Json& event : state.at("events"))
        if (event.at("kind") == "flip" && event.at("cause") != straight) flips.push_back(event);
    return flips;
}

/// The index of the last moment.
int newest_of(ScriptText script) {
    const Json time = state_after(script.command("time.seek", {{"ticks_back", 1}}))["time"];
    return time["moment"].get<int>() + 1;
}

TEST(ChainsPast, AFlipIsMarkedAtItsTickWithItsCause) {
    const Json state = state_after(through_the_root());
    const std::vector<Json> flips = flips_of(state);
    ASSERT_GE(flips.size(), 1u) << state["events"].dump(2);
    for (const Json& flip : flips) EXPECT_TRUE(test::says(flip["cause"], "target root"));
    EXPECT_EQ(state["events"][0]["cause"], straight);
    EXPECT_GT(flips[0]["degrees"].get<double>(), 30.0);
    // The poses before and after it differ that much.
    const auto tick = flips[0]["tick"].get<int>(), now = newest_of(through_the_root());
    const auto pose_at = [&](int at) {
        return state_after(through_the_root().command("time.seek", {{"ticks_back", now - at}}));
    };
    EXPECT_EQ(flips[0]["joint"], 1) << "the elbow";
    const auto bone = [&](const Json& at, std::size_t to) {
        return glm::normalize(point_of(at["segments"][to]["position"]) -
                              point_of(at["segments"][to - 1]["position"]));
    };
    const Json before = pose_at(tick), after = pose_at(tick + 1);
    float turned = 0.0f;
    for (const std::size_t to : {1u, 2u})
        turned = std::max(turned, glm::degrees(std::acos(glm::dot(bone(before, to), bone(after, to)))));
    EXPECT_NEAR(turned, flips[0]["degrees"].get<float>(), 0.1f);
}

TEST(ChainsPast, ADragIsRememberedTickByTickAndTakenBackBySeeking) {
    const ScriptText reach = ScriptText().command("chain.mode", {{"mode", "reach"}});
    const glm::vec2 at = handle(state_after(reach), "target");
    ScriptText script = reach;
    script.move(at).down();
    for (int i = 1; i <= 20; ++i) script.move(at - glm::vec2(6.0f * static_cast<float>(i), 0.0f));
    ScriptText half = script;
    script.up();
    const Json end = state_after(script);
    EXPECT_EQ(newest_of(script), 21) << "one for the mode, and one for each move of the mouse";
    script.command("time.seek", {{"ticks_back", 20}});
    const Json begin = state_after(script);
    EXPECT_EQ(begin["segments"], state_after(reach)["segments"]);
    EXPECT_EQ(begin["target"], state_after(reach)["target"]);
    // Undo works, and a replay shows it again up to its end, at any speed.
    EXPECT_EQ(state_after(ScriptText(script).command("undo"))["segments"], end["segments"]);
    ScriptText again = script;
    again.command("time.speed", {{"factor", 0.5}}).command("time.replay").wait(20);
    EXPECT_EQ(state_after(again)["time"]["ticks_back"], 10);
    const Json whole = state_after(again.wait(20));
    EXPECT_FALSE(whole["time"].contains("ticks_back")) << "it has come to its end";
    EXPECT_EQ(whole["segments"], end["segments"]);
    EXPECT_EQ(whole["target"], end["target"]);
}

TEST(ChainsPast, AnIncidentIsGoneToByItsNumber) {
    const Json state = state_after(through_the_root());
    int number = 0;
    while (state["events"].at(static_cast<std::size_t>(number)) != flips_of(state).front()) ++number;
    const ScriptText script = through_the_root().command("time.incident", {{"number", number}});
    const Json there = state_after(script);
    const int newest = newest_of(through_the_root());
    EXPECT_EQ(there["time"]["ticks_back"],
              newest - state["events"][static_cast<std::size_t>(number)]["tick"].get<int>() - 1);
    EXPECT_EQ(there["events"], state["events"]) << "looking back forgets nothing";
    // A change there replaces what came after it.
    const Json other = state_after(ScriptText(script).command("chain.target", {{"to", {1, 1, 0}}}).wait(1));
    EXPECT_EQ(flips_of(other).size(), 1u) << "those that came after it are forgotten";
    ASSERT_GT(flips_of(state).size(), 1u);
    const ScriptText before = through_the_root().command("time.seek", {{"ticks_back", 30}});
    EXPECT_EQ(
        flips_of(state_after(ScriptText(before).command("chain.target", {{"to", {1, 1, 0}}}).wait(1))).size(),
        0u)
        << "it never came to the flip";
    EXPECT_EQ(play(ScriptText().command("time.incident", {{"number", 0}}, true)).outcome.exit_code, 0);
}

TEST(ChainsPast, ARefusedNumberIsAMarkAndNoFlip) {
    // Typed into the panel; a refused script command leaves no event.
    const ScriptText reach = ScriptText()
                                 .command("chain.mode", {{"mode", "reach"}})
                                 .command("view.fold", chain_panel::unfolded())
                                 .wait(3);
    const Json typed =
        play_refused(ScriptText(reach).click(chain_panel::iterations).wait(2).text("0").key("enter").wait(2));
    ASSERT_EQ(typed["events"].size(), 1u);
    EXPECT_EQ(typed["events"][0]["kind"], "status");
    EXPECT_TRUE(test::says(typed["events"][0]["cause"].get<std::string>(), "iterations 1"))
        << typed["events"][0]["cause"];
    const Json told =
        state_after(ScriptText(reach).command("chain.target", {{"to", {1e30, 0, 0}}}, true).wait(1));
    EXPECT_TRUE(told["events"].empty());
}

TEST(ChainsPast, AnAnalysisBeginsWhereTheLastDragBegan) {
    const ScriptText reach = ScriptText().command("chain.mode", {{"mode", "reach"}});
    const Json start = state_after(reach);
    const glm::vec2 at = handle(start, "target");
    ScriptText script = reach;
    script.move(at).down();
    for (int i = 1; i <= 12; ++i) script.move(at + glm::vec2(-25.0f * static_cast<float>(i), -8.0f));
    script.up().command("microscope.open").command("microscope.seek", {{"step", 0}});
    const Json positions = state_after(script)["microscope"]["positions"];
    ASSERT_EQ(positions.size(), start["segments"].size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        EXPECT_EQ(positions[i], start["segments"][i]["position"]) << i;
}

TEST(ChainsPast, AReplayEndsWithThePastItShows) {
    // Another lab, another scene, or undo ends it while it runs.
    for (const char* other : {"lab.open", "scene.new", "undo"}) {
        ScriptText script = through_the_root().command("time.replay").wait(2);
        const Json arguments = std::string(other) == "lab.open" ? Json{{"name", "rope"}} : Json::object();
        EXPECT_EQ(play(script.command(other, arguments).wait(30)).outcome.exit_code, 0) << other;
    }
}

TEST(ChainsPast, AReplayGoesOnWhereOnlySomeMomentsAreKept) {
    // Of a chain this large, every fourth moment is kept.
    ScriptText script = ScriptText().command("chain.preset", {{"name", "start"}, {"count", 100000}});
    for (int i = 1; i <= 90; ++i) script.command("chain.target", {{"to", {100, i, 0}}});
    const Json shown = state_after(script.command("time.replay").wait(100));
    EXPECT_FALSE(shown["time"].contains("ticks_back")) << shown["time"];
    EXPECT_EQ(shown["target"], Json::array({100.0, 90.0, 0.0}));
}

TEST(ChainsPast, WhatWasUndoneIsStillRemembered) {
    const ScriptText script = ScriptText()
                                  .command("chain.target", {{"to", {5, 1, 0}}})
                                  .command("chain.target", {{"to", {4, 2, 0}}})
                                  .command("undo")
                                  .command("time.seek", {{"ticks_back", 1}});
    EXPECT_EQ(state_after(script)["target"], Json::array({4.0, 2.0, 0.0}));
}

TEST(ChainsPast, LookingIsNothingToUndo) {
    ScriptText script = ScriptText();
    for (int i = 1; i <= 5; ++i) script.command("chain.target", {{"to", {7 - i, i, 0}}}).wait(1);
    const Json end = state_after(script);
    const Json back = state_after(ScriptText(script).command("time.replay").wait(30).command("undo"));
    EXPECT_EQ(back["target"], Json::array({3.0, 4.0, 0.0})) << "the last change, and not the way back";
    EXPECT_EQ(end["target"], Json::array({2.0, 5.0, 0.0}));
}

TEST(ChainsPast, AnotherSceneHasAPastOfItsOwn) {
    const ScriptText script = through_the_root().command("scene.new").wait(3);
    const Json state = state_after(script);
    EXPECT_TRUE(state["events"].empty());
    EXPECT_EQ(play(ScriptText(script).command("time.seek", {{"ticks_back", 1}}, true)).outcome.exit_code, 0);
}

}  // namespace
}  // namespace tendril::test
