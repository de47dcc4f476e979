// Looking around with the mouse, in the running program.
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

/// In the view, with nothing under it.
const glm::vec2 nothing(620, 560);

ScriptText preset(const char* name) {
    return ScriptText().command("view.mouse", {{"like", name}});
}

TEST(View, ALeftDragInEmptySpaceTurnsItAndAClickDoesNot) {
    const Json start = state_after(ScriptText().wait(1));
    const Json turned = state_after(ScriptText().move(nothing).down().move(nothing + glm::vec2(40, 0)).up());
    EXPECT_NE(turned["camera"]["yaw_deg"], start["camera"]["yaw_deg"]);
    EXPECT_EQ(turned["segments"], start["segments"]);
    const Json clicked = state_after(ScriptText().move(nothing).down().up());
    EXPECT_EQ(clicked["camera"], start["camera"]);
    // On a handle it drags the handle.
    const glm::vec2 target = handle(start, "target");
    const Json dragged = state_after(ScriptText().drag({target, target + glm::vec2(-40, -40)}));
    EXPECT_EQ(dragged["camera"], start["camera"]);
}

/// A drawing is a 2D view: without perspective, square on to the plane that contains the whole scene.
TEST(View, ALeftDragInEmptySpacePansADrawing) {
    const glm::vec2 by(60, 20);
    const auto after_drag = [&](ScriptText script, const char* button) {
        const Json before = state_after(script.wait(2))["camera"];
        const Json after =
            state_after(script.drag({nothing, nothing + 0.5f * by, nothing + by}, button))["camera"];
        return std::pair(before, after);
    };
    const ScriptText linkage = ScriptText().command("lab.open", {{"name", "linkage"}});
    const ScriptText arm =
        ScriptText()
            .command("chain.preset", {{"name", "flat_arm"}})
            .command("camera.set", {{"yaw_deg", 0}, {"pitch_deg", 0}, {"orthographic", true}});
    for (const ScriptText& drawing : {linkage, arm}) {
        const auto [before, after] = after_drag(drawing, "left");
        EXPECT_EQ(after["yaw_deg"], before["yaw_deg"]);
        EXPECT_EQ(after["pitch_deg"], before["pitch_deg"]);
        EXPECT_LT(after["target"][0].get<double>(), before["target"][0].get<double>())
            << "it follows the mouse";
        EXPECT_GT(after["target"][1].get<double>(), before["target"][1].get<double>());
        const auto [still, turned] = after_drag(drawing, "right");
        EXPECT_NE(turned["yaw_deg"], still["yaw_deg"]);
    }
    for (const Json& other : {Json{{"yaw_deg", 20}, {"orthographic", true}}, Json{{"orthographic", false}}}) {
        const auto [before, after] = after_drag(ScriptText(linkage).command("camera.set", other), "left");
        EXPECT_NE(after["yaw_deg"], before["yaw_deg"]) << other;
    }
}

TEST(View, ButtonsFollowThePreset) {
    const auto turns = [](const char* name, const char* button) {
        const Json before = state_after(preset(name));
        const Json after =
            state_after(preset(name).move(nothing).down(button).move(nothing + glm::vec2(40, 10)).up(button));
        return after["camera"]["yaw_deg"] != before["camera"]["yaw_deg"];
    };
    EXPECT_TRUE(turns("tendril", "right"));
    EXPECT_FALSE(turns("tendril", "middle"));
    EXPECT_TRUE(turns("blender", "middle"));
    EXPECT_FALSE(turns("blender", "right"));
    EXPECT_FALSE(turns("maya", "right"));
    const Json near = state_after(ScriptText(preset("maya"))
                                      .hold("alt")
                                      .move(nothing)
                                      .down("right")
                                      .move(nothing - glm::vec2(0, 60))
                                      .up("right"));
    EXPECT_LT(near["camera"]["distance"].get<double>(),
              state_after(preset("maya"))["camera"]["distance"].get<double>());
}

struct Seen {
    double distance = 0.0;
    glm::vec3 target{0.0f};
};

Seen seen_after(ScriptText script) {
    const Json camera = state_after(script.wait(1))["camera"];
    return {camera["distance"].get<double>(), point_of(camera["target"])};
}

Json wheel(double by, double sideways) {
    return {{"mouse", "wheel"}, {"by", by}, {"sideways", sideways}};
}

ScriptText scrolls(const char* what) {
    return ScriptText().command("view.scroll", {{"does", what}}).move(nothing);
}

TEST(View, TheWheelZoomsAndPansSideways) {
    const Seen before = seen_after(scrolls("zoom"));
    const Seen zoomed = seen_after(scrolls("zoom").wheel(2));
    EXPECT_LT(zoomed.distance, before.distance);
    const Seen shifted = seen_after(scrolls("zoom").line(wheel(0, 2)));
    EXPECT_EQ(shifted.distance, before.distance);
    EXPECT_GT(glm::distance(shifted.target, before.target), 0.05f);
    // Left and back again.
    const Seen back = seen_after(scrolls("zoom").line(wheel(0, 2)).line(wheel(0, -2)));
    EXPECT_LT(glm::distance(back.target, before.target), 1e-4f);
    // Two fingers never move quite straight.
    const Seen slanted = seen_after(scrolls("zoom").line(wheel(2, 0.5)));
    EXPECT_EQ(slanted.distance, zoomed.distance);
    EXPECT_EQ(slanted.target, zoomed.target);
}

