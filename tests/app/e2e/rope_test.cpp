// The Rope lab in the running program: dragging, replaying, and seeking in the past.

#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

ScriptText rope_lab(const char* scene = "drape") {
    return ScriptText().command("lab.open", {{"name", "rope"}}).command("rope.preset", {{"name", scene}});
}

const Json& collider(const Json& state, const std::string& name) {
    for (const Json& each : state.at("colliders"))
        if (each.at("name") == name) return each;
    throw std::runtime_error("there is no collider " + name);
}

/// A drag in steps of a few pixels, like a hand's, held at the end.
ScriptText& slowly(ScriptText& script, glm::vec2 from, glm::vec2 to, int steps = 40) {
    script.move(from).down();
    for (int i = 1; i <= steps; ++i)
        script.move(glm::mix(from, to, static_cast<float>(i) / static_cast<float>(steps)));
    return script;
}

TEST(RopeInTheWindow, AThirdQuickClickIsASingleClickAgain) {
    ScriptText script = rope_lab().command("time.pause").wait(2);
    const glm::vec2 at = handle(state_after(script), "rope.8");
    const auto selected = [&] { return state_after(script.click(at))["selected"]["particles"].size(); };
    EXPECT_EQ(selected(), 1u);
    EXPECT_GT(selected(), 1u) << "all of the rope";
    EXPECT_EQ(selected(), 1u);
}

TEST(RopeInTheWindow, ABallDraggedThroughARopeCarriesIt) {
    const ScriptText before = rope_lab().wait(90);
    const Json start = state_after(before);
    const glm::vec2 at = handle(start, "collider.ball");
    ScriptText script = before;
    slowly(script, at, at - glm::vec2(0, 120)).up().wait(5);
    const Json state = state_after(script);
    const double lifted = collider(state, "ball")["centre"][1].get<double>() -
                          collider(start, "ball")["centre"][1].get<double>();
    EXPECT_GT(lifted, 0.4);
    const auto top = [](const Json& s) {
        double highest = -9.0;
        for (const Json& particle : s["ropes"][0]["particles"])
            if (std::abs(particle["position"][0].get<double>() + 0.65) < 0.2)
                highest = std::max(highest, particle["position"][1].get<double>());
        return highest;
    };
    EXPECT_NEAR(top(state) - top(start), lifted, 0.1) << "the rope that lay on it went up with it";
    EXPECT_EQ(state["substeps_dropped"], 0);

    // The whole drag is one undo step.
    const Json back = state_after(script.command("undo"));
    EXPECT_NEAR(collider(back, "ball")["centre"][1].get<double>(), 0.95, 1e-6);
}

TEST(RopeInTheWindow, ADraggedParticleIsHeldUntilDropped) {
    const ScriptText before = rope_lab().wait(90);
    const glm::vec2 at = handle(state_after(before), "rope.60");
    ScriptText held = before;
    slowly(held, at, at - glm::vec2(0, 80), 20).wait(20);
    const Json pulled = state_after(held);
    EXPECT_EQ(pulled["held"]["rope"], "rope");
    EXPECT_EQ(state_after(ScriptText(held).up())["held"], nullptr);
    EXPECT_EQ(state_after(ScriptText(held).key("escape"))["held"], nullptr);
    EXPECT_EQ(state_after(ScriptText(held).line({{"focus", false}}))["held"], nullptr);
    const Json undone = state_after(ScriptText(held).up().command("time.pause").command("undo"));
    const double high = undone["ropes"][0]["particles"][60]["position"][1];
    const double was = state_after(before)["ropes"][0]["particles"][60]["position"][1];
    EXPECT_NEAR(high, was, 0.02) << "the whole drag is one step";
}

