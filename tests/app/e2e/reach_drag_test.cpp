// Dragging a joint in mode Reach: the joint is an effector, while root and target stay.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

glm::vec3 joint(const Json& state, std::size_t index) {
    return point_of(state.at("segments").at(index).at("position"));
}

/// Seven bones of 1 m whose target is well within reach.
ScriptText reaching() {
    return ScriptText()
        .command("chain.mode", {{"mode", "reach"}})
        .command("chain.target", {{"to", {3, 3, 1}}});
}

/// Drags through several points of the view with the button down.
ScriptText& drag_joint(ScriptText& script, glm::vec2 from, glm::vec2 by) {
    script.move(from).down();
    for (int i = 1; i <= 12; ++i) script.move(from + by * (static_cast<float>(i) / 12.0f));
    return script.up();
}

void expect_bones_kept(const Json& state) {
    for (std::size_t i = 1; i < state.at("segments").size(); ++i) {
        const float length = state["segments"][i]["length"].get<float>();
        EXPECT_NEAR(glm::distance(joint(state, i), joint(state, i - 1)), length, 1e-4f) << i;
    }
}

TEST(ReachDrag, AJointFollowsTheMouseWhileRootTargetAndTipStay) {
    const Json before = state_after(reaching());
    for (const std::size_t index : {2u, 3u, 5u}) {
        // With only two bones left to the tip, the tip soon cannot stay.
        const glm::vec2 by = index == 5 ? glm::vec2(-6, 8) : glm::vec2(-35, 40);
        const glm::vec2 at = handle(before, "segment." + std::to_string(index));
        ScriptText script = reaching();
        const Json after = state_after(drag_joint(script, at, by));
        EXPECT_EQ(after["head"], before["head"]) << index;
        EXPECT_EQ(after["target"], before["target"]) << index;
        EXPECT_EQ(after["mode"], "reach");
        EXPECT_LT(glm::distance(handle(after, "segment." + std::to_string(index)), at + by), 0.5f) << index;
        // The tip stays on the target, or as near as the bones beyond the dragged joint allow.
        const float left = 7.0f - static_cast<float>(index);
        const float missing =
            std::max(0.0f, glm::distance(joint(after, index), point_of(after["target"])) - left);
        EXPECT_LT(glm::distance(point_of(after["tail"]), point_of(after["target"])), missing + 7.1e-3f)
            << index;
        if (index < 5) {
            EXPECT_EQ(missing, 0.0f) << index;
        }
        expect_bones_kept(after);
        EXPECT_EQ(state_after(script.key("ctrl+z"))["segments"], before["segments"]) << "one step to undo";
        script.key("ctrl+y").command("undo").command("undo").command("undo").command("undo", {}, true);
        EXPECT_EQ(state_after(script)["mode"], "backward") << "the drag was one step";
    }
}

TEST(ReachDrag, TheRootTakesTheChainAlongAndItReachesAgain) {
    const Json before = state_after(reaching());
    const glm::vec2 at = handle(before, "segment.0"), by(30, -50);
    ScriptText script = reaching();
    const Json after = state_after(drag_joint(script, at, by));
    EXPECT_LT(glm::distance(handle(after, "segment.0"), at + by), 0.02f);
    EXPECT_EQ(after["target"], before["target"]);
    EXPECT_LT(glm::distance(point_of(after["tail"]), point_of(after["target"])), 7e-3f);
    expect_bones_kept(after);
}

TEST(ReachDrag, TheTipLeavesTheTargetWhereItIs) {
    ScriptText script;
    script.command("chain.mode", {{"mode", "reach"}}).command("chain.target", {{"to", {3, 9, 0}}});
    script.key("home");
    const Json before = state_after(script);
    const glm::vec2 at = handle(before, "segment.7"), by(90, 120);
    const Json after = state_after(drag_joint(script, at, by));
    EXPECT_EQ(after["head"], before["head"]);
    EXPECT_EQ(after["target"], before["target"]);
    EXPECT_LT(glm::distance(handle(after, "segment.7"), at + by), 0.5f);
    expect_bones_kept(after);
}

TEST(DeleteInMidDrag, DoesNothingInTheChainLab) {
    for (const char* mode : {"backward", "reach"}) {
        ScriptText script;
        script.command("chain.mode", {{"mode", mode}}).command("chain.target", {{"to", {3, 3, 1}}});
        script.command("chain.select", {{"index", 3}});
        const glm::vec2 at = handle(state_after(script), "segment.3");
        ScriptText with = script, without = script;
        with.move(at).down().move(at + glm::vec2(0, 40)).key("delete").move(at + glm::vec2(0, 60)).up();
        without.move(at).down().move(at + glm::vec2(0, 40)).wait(1).move(at + glm::vec2(0, 60)).up();
        EXPECT_EQ(state_after(with)["segments"], state_after(without)["segments"]) << mode;
        EXPECT_EQ(state_after(with.key("delete"))["segments"].size(), 7u) << "let go, it deletes again";
    }
}

TEST(DeleteInMidDrag, DoesNothingInTheRopeLab) {
    ScriptText script;
    script.command("lab.open", {{"name", "rope"}}).command("rope.preset", {{"name", "drape"}});
    script.command("rope.select", {{"collider", "ball"}}).command("time.pause");
    const glm::vec2 at = handle(state_after(script), "collider.ball");
    script.move(at).down().move(at + glm::vec2(0, -30)).key("delete").move(at + glm::vec2(0, -40)).up();
    const Json after = state_after(script);
    const auto has_ball = [](const Json& state) {
        for (const Json& collider : state.at("colliders"))
            if (collider.at("name") == "ball") return true;
        return false;
    };
    EXPECT_TRUE(has_ball(after));
    EXPECT_FALSE(has_ball(state_after(script.key("delete"))));
}

}  // namespace
}  // namespace tendril::test
