// The race side by side: one pane for each solver, a common camera, and the mouse in each.
#include <set>

#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

using app::Json;

ScriptText race() {
    ScriptText script = ScriptText().command("chain.mode", {{"mode", "reach"}});
    script.command("race.open", {{"start", "straight"}});
    script.command("chain.target", {{"to", {3, 3, 1}}});
    script.command("race.side_by_side", {{"on", true}});
    script.command("camera.frame", {{"what", "all"}});
    return script;
}

glm::vec2 corner(const Json& state, std::size_t pane, const char* which) {
    const Json& at = state.at("panes").at(pane).at(which);
    return {at[0].get<float>(), at[1].get<float>()};
}

/// From a point in the first pane to the same point in another.
glm::vec2 across(const Json& state, std::size_t pane) {
    return corner(state, pane, "min") - corner(state, 0, "min");
}

TEST(RacePanes, EachSolverHasOneWithItsName) {
    const Json state = state_after(race());
    ASSERT_EQ(state.at("panes").size(), 4u);
    std::set<std::string> titles;
    for (const Json& pane : state["panes"]) titles.insert(pane.at("title"));
    EXPECT_EQ(titles.size(), 4u);
    EXPECT_TRUE(titles.contains("CCD: finished after 4")) << state["panes"].dump();
    EXPECT_EQ(state_after(race().command("race.solver", {{"name", "ccd"}, {"on", false}})).at("panes").size(),
              3u);
    EXPECT_FALSE(state_after(race().command("race.side_by_side", {{"on", false}})).contains("panes"));
    EXPECT_FALSE(state_after(race().command("race.close")).contains("panes"));
}

TEST(RacePanes, TheTargetIsSharedAndCanBeDraggedInEach) {
    const Json before = state_after(race());
    const glm::vec2 target = handle(before, "target"), by(-40.0f, 25.0f);
    const Json first = state_after(race().drag({target, target + by}));
    for (std::size_t pane = 0; pane < 4; ++pane) {
        const glm::vec2 at = target + across(before, pane);
        const Json after = state_after(race().drag({at, at + 0.3f * by, at + by}));
        EXPECT_LT(glm::distance(handle(after, "target"), target + by), 0.05f) << pane;
        EXPECT_LT(glm::distance(point_of(after["target"]), point_of(first["target"])), 1e-3f) << pane;
    }
}

TEST(RacePanes, ADragStaysInThePaneWhereItBegan) {
    const Json before = state_after(race());
    // Down from the second pane into the fourth, and left into the third.
    const glm::vec2 from = handle(before, "target") + across(before, 1), by(-300.0f, 260.0f);
    const Json after = state_after(race().drag({from, from + 0.5f * by, from + by}));
    EXPECT_LT(glm::distance(handle(after, "target"), handle(before, "target") + by), 0.2f);
}

TEST(RacePanes, ARopeDraggedInOnePaneFollowsInAll) {
    ScriptText script;
    script.command("lab.open", {{"name", "rope"}})
        .command("rope.preset", {{"name", "line"}})
        .command("rope.race")
        .command("camera.frame", {{"what", "all"}})
        .wait(30);
    const Json before = state_after(script);
    ASSERT_EQ(before.at("panes").size(), 3u);
    for (std::size_t pane = 0; pane < 3; ++pane) {
        ScriptText drags = script;
        const glm::vec2 at = handle(before, "line.8") + across(before, pane);
        const Json after = state_after(drags.move(at).down().move(at - glm::vec2(0, 20)).wait(5));
        EXPECT_EQ(after["held"]["rope"], "line") << pane;
        EXPECT_GT(point_of(after["ropes"][0]["particles"][8]["position"]).y,
                  point_of(before["ropes"][0]["particles"][8]["position"]).y + 0.02f)
            << pane;
    }
}

TEST(RacePanes, TheyShareACameraThatEachCanTurnAndZoom) {
    const Json before = state_after(race());
    for (const std::size_t pane : {0u, 3u}) {
        const glm::vec2 free = corner(before, pane, "min") + glm::vec2(30.0f, 200.0f);
        const Json turned = state_after(race().drag({free, free + glm::vec2(60.0f, 0.0f)}));
        EXPECT_NE(turned["camera"]["yaw_deg"], before["camera"]["yaw_deg"]) << pane;
        EXPECT_EQ(turned["target"], before["target"]) << pane;
        // The point under the pointer stays.
        const glm::vec2 target = handle(before, "target") + across(before, pane);
        const Json nearer = state_after(race().move(target).wheel(3.0f));
        EXPECT_LT(nearer["camera"]["distance"], before["camera"]["distance"]) << pane;
        EXPECT_LT(glm::distance(handle(nearer, "target"), handle(before, "target")), 1.0f) << pane;
    }
}

TEST(RacePanes, APictureHasThemAll) {
    const TempFolder folder;
    const std::string path = (folder / "race.png").string();
    state_after(
        race().command("view.picture", {{"path", path}, {"width", 802}, {"height", 602}, {"labels", false}}));
    const app::Image picture = app::read_png(path);
    ASSERT_EQ(picture.size, glm::ivec2(802, 602));
    // The target's ball is at the same position in each quarter.
    const auto orange = [&](glm::ivec2 from, glm::ivec2 to) {
        glm::dvec2 sum(0.0);
        int count = 0;
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x) {
                const auto* p = &picture.rgba[static_cast<std::size_t>(4 * (y * picture.size.x + x))];
                if (p[0] < 190 || p[1] < 110 || p[1] > 190 || p[2] > 60) continue;
                sum += glm::dvec2(x - from.x, y - from.y);
                ++count;
            }
        EXPECT_GT(count, 50);
        return sum / std::max(1.0, static_cast<double>(count));
    };
    const glm::dvec2 first = orange({0, 0}, {400, 300});
    for (const glm::ivec2 corner : {glm::ivec2(402, 0), glm::ivec2(0, 302), glm::ivec2(402, 302)})
        EXPECT_LT(glm::distance(orange(corner, corner + glm::ivec2(400, 300)), first), 1.0);
}

}  // namespace
}  // namespace tendril::test
