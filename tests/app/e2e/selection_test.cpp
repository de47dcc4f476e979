// Selecting with the mouse: Shift, a box, and the effect of the gizmo on the selection.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

ScriptText front() {
    ScriptText script = ScriptText().command("camera.view", {{"name", "front"}});
    script.command("camera.frame", {{"what", "all"}});
    return script;
}

glm::vec2 joint(const Json& state, int index) {
    return handle(state, "segment." + std::to_string(index));
}

ScriptText& box(ScriptText& script, glm::vec2 from, glm::vec2 to, bool add = false) {
    script.move(from).hold("ctrl");
    if (add) script.hold("shift");
    script.down().move(0.5f * (from + to)).move(to).up();
    if (add) script.release("shift");
    return script.release("ctrl");
}

std::size_t grips(const Json& state) {
    std::size_t count = 0;
    for (const Json& each : state.at("handles"))
        count += each.at("name").get<std::string>().find(".move_") != std::string::npos;
    return count;
}

/// A held object has a gizmo although nothing is selected.
TEST(Gizmo, IsHiddenByEscapeUntilItsHandleIsClicked) {
    ScriptText script = ScriptText().command("lab.open", {{"name", "humanoid"}}).command("time.pause");
    script.command("humanoid.hold", {{"kind", "wheel"}}).wait(3);
    const Json shown = state_after(script);
    EXPECT_GT(grips(shown), 3u);
    EXPECT_EQ(grips(state_after(script.key("escape").wait(3))), 0u);
    EXPECT_GT(grips(state_after(script.click(handle(shown, "object")).wait(3))), 3u);
}

TEST(SelectByMouse, ShiftClickAddsAJointAndTakesItOut) {
    const Json start = state_after(front());
    ScriptText script = front();
    script.click(joint(start, 2)).hold("shift").click(joint(start, 5)).click(joint(start, 3));
    EXPECT_EQ(state_after(script)["selection"], Json({2, 3, 5}));
    script.click(joint(start, 5)).release("shift");
    EXPECT_EQ(state_after(script)["selection"], Json({2, 3}));
    script.click(joint(start, 6));
    EXPECT_EQ(state_after(script)["selection"], Json::array({6}));
}

TEST(SelectByMouse, ABoxSelectsWhatIsInItAndTurnsNothing) {
    const Json start = state_after(front());
    const glm::vec2 room(20.0f, 40.0f);
    ScriptText script = front();
    box(script, joint(start, 2) - room, joint(start, 4) + room);
    const Json one = state_after(script);
    EXPECT_EQ(one["selection"], Json({2, 3, 4}));
    EXPECT_EQ(one["camera"], start["camera"]);
    EXPECT_EQ(one["segments"], start["segments"]);
    // From right to left and from below is the same box.
    ScriptText other = front();
    box(other, joint(start, 4) + room, joint(start, 2) - room);
    EXPECT_EQ(state_after(other)["selection"], Json({2, 3, 4}));
    box(script, joint(start, 6) - room, joint(start, 6) + room, true);
    EXPECT_EQ(state_after(script)["selection"], Json({2, 3, 4, 6}));
    // An empty box clears the selection.
    box(script, joint(start, 2) - 4.0f * room, joint(start, 2) - 3.0f * room);
    EXPECT_EQ(state_after(script)["selection"], Json::array());
}

TEST(SelectByMouse, EscapeCancelsABox) {
    const Json start = state_after(front());
    ScriptText script = front();
    script.click(joint(start, 1)).move(joint(start, 2) - 30.0f).hold("ctrl").down();
    script.move(joint(start, 5) + 30.0f).key("escape").up().release("ctrl");
    EXPECT_EQ(state_after(script)["selection"], Json::array({1}));
}

TEST(SelectByMouse, EscapeSelectsNothingInEveryLab) {
    struct Case {
        const char* lab;
        const char* select;
        Json arguments;
    };
    for (const Case& each : {Case{"chain", "chain.select", {{"joints", {1, 2}}}},
                             {"chain", "chain.select", {{"point", "target"}}},
                             {"rope", "rope.select", {{"rope", "rope"}, {"particles", {1, 2}}}},
                             {"rope", "rope.select", {{"collider", "ball"}}},
                             {"signal", "signal.select", {{"at", 0}}},
                             {"rig", "rig.select", {{"elements", {"nose", "head"}}}},
                             {"rig", "rig.select", {{"unit", "aim"}}},
                             {"humanoid", "humanoid.select", {{"nodes", {"Head", "Hips"}}}}}) {
        ScriptText script = ScriptText().command("lab.open", {{"name", each.lab}}).command("time.pause");
        const auto selected = [](const Json& state) {
            return Json{state.value("selected", Json()), state.value("selection", Json())};
        };
        const Json none = selected(state_after(ScriptText(script).command("view.close")));
        script.command(each.select, each.arguments);
        const Json before = selected(state_after(script));
        EXPECT_NE(before, none) << each.lab << each.arguments;
        // Escape first closes what is over the scene.
        EXPECT_EQ(selected(state_after(ScriptText(script).key("?").key("escape"))), before) << each.lab;
        EXPECT_EQ(selected(state_after(ScriptText(script).key("?").key("escape").wait(2).key("escape"))),
                  none);
        EXPECT_EQ(selected(state_after(script.key("escape"))), none) << each.lab << each.arguments;
    }
}

