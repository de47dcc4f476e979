// The mouse in the 3D view, in pixels, with the built program.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;
const glm::vec2 elsewhere(640, 600);  ///< in the view, with nothing under it

glm::vec2 target_pixel() {
    return handle(first_state(), "target");
}
glm::vec3 target_of(const Json& state) {
    return point_of(state.at("target"));
}

/// A drag must not change lengths, whatever else moves.
void expect_lengths_kept(const Json& state) {
    const Json& segments = state.at("segments");
    for (std::size_t i = 1; i < segments.size(); ++i) {
        const float length =
            glm::distance(point_of(segments[i]["position"]), point_of(segments[i - 1]["position"]));
        EXPECT_NEAR(length, segments[i]["length"].get<float>(), 1e-4f) << i;
    }
}

TEST(Drag, TheTargetFollowsTheMouseAndKeepsTheOffset) {
    for (const glm::vec2 offset : {glm::vec2(0, 0), glm::vec2(6, -4), glm::vec2(-5, 5)}) {
        const glm::vec2 caught = target_pixel() + offset;
        const glm::vec2 to(560.5f, 213.25f);
        const Json state = state_after(ScriptText().drag({caught, caught + glm::vec2(-20, -30), to}));
        EXPECT_LT(glm::distance(handle(state, "target"), to - offset), 0.02f) << offset.x << ", " << offset.y;
        EXPECT_EQ(state["tail"], state["target"]);
        EXPECT_TRUE(state["selected"].is_null()) << "the target wins over the tail that it is on";
        expect_lengths_kept(state);
    }
}

TEST(Drag, MovesInThePlaneOfTheView) {
    ScriptText script = ScriptText().command("camera.set", {{"yaw_deg", 0}, {"pitch_deg", 0}});
    const glm::vec2 caught = handle(state_after(script), "target");
    const Json state = state_after(script.drag({caught, {600, 250}, {500, 200}}));
    EXPECT_NEAR(target_of(state).z, 0.0f, 1e-5f);
    EXPECT_GT(target_of(state).y, 1.0f);
}

TEST(Drag, AnAxisKeyKeepsTheOtherCoordinates) {
    const char* keys[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        ScriptText script = ScriptText().command("chain.target", {{"to", {4.0, 1.5, 0.5}}});
        const Json before = state_after(script);
        const glm::vec2 caught = handle(before, "target");
        script.move(caught)
            .down()
            .hold(keys[axis])
            .move(caught + glm::vec2(40, 35))
            .move(caught + glm::vec2(60, -70));
        const Json state = state_after(script.up().release(keys[axis]));
        const glm::vec3 by = target_of(state) - target_of(before);
        EXPECT_GT(std::abs(by[axis]), 0.1f) << keys[axis];
        EXPECT_EQ(by[(axis + 1) % 3], 0.0f) << keys[axis];
        EXPECT_EQ(by[(axis + 2) % 3], 0.0f) << keys[axis];
    }
}

TEST(Drag, AnAxisKeyMayBePressedAndReleasedDuringADrag) {
    const glm::vec2 caught = target_pixel(), to = caught + glm::vec2(-90, -120);
    ScriptText script = ScriptText().move(caught).down().move(to).hold("y");
    const Json bound = state_after(script);
    EXPECT_EQ(target_of(bound).x, 7.0f);
    EXPECT_EQ(target_of(bound).z, 0.0f);
    const Json free = state_after(script.release("y").up());
    EXPECT_LT(glm::distance(handle(free, "target"), to), 0.02f);
}

TEST(Drag, ShiftKeepsTheHeight) {
    ScriptText script = ScriptText().command("chain.target", {{"to", {4.0, 1.5, 0.5}}});
    const glm::vec2 caught = handle(state_after(script), "target");
    script.hold("shift")
        .drag({caught, caught + glm::vec2(30, 20), caught + glm::vec2(-80, 60)})
        .release("shift");
    const Json state = state_after(script);
    EXPECT_EQ(target_of(state).y, 1.5f);
    EXPECT_LT(glm::distance(handle(state, "target"), caught + glm::vec2(-80, 60)), 0.05f);
}

TEST(Drag, ASegmentTakesTheTargetAlongAndKeepsTheMode) {
    for (const char* mode : {"forward", "backward", "fixed", "with_index"}) {
        ScriptText script = ScriptText().command("chain.mode", {{"mode", mode}, {"index", 1}});
        const glm::vec2 caught = handle(first_state(), "segment.3"), to = caught + glm::vec2(-30, -140);
        const Json state = state_after(script.drag({caught, caught + glm::vec2(-10, -60), to}));
        EXPECT_LT(glm::distance(handle(state, "segment.3"), to), 0.02f) << mode;
        EXPECT_EQ(state["segments"][3]["position"], state["target"]) << mode;
        EXPECT_EQ(state["mode"], mode);
        EXPECT_EQ(state["index"], 1) << mode;
        expect_lengths_kept(state);
    }
}

TEST(Drag, BeginsOnlyBeyondAFewPixels) {
    const glm::vec2 caught = handle(first_state(), "segment.3");
    const Json trembled =
        state_after(ScriptText().drag({caught, caught + glm::vec2(2, 1), caught + glm::vec2(-1, 2)}));
    EXPECT_EQ(trembled["segments"], first_state()["segments"]);
    EXPECT_EQ(trembled["selected"], 3);
    const Json moved = state_after(ScriptText().drag({caught, caught + glm::vec2(0, 6)}));
    EXPECT_NE(moved["segments"], first_state()["segments"]);
}