TEST(RopeInTheWindow, TimeGoesBackAndContinuesFromThere) {
    ScriptText script = rope_lab("cloth").wait(100);
    const Json then = state_after(script);
    script.wait(50).command("time.seek", {{"ticks_back", 50}});
    Json back = state_after(script);
    EXPECT_EQ(back["time"]["playing"], false);
    EXPECT_EQ(back["time"]["ticks_back"], 50);
    EXPECT_EQ(back["time"]["remembered"], 151) << "the ticks, and the preset";
    EXPECT_EQ(back["cloths"], then["cloths"]);
    EXPECT_EQ(back["seconds"], then["seconds"]);

    // The tool stays, and continuing gives the same result, since nothing was changed.
    const Json again = state_after(ScriptText(script)
                                       .command("rope.tool", {{"name", "cut"}})
                                       .command("time.seek", {{"ticks_back", 100}})
                                       .command("time.play")
                                       .wait(50));
    EXPECT_EQ(again["tool"], "cut");
    EXPECT_EQ(again["cloths"], then["cloths"]);
    EXPECT_EQ(again["time"]["ticks_back"], 0);
    EXPECT_EQ(play(ScriptText().command("time.seek", {{"ticks_back", 1}}, true)).outcome.exit_code, 0);
}

TEST(RopeInTheWindow, UndoRestoresObjectsAddedAfterTheSoughtMoment) {
    ScriptText script = rope_lab("cloth").wait(30);
    script.command("rope.add", {{"name", "new"}, {"from", {0, 2, 0}}, {"to", {1, 2, 0}}}).wait(30);
    script.command("time.seek", {{"ticks_back", 50}});
    EXPECT_EQ(state_after(script)["ropes"].size(), 0u);
    script.command("time.play").wait(5).command("undo");
    EXPECT_EQ(state_after(script)["ropes"][0]["name"], "new");
}

TEST(RopeInTheWindow, UndoOpensLabAndViewAndKeepsOtherLabs) {
    // Undoing a change of the chain from the Rope lab opens the Chain lab, and the ropes run on.
    ScriptText script = ScriptText().command("chain.target", {{"to", {5, 2, 0}}});
    script.command("lab.open", {{"name", "rope"}}).wait(60).command("undo");
    EXPECT_EQ(state_after(script)["lab"], "chain");
    script.command("lab.open", {{"name", "rope"}});
    EXPECT_NEAR(state_after(script)["seconds"].get<double>(), 1.0, 0.02);

    const Json drape = state_after(rope_lab());
    const ScriptText hair = rope_lab().command("rope.preset", {{"name", "hair"}}).wait(5);
    EXPECT_NE(state_after(hair)["camera"], drape["camera"]);
    EXPECT_EQ(state_after(ScriptText(hair).command("undo"))["camera"], drape["camera"]);
    EXPECT_EQ(state_after(ScriptText(hair).command("undo").command("redo"))["camera"],
              state_after(hair)["camera"]);
    ScriptText from_chain = ScriptText(hair).command("lab.open", {{"name", "chain"}}).command("undo");
    EXPECT_EQ(state_after(from_chain)["camera"], drape["camera"]);
    from_chain.command("lab.open", {{"name", "chain"}}).command("redo");
    EXPECT_EQ(state_after(from_chain)["camera"], state_after(hair)["camera"]) << "and not the chain's";
}

TEST(RopeInTheWindow, EachLabHasItsOwnCamera) {
    const Json chain = state_after(ScriptText().wait(1))["camera"];
    const Json rope = state_after(rope_lab())["camera"];
    EXPECT_NE(rope, chain);
    EXPECT_EQ(play(ScriptText().wait(1), {.more = {"--lab", "rope"}}).state["camera"], rope);
    const ScriptText turned = ScriptText()
                                  .command("lab.open", {{"name", "rope"}})
                                  .command("camera.set", {{"yaw_deg", 77}})
                                  .command("lab.open", {{"name", "chain"}});
    EXPECT_EQ(state_after(turned)["camera"], chain);
    EXPECT_EQ(state_after(ScriptText(turned).command("lab.open", {{"name", "rope"}}))["camera"]["yaw_deg"],
              77.0);
}

}  // namespace
}  // namespace tendril::test