TEST(View, TwoFingersPanIfChosenAndZoomWithCtrl) {
    const Seen before = seen_after(scrolls("pan"));
    const Seen up = seen_after(scrolls("pan").wheel(2)), aside = seen_after(scrolls("pan").line(wheel(0, 2)));
    const Seen both = seen_after(scrolls("pan").line(wheel(2, 2)));
    for (const Seen& each : {up, aside, both}) {
        EXPECT_EQ(each.distance, before.distance);
        EXPECT_GT(glm::distance(each.target, before.target), 0.05f);
    }
    EXPECT_LT(glm::distance(both.target - before.target, up.target + aside.target - 2.0f * before.target),
              1e-3f);
    // As far as a drag with the middle button: the scene follows the fingers.
    const Seen dragged =
        seen_after(scrolls("pan").down("middle").move(nothing + glm::vec2(30, 30)).up("middle"));
    EXPECT_LT(glm::distance(both.target, dragged.target), 1e-3f);
    const Seen pinched = seen_after(scrolls("pan").hold("ctrl").wheel(2).release("ctrl"));
    EXPECT_EQ(pinched.distance, seen_after(scrolls("zoom").wheel(2)).distance);
    // Over a panel, the panel scrolls.
    const Seen panel = seen_after(scrolls("pan").move({100, 400}).line(wheel(2, 2)));
    EXPECT_EQ(panel.target, before.target);
}

const PlayOptions low{.picture = true, .more = {"--size", "1280x520"}};

std::vector<std::uint8_t> panel(const app::Image& picture, int left = 0) {
    std::vector<std::uint8_t> pixels;
    for (int y = 60; y < 480; ++y)
        for (int x = 4 * left; x < 4 * (left + 240); ++x)
            pixels.push_back(picture.rgba[static_cast<std::size_t>(4 * picture.size.x * y + x)]);
    return pixels;
}

TEST(Panels, ANewSelectionIsShownFromItsTop) {
    ScriptText script = ScriptText().command("chain.select", {{"index", 2}}).wait(3);
    const glm::vec2 joint = handle(play(script, low).state, "segment.5"), empty(640, 90),
                    inspector(1150, 300);
    const auto seen = [&](ScriptText then) {
        return panel(play(then.move(empty).wait(4), low).picture, 1030);
    };
    const ScriptText scrolled = ScriptText(script).move(inspector).wheel(-30).wait(2);
    EXPECT_NE(seen(scrolled), seen(script));
    EXPECT_EQ(seen(ScriptText(scrolled).click(joint)), seen(ScriptText(script).click(joint)));
}

/// Undo restores what a fix removed from a panel, and the panel's scroll position.
TEST(Panels, UndoRestoresTheirScrollPosition) {
    const ScriptText scrolled =
        ScriptText()
            .command("lab.open", {{"name", "humanoid"}})
            .command("time.pause")
            .command("humanoid.load", {{"path", source_path("tests/app/golden/faulty_walk.bvh")}})
            .command("humanoid.play", {{"on", false}})
            .command("view.fold", {{"section", "humanoid: Motion lint"}, {"folded", false}})
            .move({130, 500})
            .wait(2)
            .wheel(-30)
            .wait(2)
            .move({620, 300})
            .wait(3);
    const app::Image before = play(scrolled, low).picture;
    const ScriptText fixed = ScriptText(scrolled).command("humanoid.cure").wait(4);
    EXPECT_NE(panel(play(fixed, low).picture), panel(before));
    EXPECT_EQ(panel(play(ScriptText(fixed).command("undo").wait(4), low).picture), panel(before));
}

TEST(View, TheAxesInTheCornerAreClickedForASide) {
    // From the front, +X points right and +Y up: a click on their ends looks along them.
    const ScriptText front = ScriptText().command("camera.view", {{"name", "front"}});
    const auto size = glm::vec2(1280, 720);
    const float right = size.x - 272.0f, top = 44.0f, reach = 27.0f, radius = 8.5f;
    const glm::vec2 centre(right - reach - 2.0f * radius, top + reach + 2.0f * radius);
    const auto click = [&](glm::vec2 at) {
        return state_after(ScriptText(front).move(centre + at).down().up().wait(2))["camera"];
    };
    EXPECT_NEAR(click({reach, 0})["yaw_deg"].get<double>(), 90.0, 1e-3) << "from the right";
    EXPECT_NEAR(click({-reach, 0})["yaw_deg"].get<double>(), -90.0, 1e-3) << "from the left";
    EXPECT_NEAR(click({0, -reach})["pitch_deg"].get<double>(), 90.0, 1e-3) << "from the top";
    EXPECT_NEAR(click({0, reach})["pitch_deg"].get<double>(), -90.0, 1e-3) << "from below";
    EXPECT_EQ(click({0.5f * reach, 0.5f * reach}), state_after(front)["camera"]) << "beside them";
    const Json back = state_after(ScriptText().command("camera.view", {{"name", "back"}}))["camera"];
    EXPECT_NEAR(std::abs(back["yaw_deg"].get<double>()), 180.0, 1e-3);
}

}  // namespace
}  // namespace tendril::test