TEST(Click, SetsTheIndexInTheModeThatHasOne) {
    ScriptText script;
    script.command("chain.mode", {{"mode", "with_index"}, {"index", 1}})
        .click(handle(first_state(), "segment.5"));
    const Json state = state_after(script);
    EXPECT_EQ(state["index"], 5);
    EXPECT_EQ(state["mode"], "with_index");
}

TEST(Undo, TakesBackAWholeDragAtOnce) {
    ScriptText script;
    std::vector<glm::vec2> path{target_pixel()};
    for (int i = 1; i < 30; ++i) path.push_back(path.front() + glm::vec2(-6 * i, -4 * i));
    const Json dragged = state_after(script.drag(path));
    const Json undone = state_after(script.key("ctrl+z"));
    EXPECT_NE(dragged["segments"], first_state()["segments"]);
    EXPECT_EQ(undone["segments"], first_state()["segments"]);
    EXPECT_EQ(undone["target"], first_state()["target"]);
    EXPECT_EQ(state_after(script.key("ctrl+shift+z"))["segments"], dragged["segments"]);
    script.key("ctrl+z").key("ctrl+y");
    EXPECT_EQ(state_after(script)["segments"], dragged["segments"]);
    script.key("ctrl+z").command("undo", Json::object(), true);
    EXPECT_EQ(state_after(script)["segments"], first_state()["segments"]);
}

/// Ctrl, then Z, as users press them: Z is also an axis key, but not in a chord.
TEST(Undo, InMidDragStaysUndoneUntilTheMouseMoves) {
    const glm::vec2 at = target_pixel();
    const auto dragging = [&] { return ScriptText().move(at).down().move(at + glm::vec2(-50, -60)).wait(2); };
    const Json dragged = state_after(dragging());
    ASSERT_NE(dragged["target"], first_state()["target"]);
    const auto pressed = [&] { return dragging().hold("ctrl").wait(2).hold("z").wait(2); };
    EXPECT_EQ(state_after(pressed())["target"], first_state()["target"]);
    for (const bool ctrl_first : {false, true}) {
        ScriptText script = pressed();
        script.release(ctrl_first ? "ctrl" : "z").wait(2).release(ctrl_first ? "z" : "ctrl").wait(2);
        EXPECT_EQ(state_after(script)["target"], first_state()["target"]) << ctrl_first;
        const Json along = state_after(script.hold("z").wait(2));
        EXPECT_NE(along["target"], first_state()["target"]) << "alone it holds the axis";
        EXPECT_EQ(along["target"][0], first_state()["target"][0]);
        EXPECT_EQ(along["target"][1], first_state()["target"][1]);
    }
}

TEST(Undo, EscapeInMidDragPutsEverythingBack) {
    ScriptText script;
    script.move(target_pixel()).down().move({700, 250}).move({650, 200}).key("escape").move({500, 300}).up();
    const Json state = state_after(script);
    EXPECT_EQ(state["segments"], first_state()["segments"]);
    EXPECT_EQ(state["target"], first_state()["target"]);
}

TEST(Camera, OrbitsPansAndZoomsWithoutUndoSteps) {
    const std::vector<ScriptText> moves{
        ScriptText().drag({elsewhere, {600, 600}, {500, 640}}, "right"),
        ScriptText().drag({elsewhere, {600, 600}, {500, 640}}, "middle"),
        ScriptText().hold("alt").drag({elsewhere, {600, 600}}).release("alt"),
        ScriptText().hold("shift").drag({elsewhere, {600, 600}}, "right").release("shift"),
        ScriptText().move(elsewhere).wheel(2),
        ScriptText().key("1"),
        ScriptText().key("3"),
        ScriptText().key("7"),
        ScriptText().key("5"),
        ScriptText().key("home"),
        ScriptText().command("chain.select", {{"index", 2}}).key("f"),
    };
    for (ScriptText script : moves) {
        script.command("undo", Json::object(), true);
        const Json state = state_after(script);
        EXPECT_NE(state["camera"], first_state()["camera"]) << script.text();
        EXPECT_EQ(state["segments"], first_state()["segments"]) << script.text();
    }
}

TEST(Camera, ThePointUnderTheCursorStaysInPlaceWhileZooming) {
    const glm::vec2 cursor = handle(first_state(), "segment.1");
    const Json state = state_after(ScriptText().move(cursor).wheel(4));
    EXPECT_LT(state["camera"]["distance"].get<float>(),
              0.7f * first_state()["camera"]["distance"].get<float>());
    // The plane of the camera's target stays in place; the segment is near that plane, not in it.
    EXPECT_LT(glm::distance(handle(state, "segment.1"), cursor), 25.0f);
    const Json flat = state_after(ScriptText().key("1").key("5"));
    const glm::vec2 point = handle(flat, "segment.1");
    const Json zoomed = state_after(ScriptText().key("1").key("5").move(point).wheel(3));
    EXPECT_LT(glm::distance(handle(zoomed, "segment.1"), point), 0.05f);
}

// Dragging a joint in mode Reach: the joint is an effector, while root and target stay.

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
        expect_lengths_kept(after);
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
    expect_lengths_kept(after);
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
    expect_lengths_kept(after);
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