TEST(SelectByMouse, EscapeInADragRestoresAndKeepsTheSelection) {
    const Json start = state_after(front());
    ScriptText script = front().click(joint(start, 3)).move(joint(start, 5)).down();
    script.move(joint(start, 5) + 40.0f).key("escape").up();
    EXPECT_EQ(state_after(script)["selection"], Json::array({3}));
    EXPECT_EQ(state_after(script.key("escape"))["selection"], Json::array());
}

TEST(SelectByMouse, ASignalLabHasNoBoxAndTurnsTheView) {
    ScriptText script = ScriptText().command("lab.open", {{"name", "signal"}});
    const Json start = state_after(script);
    const glm::vec2 free = handle(start, "output") - glm::vec2(0.0f, 150.0f);
    script.move(free).hold("ctrl").down().move(free + glm::vec2(60.0f, 30.0f)).up().release("ctrl");
    EXPECT_NE(state_after(script)["camera"], start["camera"]);
}

TEST(SelectByMouse, ABoxAroundACornerOfAClothSelectsAllParticlesThere) {
    ScriptText script = ScriptText().command("lab.open", {{"name", "rope"}}).command("time.pause");
    script.command("rope.preset", {{"name", "cloth"}}).command("camera.view", {{"name", "top"}});
    script.command("camera.frame", {{"what", "all"}});
    const Json start = state_after(script);
    const glm::vec2 corner = handle(start, start["cloths"][0]["name"].get<std::string>() + ".0");
    box(script, corner - 30.0f, corner + 30.0f);
    const Json after = state_after(script);
    ASSERT_TRUE(after["selected"].is_object()) << after["selected"].dump();
    EXPECT_GT(after["selected"]["particles"].size(), 3u);
    EXPECT_EQ(after["camera"], start["camera"]);
}

ScriptText figure() {
    ScriptText script = ScriptText().command("lab.open", {{"name", "humanoid"}}).command("time.pause");
    return script.command("camera.view", {{"name", "front"}}).command("camera.frame", {{"what", "all"}});
}

TEST(SelectByMouse, ShiftClickAddsABoneOfTheFigureAndTakesItOut) {
    const Json start = state_after(figure());
    ScriptText script = figure();
    script.click(handle(start, "node.LeftLowerArm")).hold("shift");
    script.click(handle(start, "node.RightLowerArm")).click(handle(start, "left_hand"));
    Json state = state_after(script);
    EXPECT_EQ(state["selection"].size(), 3u);
    EXPECT_EQ(state["selected"], "LeftHand") << "its ball stands for the hand";
    // In empty space, Shift keeps the selection.
    script.click(handle(start, "node.LeftLowerArm")).click({320, 120}).release("shift");
    state = state_after(script);
    EXPECT_EQ(state["selection"].size(), 2u);
    EXPECT_EQ(state_after(script.click({320, 120}))["selection"], Json::array());
    script.click(handle(start, "node.Spine"));
    EXPECT_EQ(state_after(script)["selection"], Json::array({"Spine"}));
}

TEST(SelectByMouse, ABoxSelectsTheVisibleNodesOfTheFigure) {
    const Json start = state_after(figure());
    const glm::vec2 hand = handle(start, "node.LeftHand"), margin(25.0f, 25.0f);
    const glm::vec2 end = handle(start, "node.LeftHand_End");
    ScriptText script = figure();
    box(script, glm::min(hand, end) - margin, glm::max(hand, end) + margin);
    const Json state = state_after(script);
    EXPECT_EQ(state["selection"], Json({"LeftHand", "LeftHand_End"}));
    EXPECT_EQ(state["camera"], start["camera"]);
    EXPECT_TRUE(state["body"]["targets"].empty());
    const glm::vec2 foot = handle(start, "node.RightLowerLeg");
    EXPECT_EQ(state_after(box(script, foot - margin, foot + margin, true))["selection"].size(), 3u);
    // An empty box clears the selection.
    box(script, {320, 120}, {340, 140});
    EXPECT_EQ(state_after(script)["selection"], Json::array());
}

TEST(SelectByMouse, ABoxOmitsHiddenHelperNodes) {
    ScriptText script = figure();
    script.command("humanoid.load", {{"path", source_path("tests/app/golden/antennae.bvh")}})
        .command("humanoid.clip", {{"name", ""}})
        .command("camera.frame", {{"what", "all"}})
        .wait(2);
    const glm::vec2 tip = handle(state_after(script), "node.antenna_l_5"), margin(25.0f, 25.0f);
    ScriptText hidden = script;
    hidden.command("view.character_helpers", {{"nodes", "hidden"}}).wait(2);
    ScriptText swinging = hidden;
    swinging.command("humanoid.spring", {{"node", "antenna_l_1"}}).wait(2);
    for (const auto& [text, seen] : {std::pair(&script, true), {&hidden, false}, {&swinging, true}}) {
        const Json selection = state_after(box(*text, tip - margin, tip + margin))["selection"];
        EXPECT_EQ(!selection.empty(), seen) << selection;
    }
}

TEST(ChainGizmo, AnArrowOfTheTargetMovesItAlongThatAxisAlone) {
    ScriptText script = ScriptText().command("chain.mode", {{"mode", "reach"}});
    script.command("chain.target", {{"to", {4, 2, 1}}});
    script.click(handle(state_after(script), "target"));
    const Json before = state_after(script);
    EXPECT_EQ(before["selected"], "target");
    for (const auto& [name, axis] : {std::pair("target.move_x", 0), std::pair("target.move_y", 1)}) {
        const glm::vec2 grip = handle(before, name);
        ScriptText dragged = script;
        dragged.drag({grip, grip + glm::vec2(12, -12), grip + glm::vec2(24, -30)});
        const glm::vec3 from = point_of(before["target"]), to = point_of(state_after(dragged)["target"]);
        for (int i = 0; i < 3; ++i) {
            if (i == axis) {
                EXPECT_GT(glm::abs(to[i] - from[i]), 0.05f) << name;
            } else {
                EXPECT_NEAR(to[i], from[i], 1e-4f) << name;
            }
        }
    }
}

TEST(ChainGizmo, AnArrowOfAJointPullsThatJoint) {
    ScriptText script = ScriptText().click(joint(state_after(ScriptText()), 4));
    const Json before = state_after(script);
    const glm::vec2 grip = handle(before, "segment.4.move_y");
    const Json after = state_after(script.drag({grip, grip - glm::vec2(0, 20), grip - glm::vec2(0, 60)}));
    const glm::vec3 from = point_of(before["segments"][4]["position"]),
                    to = point_of(after["segments"][4]["position"]);
    EXPECT_GT(to.y, from.y + 0.1f);
    EXPECT_NEAR(to.x, from.x, 1e-3f);
    EXPECT_NEAR(to.z, from.z, 1e-3f);
    EXPECT_EQ(after["selected"], 4);
}

TEST(ChainGizmo, AnArrowOfSeveralJointsMovesAllOfThemInOneStep) {
    for (const char* const mode : {"reach", "backward"}) {
        ScriptText script;
        script.command("chain.mode", {{"mode", mode}}).command("chain.target", {{"to", {4, 2, 1}}});
        script.command("chain.select", {{"joints", {0, 2, 4}}}).wait(2);
        const Json before = state_after(script);
        const glm::vec2 grip = handle(before, "segment.4.move_y");
        script.drag({grip, grip - glm::vec2(0, 5), grip - glm::vec2(0, 18)}).wait(2);
        const Json after = state_after(script);
        const auto moved = [&](std::size_t i) {
            return point_of(after["segments"][i]["position"]) - point_of(before["segments"][i]["position"]);
        };
        EXPECT_GT(moved(2).y, 0.1f) << mode;
        for (const std::size_t i : {0u, 1u, 3u, 4u})
            EXPECT_LT(glm::distance(moved(i), moved(2)), 2e-3f) << mode << i;
        EXPECT_NEAR(moved(2).x, 0.0f, 2e-3f) << mode;
        EXPECT_EQ(after["selection"], before["selection"]);
        EXPECT_EQ(state_after(script.key("ctrl+z"))["segments"], before["segments"]) << mode;
    }
}

}  // namespace
}  // namespace tendril::test
